#include "outrider/cover/coverage.hpp"

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

/// What the way covers; what it covers twice is added to `twice`, in parts that may overlap.
Region covered_by(std::span<const Vec2> way, double radius_m, std::vector<Region>& twice) {
  if (way.size() == 1) return {{capsule(way[0], way[0], radius_m), {}}};
  if (way.size() == 2) return {{capsule(way[0], way[1], radius_m), {}}};
  const std::size_t middle = way.size() / 2;
  const Region before = covered_by(way.first(middle + 1), radius_m, twice);
  const Region after = covered_by(way.subspan(middle), radius_m, twice);
  Region again = without(common(before, after), disk(way[middle], radius_m));
  if (!again.empty()) twice.push_back(std::move(again));
  return united(before, after);
}

}  // namespace

Coverage coverage_of(const std::vector<Vec2>& way, double radius_m, const Region& area) {
  Coverage coverage;
  std::vector<Region> twice;
  if (!way.empty()) coverage.covered = common(covered_by(way, radius_m, twice), area);
  coverage.missed = without(area, coverage.covered);
  coverage.twice = common(united(twice), area);
  coverage.covered_m2 = area_of(coverage.covered);
  coverage.missed_m2 = area_of(coverage.missed);
  coverage.twice_m2 = area_of(coverage.twice);
  const double all = area_of(area);
  coverage.fraction = all > 0.0 ? coverage.covered_m2 / all : 1.0;
  return coverage;
}

}  // namespace outrider
