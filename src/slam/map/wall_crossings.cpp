#include "map/wall_crossings.hpp"

#include "outrider/world/grid_ray.hpp"
#include "outrider/world/occupancy.hpp"

namespace outrider {
namespace {

constexpr double longest_m = 1.0;

bool meets_occupied(const Grid<std::uint8_t>& occupancy, Vec2 from, Vec2 to) {
  const auto in_cells = [&](Vec2 p) {
    return lattice_point((1.0 / occupancy.frame.resolution_m) * (p - occupancy.frame.origin));
  };
  bool met = false;
  cross_cells(in_cells(from), in_cells(to),
              [&](Cell cell) { met |= occupancy.contains(cell) && occupancy[cell] == occupied_cell; });
  return met;
}

}  // namespace

std::vector<std::size_t> wall_crossings(const std::vector<Pose2>& path, const Grid<std::uint8_t>& occupancy) {
  std::vector<std::size_t> crossings;
  for (std::size_t i = 1; i < path.size(); ++i) {
    const Vec2 from = path[i - 1].position, to = path[i].position;
    if (distance(from, to) <= longest_m && meets_occupied(occupancy, from, to)) crossings.push_back(i);
  }
  return crossings;
}

}  // namespace outrider
