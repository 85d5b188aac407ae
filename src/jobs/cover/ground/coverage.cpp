#include "outrider/jobs/cover/ground/coverage.hpp"

#include <algorithm>
#include <cmath>
#include <span>

#include "ground/bar_sweep.hpp"
#include "outrider/core/units.hpp"

namespace outrider {
namespace {

constexpr int chords_of_half = 24;
constexpr double rounding_m = 1e-5;  // of regions, and more

/// All within the radius of the leg: its sides exactly, its ends by chords.
std::vector<Vec2> capsule(Vec2 a, Vec2 b, double radius_m) {
  const double heading = a == b ? 0.0 : heading_of(b - a);
  std::vector<Vec2> outline;
  for (const auto& [end, from] : {std::pair{b, heading - 0.5 * pi}, std::pair{a, heading + 0.5 * pi}}) {
    for (int i = 0; i <= chords_of_half; ++i) {
      outline.push_back(end + radius_m * direction(from + pi * i / chords_of_half));
    }
  }
  return outline;
}

/// A polygon around the disk.
Region disk(Vec2 centre, double radius_m) {
  const double around = radius_m / std::cos(0.5 * pi / chords_of_half);
  return {{capsule(centre, centre, around), {}}};
}

/// A shape that moves through a number of points.
class Sweep {
 public:
  explicit Sweep(std::size_t count) : points(count) {}
  virtual ~Sweep() = default;
  Sweep(const Sweep&) = delete;
  Sweep& operator=(const Sweep&) = delete;

  /// Returns what it covers from one point to the next; at the only point.
  [[nodiscard]] virtual Region leg(std::size_t from, std::size_t to) const = 0;
  /// Returns a polygon around the shape at a point.
  [[nodiscard]] virtual Region around(std::size_t point) const = 0;

  const std::size_t points;
};

class DiskSweep final : public Sweep {
 public:
  DiskSweep(const std::vector<Vec2>& way, double radius_m)
      : Sweep(way.size()), way_(way), radius_m_(radius_m) {}
  [[nodiscard]] Region leg(std::size_t from, std::size_t to) const override {
    return {{capsule(way_[from], way_[to], radius_m_), {}}};
  }
  [[nodiscard]] Region around(std::size_t point) const override { return disk(way_[point], radius_m_); }

 private:
  const std::vector<Vec2>& way_;
  double radius_m_;
};

class BarSweep final : public Sweep {
 public:
  BarSweep(const std::vector<Pose2>& poses, const Bar& bar) : Sweep(poses.size()), poses_(poses), bar_(bar) {}
  [[nodiscard]] Region leg(std::size_t from, std::size_t to) const override {
    return cover::bar_sweep(poses_[from], poses_[to], bar_, cover::Approximation::inside);
  }
  [[nodiscard]] Region around(std::size_t point) const override {
    const double more_m = rounding_m + 1e-6 * bar_.reach_m();
    return {
        {cover::outline_of({bar_.width_m + more_m, bar_.length_m + more_m, bar_.forward_m}, poses_[point]),
         {}}};
  }

