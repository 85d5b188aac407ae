#include "outrider/jobs/cover/coverage.hpp"

#include <algorithm>
#include <cmath>
#include <span>

#include "outrider/core/units.hpp"

namespace outrider {
namespace {

constexpr int chords_of_half = 24;

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

/// Returns what the way covers. Adds what it passes over more than once to `overlap`, in parts that may
/// overlap. Returns nothing once the token is raised.
Region covered_by(std::span<const Vec2> way, double radius_m, std::vector<Region>& overlap,
                  const std::stop_token& stop) {
  if (way.size() == 1) return {{capsule(way[0], way[0], radius_m), {}}};
  if (way.size() == 2) return {{capsule(way[0], way[1], radius_m), {}}};
  const std::size_t middle = way.size() / 2;
  const Region before = covered_by(way.first(middle + 1), radius_m, overlap, stop);
  const Region after = covered_by(way.subspan(middle), radius_m, overlap, stop);
  if (stop.stop_requested()) return {};
  Region again = without(common(before, after), disk(way[middle], radius_m));
  if (!again.empty()) overlap.push_back(std::move(again));
  return united(before, after);
}

}  // namespace

Coverage coverage_of(const std::vector<Vec2>& way, double radius_m, const Region& area,
                     const std::stop_token& stop) {
  Coverage coverage;
  std::vector<Region> overlap;
  if (!way.empty()) coverage.covered = common(covered_by(way, radius_m, overlap, stop), area);
  if (stop.stop_requested()) return coverage;
  coverage.missed = without(area, coverage.covered);
  coverage.overlap = common(united(overlap), area);
  coverage.covered_m2 = area_of(coverage.covered);
  coverage.missed_m2 = area_of(coverage.missed);
  coverage.overlap_m2 = area_of(coverage.overlap);
  const double all = area_of(area);
  coverage.fraction = all > 0.0 ? coverage.covered_m2 / all : 1.0;
  return coverage;
}

/// Returns the part of the region that earlier sections have in their member `part`.
Region GrowingCoverage::known_of(const Region& region, const Box2& box, Region Section::* part) const {
  std::vector<Region> known;
  for (const Section& one : before_) {
    if (one.box.overlaps(box)) known.push_back(common(one.*part, region));
  }
  return united(known);
}

CoverageSums GrowingCoverage::add(const std::vector<Vec2>& way) {
  std::vector<Region> overlap;
  Section now;
  now.covered = common(covered_by(way, radius_m_, overlap, {}), area_);
  now.box = bounds_of(now.covered);
  const Region again = known_of(now.covered, now.box, &Section::covered);
  overlap.push_back(without(again, disk(way.front(), radius_m_)));
  now.overlap = common(united(overlap), area_);
  const Region counted = known_of(now.overlap, now.box, &Section::overlap);
  sums_.covered_m2 += std::max(0.0, area_of(now.covered) - area_of(again));
  sums_.overlap_m2 += std::max(0.0, area_of(now.overlap) - area_of(counted));
  before_.push_back(std::move(now));
  return sums_;
}

}  // namespace outrider
