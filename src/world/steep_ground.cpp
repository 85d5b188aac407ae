#include "outrider/world/steep_ground.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace outrider {
namespace {

/// A rectangle of cells [x0, x1) x [y0, y1).
struct Patch {
  int x0, x1, y0, y1;
};

/// Halves the resolution. A block is steep if one of its cells is steep.
Grid<std::uint8_t> coarser(const Grid<std::uint8_t>& fine) {
  GridFrame frame;
  frame.width = (fine.frame.width + 1) / 2;
  frame.height = (fine.frame.height + 1) / 2;
  Grid<std::uint8_t> coarse(frame);
  for (std::size_t i = 0; i < fine.cells.size(); ++i) {
    const Cell c = fine.frame.cell(i);
    if (fine.cells[i] != 0) coarse[{c.x / 2, c.y / 2}] = 1;
  }
  return coarse;
}

std::vector<Patch> patches(const Grid<std::uint8_t>& steep) {
  std::vector<Patch> done;
  std::vector<Patch> open;  // patches that end at the present row
  for (int y = 0; y < steep.frame.height; ++y) {
    std::vector<Patch> row;
    for (int x = 0; x < steep.frame.width; ++x) {
      if (steep[{x, y}] == 0) continue;
      const int first = x;
      while (x < steep.frame.width && steep[{x, y}] != 0) ++x;
      const auto below =
          std::ranges::find_if(open, [&](const Patch& p) { return p.x0 == first && p.x1 == x; });
      row.push_back({first, x, below == open.end() ? y : below->y0, y + 1});
      if (below != open.end()) open.erase(below);
    }
    done.insert(done.end(), open.begin(), open.end());
    open = std::move(row);
  }
  done.insert(done.end(), open.begin(), open.end());
  return done;
}

}  // namespace

std::vector<RoundedPolygon> steep_ground(const HeightField& field, double max_slope_rad, std::size_t most) {
  if (field.steepest() <= std::tan(max_slope_rad)) return {};
  GridFrame frame;
  frame.width = field.columns() - 1;
  frame.height = field.rows() - 1;
  Grid<std::uint8_t> steep(frame);
  for (std::size_t i = 0; i < steep.cells.size(); ++i) {
    steep.cells[i] = field.steepest_in(frame.cell(i)) > std::tan(max_slope_rad) ? 1 : 0;
  }
  int block = 1;
  auto found = patches(steep);
  for (; found.size() > most && steep.cells.size() > 1; block *= 2) {
    steep = coarser(steep);
    found = patches(steep);
  }
  std::vector<RoundedPolygon> result;
  for (const Patch& p : found) {
    const Vec2 low = xy(field.post(block * p.x0, block * p.y0));
    const Vec2 high =
        xy(field.post(std::min(block * p.x1, frame.width), std::min(block * p.y1, frame.height)));
    result.push_back({{low, {high.x, low.y}, high, {low.x, high.y}}, 0.0});
  }
  return result;
}

}  // namespace outrider
