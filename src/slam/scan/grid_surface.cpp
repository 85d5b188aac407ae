#include "scan/grid_surface.hpp"

#include <cmath>

#include "outrider/world/occupancy.hpp"

namespace outrider {
namespace {

constexpr double line_m = 0.15;       // half side of the square whose occupied cells make a line
constexpr int least_cells = 3;        // in a line
constexpr double most_breadth = 0.5;  // of the cells across the line, relative to along it
constexpr double thick_m = 0.2;       // a wall of that thickness is filled, and its face is that of its cells

/// The occupied and the free cells around one, as sums of their offsets.
struct Around {
  int occupied = 0;
  Vec2 mean;
  double xx = 0.0, xy = 0.0, yy = 0.0;
};

bool is_value(const Grid<std::uint8_t>& grid, Cell cell, std::uint8_t value) {
  return grid.frame.contains(cell) && grid[cell] == value;
}

Around occupied_around(const Grid<std::uint8_t>& grid, Cell at, int radius) {
  Around sum;
  for (int dy = -radius; dy <= radius; ++dy) {
    for (int dx = -radius; dx <= radius; ++dx) {
      if (!is_value(grid, {at.x + dx, at.y + dy}, occupied_cell)) continue;
      ++sum.occupied;
      sum.mean = sum.mean + Vec2{double(dx), double(dy)};
      sum.xx += dx * dx;
      sum.xy += dx * dy;
      sum.yy += dy * dy;
    }
  }
  const double n = sum.occupied;
  sum.mean = (1.0 / n) * sum.mean;
  sum.xx = sum.xx / n - sum.mean.x * sum.mean.x;
  sum.xy = sum.xy / n - sum.mean.x * sum.mean.y;
  sum.yy = sum.yy / n - sum.mean.y * sum.mean.y;
  return sum;
}

/// Returns the unit normal of the line through the cells; zero if they do not make a line.
Vec2 normal_of(const Around& around) {
  if (around.occupied < least_cells) return {};
  const double middle = 0.5 * (around.xx + around.yy);
  const double apart = std::hypot(0.5 * (around.xx - around.yy), around.xy);
  if (middle - apart > most_breadth * (middle + apart)) return {};
  return perpendicular(direction(0.5 * std::atan2(2.0 * around.xy, around.xx - around.yy)));
}

bool borders_on_free(const Grid<std::uint8_t>& grid, Cell at) {
  for (const auto& [dx, dy] : {std::pair(1, 0), std::pair(-1, 0), std::pair(0, 1), std::pair(0, -1)}) {
    if (is_value(grid, {at.x + dx, at.y + dy}, free_cell)) return true;
  }
  return false;
}

/// Returns true if the cells on that side of the line are free, next to it or one cell farther.
bool is_free_towards(const Grid<std::uint8_t>& grid, Vec2 centre, Vec2 normal) {
  for (const double cells : {1.0, 2.0}) {
    if (is_value(grid, grid.frame.cell_at(centre + cells * grid.frame.resolution_m * normal), free_cell))
      return true;
  }
  return false;
}

/// Returns true if the cells on the other side of that of a face are occupied as deep as a filled wall.
bool is_filled_behind(const Grid<std::uint8_t>& grid, Vec2 centre, Vec2 face) {
  const double cell_m = grid.frame.resolution_m;
  const int deep = std::max(2, static_cast<int>(std::ceil(thick_m / cell_m - 1e-9)));
  for (int cells = 1; cells < deep; ++cells) {
    if (!is_value(grid, grid.frame.cell_at(centre - cells * cell_m * face), occupied_cell)) return false;
  }
  return true;
}

}  // namespace

Surface surface_of(const Grid<std::uint8_t>& occupancy) {
  const GridFrame& frame = occupancy.frame;
  const int radius = std::max(1, static_cast<int>(std::lround(line_m / frame.resolution_m)));
  Surface surface;
  for (int y = 0; y < frame.height; ++y) {
    for (int x = 0; x < frame.width; ++x) {
      const Cell at{x, y};
      if (occupancy[at] != occupied_cell || !borders_on_free(occupancy, at)) continue;
      const Around around = occupied_around(occupancy, at, radius);
      const Vec2 normal = normal_of(around);
      const Vec2 centre = frame.centre(at);
      const Vec2 place = centre + frame.resolution_m * dot(around.mean, normal) * normal;
      const bool is_line = normal != Vec2{};
      bool faces = false;
      for (const Vec2 side : {normal, -normal}) {
        if (!is_line || !is_free_towards(occupancy, centre, side)) continue;
        const bool filled = is_filled_behind(occupancy, centre, side);
        surface.push_back({filled ? centre + 0.5 * frame.resolution_m * side : place, side});
        faces = true;
      }
      if (!faces) surface.push_back({centre, {}});
    }
  }
  return surface;
}

}  // namespace outrider
