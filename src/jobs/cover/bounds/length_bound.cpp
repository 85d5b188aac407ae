#include "outrider/jobs/cover/bounds/length_bound.hpp"

#include <algorithm>
#include <cmath>

#include "outrider/core/units.hpp"
#include "outrider/jobs/cover/ground/coverage.hpp"

namespace outrider {
namespace {

/// Returns true if the segment bounds the room, and not another part of the ground.
bool bounds(const Region& room, Segment wall, double near_m) {
  const Vec2 middle = 0.5 * (wall.a + wall.b);
  return std::any_of(room.begin(), room.end(),
                     [&](const RingedPolygon& part) { return distance_to_border(part, middle) <= near_m; });
}

double least_length_m(const CoverField& field, double sure_m, double arc_m, const std::stop_token& stop) {
  // The chords of a coverage lie inside of the disk; those of a disk that is so much larger around it.
  const double around_m = sure_m / std::cos(pi / 48.0) * (1.0 + 1e-9);
  Region rest = common(grown(field.standing, sure_m, arc_m), field.area);
  double length_m = 0.0;
  for (const Segment& wall : field.ground->walls) {
    if (stop.stop_requested()) break;
    if (!bounds(field.standing, wall, 4.0 * arc_m)) continue;
    length_m += distance(wall.a, wall.b);
    rest = without(rest, coverage_of({wall.a, wall.b}, around_m, rest).covered);
  }
  return length_m + area_of(rest) / (2.0 * sure_m);
}

}  // namespace

double least_length_m(const CoverageArea& area, const CoverProblem& problem, const std::stop_token& stop) {
  double length_m = 0.0;
  if (problem.bar()) return length_m;
  for (const CoverField& field : area.fields)
    length_m += least_length_m(field, problem.sure_radius_m(), area.arc_m, stop);
  return length_m;
}

}  // namespace outrider
