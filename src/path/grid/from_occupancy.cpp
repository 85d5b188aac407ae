#include "outrider/path/grid/from_occupancy.hpp"

#include <fmt/format.h>

#include <cmath>

#include "outrider/world/clearance.hpp"

namespace outrider {
namespace {

constexpr int longest_side = 32766;  // with the border still within squared_clearance()

/// Returns the occupied cells and the eight cells around each, in a grid with a border of one occupied cell.
Grid<std::uint8_t> grown_by_a_cell(const Grid<std::uint8_t>& occupied, const std::stop_token& stop) {
  GridFrame frame = occupied.frame;
  frame.width += 2;
  frame.height += 2;
  Grid<std::uint8_t> grown(frame, 1);
  const auto taken = [&](int x, int y) { return !occupied.contains({x, y}) || occupied[{x, y}] != 0; };
  for (int y = 0; y < occupied.frame.height && !stop.stop_requested(); ++y) {
    for (int x = 0; x < occupied.frame.width; ++x) {
      bool any = false;
      for (int i = 0; i < 9 && !any; ++i) any = taken(x + i % 3 - 1, y + i / 3 - 1);
      grown[{x + 1, y + 1}] = any ? 1 : 0;
    }
  }
  return grown;
}

}  // namespace

Outcome<Grid<std::uint8_t>> inflated(const Grid<std::uint8_t>& occupied, double radius_m,
                                     const std::stop_token& stop) {
  if (auto good = check_frame(occupied.frame); !good) return pass_on(good);
  const GridFrame& frame = occupied.frame;
  if (occupied.cells.size() != frame.size() || frame.width > longest_side || frame.height > longest_side) {
    return bad_input(
        fmt::format("an occupancy grid of {} x {} cells with {} values is not valid; give one value for "
                    "each cell and at most {} cells a side",
                    frame.width, frame.height, occupied.cells.size(), longest_side));
  }
  const bool good_radius = radius_m >= 0.0 && std::isfinite(radius_m);
  if (!good_radius) {
    return bad_input(
        fmt::format("a robot radius of {} m is not valid; expected a finite number from 0", radius_m));
  }
  const double cells = radius_m / frame.resolution_m;
  const double least = cells * cells * (1.0 - 1e-12);  // a radius of whole cells may touch
  const Grid<std::uint32_t> apart = squared_clearance(grown_by_a_cell(occupied, stop), stop);
  Grid<std::uint8_t> blocked(frame);
  for (int y = 0; y < frame.height && !stop.stop_requested(); ++y) {
    for (int x = 0; x < frame.width; ++x) {
      const bool taken = occupied[{x, y}] != 0 || static_cast<double>(apart[{x + 1, y + 1}]) < least;
      blocked[{x, y}] = taken ? 1 : 0;
    }
  }
  if (stop.stop_requested()) return fault(FaultCode::cancelled, "it was cancelled while it grew obstacles");
  return blocked;
}

Outcome<GridMap> grid_from_occupancy(const Grid<std::uint8_t>& occupied, double radius_m, GridModel model) {
  auto blocked = inflated(occupied, radius_m);
  if (!blocked) return pass_on(blocked);
  return GridMap::of(*blocked, model);
}

}  // namespace outrider
