#include "path_picture.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <iterator>

namespace outrider::cli {
namespace {

constexpr double width_px = 900.0;
constexpr std::array<const char*, 6> colours = {"#0072b2", "#d55e00", "#009e73",
                                                "#cc79a7", "#e69f00", "#56b4e9"};

/// One rectangle a run of set cells, in units of cells with y down.
void draw_cells(std::string& svg, const Grid<std::uint8_t>& grid, const char* colour) {
  fmt::format_to(std::back_inserter(svg), "<path fill=\"{}\" d=\"", colour);
  const GridFrame& frame = grid.frame;
  for (int y = 0; y < frame.height; ++y) {
    for (int x = 0; x < frame.width;) {
      if (grid[{x, y}] == 0) {
        ++x;
        continue;
      }
      const int first = x;
      while (x < frame.width && grid[{x, y}] != 0) ++x;
      fmt::format_to(std::back_inserter(svg), "M{} {}h{}v1h-{}z", first, frame.height - 1 - y, x - first,
                     x - first);
    }
  }
  svg += "\"/>\n";
}

}  // namespace

std::string path_picture(const Grid<std::uint8_t>& occupied, const Grid<std::uint8_t>& blocked,
                         const std::vector<DrawnPath>& paths) {
  const GridFrame& frame = blocked.frame;
  const double cell_px = width_px / frame.width;
  const double legend = 26.0 / cell_px;  // height of a line of text, in cells
  const double height = frame.height + legend * (static_cast<double>(paths.size()) + 0.5);
  std::string svg = fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{:.0f}\" height=\"{:.0f}\" viewBox=\"0 0 {} "
      "{:.3f}\">\n"
      "<rect width=\"{}\" height=\"{:.3f}\" fill=\"#fbfbf9\"/>\n",
      width_px, height * cell_px, frame.width, height, frame.width, height);
  draw_cells(svg, blocked, "#d9dbd6");
  if (!occupied.cells.empty()) draw_cells(svg, occupied, "#4a4f55");
  for (std::size_t i = 0; i < paths.size(); ++i) {
    const char* colour = colours[i % colours.size()];
    svg += "<polyline fill=\"none\" stroke-linejoin=\"round\" stroke-linecap=\"round\" points=\"";
    for (const Vec2 p : paths[i].plan.waypoints) {
      fmt::format_to(std::back_inserter(svg), "{:.3f},{:.3f} ", (p.x - frame.origin.x) / frame.resolution_m,
                     frame.height - (p.y - frame.origin.y) / frame.resolution_m);
    }
    // Later paths are thinner, so that equal ones stay visible.
    const double stroke = (7.0 - 4.0 * static_cast<double>(i) / static_cast<double>(paths.size())) / cell_px;
    const double y = frame.height + legend * (static_cast<double>(i) + 0.9);
    fmt::format_to(
        std::back_inserter(svg),
        "\" stroke=\"{0}\" stroke-width=\"{1:.3f}\"/>\n<rect x=\"{2:.3f}\" y=\"{3:.3f}\" width=\"{4:.3f}\" "
        "height=\"{5:.3f}\" fill=\"{0}\"/>\n<text x=\"{6:.3f}\" y=\"{7:.3f}\" font-family=\"sans-serif\" "
        "font-size=\"{8:.3f}\" fill=\"#222\">{9}: {10:.3f} m</text>\n",
        colour, stroke, 0.5 * legend, y - 0.3 * legend, legend, 0.18 * legend, 1.8 * legend, y, 0.62 * legend,
        paths[i].name, paths[i].plan.cost);
  }
  return svg + "</svg>\n";
}

}  // namespace outrider::cli
