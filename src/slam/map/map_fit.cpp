#include "outrider/slam/map/map_fit.hpp"

#include <algorithm>
#include <cmath>

#include "outrider/world/occupancy.hpp"

namespace outrider {
namespace {

constexpr std::size_t most_beams = 180;
constexpr double off_m = 0.2;  // by which the end of a beam and a surface may differ

enum class Word { nothing, agreeing, through, unexpected, unknown };

/// Returns true if a cell within `off_m` of the place is occupied.
bool is_near_surface(const Grid<std::uint8_t>& grid, Vec2 place) {
  const Cell centre = grid.frame.cell_at(place);
  const int radius = static_cast<int>(std::ceil(off_m / grid.frame.resolution_m));
  for (int dy = -radius; dy <= radius; ++dy) {
    for (int dx = -radius; dx <= radius; ++dx) {
      const Cell cell{centre.x + dx, centre.y + dy};
      if (grid.frame.contains(cell) && grid[cell] == occupied_cell) return true;
    }
  }
  return false;
}

/// Returns the first value on a way that is not free, or free. All is unknown beyond the map.
std::uint8_t first_on(const Grid<std::uint8_t>& grid, Vec2 from, Vec2 along, double length_m) {
  const double step_m = 0.5 * grid.frame.resolution_m;
  for (double at_m = 0.0; at_m < length_m; at_m += step_m) {
    const Cell cell = grid.frame.cell_at(from + at_m * along);
    const std::uint8_t value = grid.frame.contains(cell) ? grid[cell] : std::uint8_t{unknown_cell};
    if (value != free_cell) return value;
  }
  return free_cell;
}

/// Asks the map about a beam of that length, which hit something or did not. A beam along a wall may be off
/// by a little: it passes through only if its two neighbours do.
Word word_about(const Grid<std::uint8_t>& grid, const Pose2& beam, double length_m, bool hits) {
  constexpr double off_rad = 0.03;
  const double seen_m = length_m - off_m;
  const std::uint8_t first = first_on(grid, beam.position, direction(beam.heading_rad), seen_m);
  if (first == unknown_cell) return Word::unknown;
  if (first == occupied_cell) {
    for (const double turn : {-off_rad, off_rad}) {
      const Vec2 along = direction(beam.heading_rad + turn);
      if (first_on(grid, beam.position, along, seen_m) != occupied_cell) return Word::nothing;
    }
    return Word::through;
  }
  const Vec2 end = beam * Vec2{length_m, 0.0};
  if (!hits) return Word::nothing;
  if (is_near_surface(grid, end)) return Word::agreeing;
  const Cell cell = grid.frame.cell_at(end);
  return grid.frame.contains(cell) && grid[cell] == free_cell ? Word::unexpected : Word::unknown;
}

}  // namespace

MapFit map_fit(const Grid<std::uint8_t>& occupancy, const Pose2& grid_T_laser, const LaserScan& scan,
               double reach_m) {
  MapFit fit;
  const double most_m = std::min(scan.most_m, reach_m);
  const std::size_t step = std::max<std::size_t>(1, (scan.ranges_m.size() + most_beams - 1) / most_beams);
  for (std::size_t i = 0; i < scan.ranges_m.size(); i += step) {
    const auto range_m = static_cast<double>(scan.ranges_m[i]);
    if (!(range_m >= scan.least_m)) continue;
    const Pose2 beam{grid_T_laser.position,
                     grid_T_laser.heading_rad + scan.first_rad + static_cast<double>(i) * scan.step_rad};
    const Word word = word_about(occupancy, beam, std::min(range_m, most_m), range_m <= most_m);
    fit.agreeing += word == Word::agreeing ? 1 : 0;
    fit.through += word == Word::through ? 1 : 0;
    fit.unknown += word == Word::unknown ? 1 : 0;
    fit.unexpected += word == Word::unexpected ? 1 : 0;
  }
  return fit;
}

}  // namespace outrider
