#include "wall_crossings.hpp"

#include <cmath>

#include "outrider/world/occupancy.hpp"

namespace outrider {
namespace {

constexpr double longest_m = 1.0;
constexpr double steps_per_cell = 4.0;

bool meets_occupied(const Grid<std::uint8_t>& occupancy, Vec2 from, Vec2 to) {
  const double length_m = distance(from, to);
  const int steps = static_cast<int>(std::ceil(steps_per_cell * length_m / occupancy.frame.resolution_m));
  for (int i = 1; i <= steps; ++i) {
    const Cell cell = occupancy.frame.cell_at(from + static_cast<double>(i) / steps * (to - from));
    if (occupancy.contains(cell) && occupancy[cell] == occupied_cell) return true;
  }
  return false;
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