 private:
  const std::vector<Pose2>& poses_;
  const Bar& bar_;
};

/// Returns what is covered from the first of the points to the last. Adds what is passed over more than once
/// to `overlap`, in parts that may overlap. Returns nothing once the token is raised.
Region covered_by(const Sweep& sweep, std::size_t first, std::size_t last, std::vector<Region>& overlap,
                  const std::stop_token& stop) {
  if (stop.stop_requested()) return {};
  if (last <= first + 1) return sweep.leg(first, last);
  const std::size_t middle = first + (last + 1 - first) / 2;
  const Region before = covered_by(sweep, first, middle, overlap, stop);
  const Region after = covered_by(sweep, middle, last, overlap, stop);
  if (stop.stop_requested()) return {};
  Region again = without(common(before, after), sweep.around(middle));
  if (!again.empty()) overlap.push_back(std::move(again));
  return united(before, after);
}

Region covered_by(const Sweep& sweep, std::vector<Region>& overlap, const std::stop_token& stop) {
  return covered_by(sweep, 0, sweep.points - 1, overlap, stop);
}

/// Returns the union, made of at most so many regions at once. Asks between the parts whether to stop.
Region united_in_parts(std::span<const Region> all, std::size_t at_once, const std::stop_token& stop) {
  if (stop.stop_requested()) return {};
  if (all.size() <= at_once) return united(std::vector<Region>(all.begin(), all.end()));
  const std::size_t half = all.size() / 2;
  const Region before = united_in_parts(all.first(half), at_once, stop);
  const Region after = united_in_parts(all.subspan(half), at_once, stop);
  return united(before, after);
}

Coverage measured(const Sweep& sweep, const Region& area, const std::stop_token& stop) {
  Coverage coverage;
  std::vector<Region> overlap;
  if (sweep.points > 0) coverage.covered = common(covered_by(sweep, overlap, stop), area);
  if (stop.stop_requested()) return coverage;
  coverage.missed = without(area, coverage.covered);
  coverage.overlap = common(united_in_parts(overlap, 256, stop), area);
  coverage.covered_m2 = area_of(coverage.covered);
  coverage.missed_m2 = area_of(coverage.missed);
  coverage.overlap_m2 = area_of(coverage.overlap);
  const double all = area_of(area);
  coverage.fraction = all > 0.0 ? coverage.covered_m2 / all : 1.0;
  return coverage;
}

}  // namespace

double Bar::reach_m() const { return std::hypot(std::abs(forward_m) + 0.5 * length_m, 0.5 * width_m); }

Coverage coverage_of(const std::vector<Vec2>& way, double radius_m, const Region& area,
                     const std::stop_token& stop) {
  return measured(DiskSweep(way, radius_m), area, stop);
}

Coverage coverage_of(const std::vector<Pose2>& poses, const Bar& bar, const Region& area,
                     const std::stop_token& stop) {
  const std::vector<Pose2> all = cover::with_small_turns(poses);
  return measured(BarSweep(all, bar), area, stop);
}

/// Returns the part of the region that earlier sections have in their member `part`.
Region GrowingCoverage::known_of(const Region& region, const Box2& box, Region Section::* part) const {
  std::vector<Region> known;
  for (const Section& one : before_) {
    if (one.box.overlaps(box)) known.push_back(common(one.*part, region));
  }
  // A robot that circles has many sections in one place, and a union of n that overlap takes n^2 steps.
  return united_in_parts(known, 16, {});
}

CoverageSums GrowingCoverage::add(const std::vector<Vec2>& way) {
  const DiskSweep sweep(way, radius_m_);
  std::vector<Region> overlap;
  Region covered = covered_by(sweep, overlap, {});
  return add(std::move(covered), std::move(overlap), sweep.around(0));
}

CoverageSums GrowingCoverage::add(const std::vector<Pose2>& poses) {
  const std::vector<Pose2> all = cover::with_small_turns(poses);
  const BarSweep sweep(all, bar_);
  std::vector<Region> overlap;
  Region covered = covered_by(sweep, overlap, {});
  return add(std::move(covered), std::move(overlap), sweep.around(0));
}

CoverageSums GrowingCoverage::add(Region covered, std::vector<Region> overlap, const Region& joint) {
  Section now;
  now.covered = common(covered, area_);
  now.box = bounds_of(now.covered);
  const Region again = known_of(now.covered, now.box, &Section::covered);
  overlap.push_back(without(again, joint));
  now.overlap = common(united(overlap), area_);
  const Region counted = known_of(now.overlap, now.box, &Section::overlap);
  sums_.covered_m2 += std::max(0.0, area_of(now.covered) - area_of(again));
  sums_.overlap_m2 += std::max(0.0, area_of(now.overlap) - area_of(counted));
  before_.push_back(std::move(now));
  return sums_;
}

}  // namespace outrider
