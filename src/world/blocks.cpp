#include "outrider/world/blocks.hpp"

#include <algorithm>
#include <string>

namespace outrider {
namespace {

/// The cells with begin <= x < end in the rows from `row` to `last`, inclusive.
struct Rectangle {
  int begin = 0;
  int end = 0;
  int row = 0;
  int last = 0;
};

/// Returns the runs of cells in a row that are not free, from left to right.
std::vector<Rectangle> runs_of(const Grid<std::uint8_t>& occupancy, int row) {
  std::vector<Rectangle> runs;
  const int width = occupancy.frame.width;
  for (int x = 0; x < width; ++x) {
    if (occupancy[{x, row}] == free_cell) continue;
    const int begin = x;
    while (x < width && occupancy[{x, row}] != free_cell) ++x;
    runs.push_back({begin, x, row, row});
  }
  return runs;
}

std::vector<Rectangle> rectangles_of(const Grid<std::uint8_t>& occupancy) {
  std::vector<Rectangle> all;
  std::vector<std::size_t> open;  // rectangles that end at the previous row, from left to right
  for (int row = 0; row < occupancy.frame.height; ++row) {
    std::vector<std::size_t> next;
    auto above = open.begin();
    for (const Rectangle& run : runs_of(occupancy, row)) {
      while (above != open.end() && all[*above].begin < run.begin) ++above;
      const bool goes_on =
          above != open.end() && all[*above].begin == run.begin && all[*above].end == run.end;
      if (goes_on) {
        all[*above].last = row;
        next.push_back(*above);
      } else {
        next.push_back(all.size());
        all.push_back(run);
      }
    }
    open = std::move(next);
  }
  return all;
}

}  // namespace

std::vector<Solid> blocks(const Grid<std::uint8_t>& occupancy, double low_z_m, double high_z_m) {
  std::vector<Solid> solids;
  for (const Rectangle& rectangle : rectangles_of(occupancy)) {
    const Vec2 low = occupancy.frame.corner({rectangle.begin, rectangle.row});
    const Vec2 high = occupancy.frame.corner({rectangle.end, rectangle.last + 1});
    const Vec2 middle = 0.5 * (low + high), half = 0.5 * (high - low);
    solids.push_back({"block_" + std::to_string(solids.size() + 1),
                      {{middle.x, middle.y, 0.5 * (low_z_m + high_z_m)}, {}},
                      BoxShape{{half.x, half.y, 0.5 * (high_z_m - low_z_m)}}});
  }
  return solids;
}

Grid<std::uint8_t> bordered(const Grid<std::uint8_t>& occupancy, Occupancy border) {
  GridFrame frame = occupancy.frame;
  frame.origin = frame.corner({-1, -1});
  frame.width += 2;
  frame.height += 2;
  Grid<std::uint8_t> result(frame);
  result.cells = moved_cells<std::uint8_t>(occupancy.cells, occupancy.frame, frame, {1, 1}, border);
  return result;
}

}  // namespace outrider
