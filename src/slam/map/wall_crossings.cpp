#include "map/wall_crossings.hpp"

#include <algorithm>
#include <cmath>

#include "outrider/core/units.hpp"
#include "outrider/world/grid_ray.hpp"
#include "outrider/world/occupancy.hpp"

namespace outrider {
namespace {

constexpr double longest_m = 1.0;
constexpr double beyond_cells = 1.5;  // a beam that ends so far behind a place has passed it
constexpr int looks = 2;              // that have passed a place where nothing stands any more

/// The answer of a scan about a place.
enum class Look { nothing, stands, passes };

Look look_at(const PlacedScan& placed, Vec2 place, double within_m) {
  const LaserScan& scan = *placed.scan;
  const Vec2 local = placed.world_T_laser.to_local(place);
  const double away_m = norm(local);
  if (away_m < scan.least_m + within_m || away_m + within_m > scan.most_m) return Look::nothing;
  const double beam = wrap_angle(heading_of(local) - scan.first_rad) / scan.step_rad;
  const auto beams = static_cast<double>(scan.ranges_m.size());
  const double turn = std::abs(2.0 * pi / scan.step_rad);
  const double nearest = std::round(beam < 0.0 ? beam + turn : beam);
  if (nearest >= beams) return Look::nothing;
  const auto range_m = static_cast<double>(scan.ranges_m[static_cast<std::size_t>(nearest)]);
  if (!(range_m >= scan.least_m) || range_m < away_m - within_m) return Look::nothing;
  return range_m <= away_m + within_m ? Look::stands : Look::passes;
}

/// Returns true if the newest scans that can tell have looked through a place.
bool is_seen_through(std::span<const PlacedScan> scans, Vec2 place, double within_m) {
  int passed = 0;
  for (std::size_t i = scans.size(); i-- > 0 && passed < looks;) {
    const Look look = look_at(scans[i], place, within_m);
    if (look == Look::stands) return false;
    passed += look == Look::passes ? 1 : 0;
  }
  return passed == looks;
}

/// Returns the middles of the occupied cells that a straight way leads through.
std::vector<Vec2> occupied_between(const Grid<std::uint8_t>& occupancy, Vec2 from, Vec2 to) {
  const GridFrame& frame = occupancy.frame;
  const auto in_cells = [&](Vec2 p) {
    return lattice_point((1.0 / frame.resolution_m) * (p - frame.origin));
  };
  std::vector<Vec2> met;
  cross_cells(in_cells(from), in_cells(to), [&](Cell cell) {
    if (occupancy.contains(cell) && occupancy[cell] == occupied_cell) met.push_back(frame.centre(cell));
  });
  return met;
}

}  // namespace

std::vector<std::size_t> wall_crossings(const std::vector<Pose2>& path, const Grid<std::uint8_t>& occupancy,
                                        std::span<const PlacedScan> scans) {
  const double within_m = beyond_cells * occupancy.frame.resolution_m;
  const auto stands = [&](Vec2 place) { return !is_seen_through(scans, place, within_m); };
  std::vector<std::size_t> crossings;
  for (std::size_t i = 1; i < path.size(); ++i) {
    const Vec2 from = path[i - 1].position, to = path[i].position;
    if (distance(from, to) <= longest_m && std::ranges::any_of(occupied_between(occupancy, from, to), stands))
      crossings.push_back(i);
  }
  return crossings;
}

}  // namespace outrider
