#include "laser_picture.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>

#include "outrider/world/known_extent.hpp"

namespace outrider {
namespace {

constexpr double size_px = 900.0;
constexpr double legend_px = 34.0;

/// Returns the runs of cells of a kind, row by row from the top, as one path in units of cells.
std::string runs(const Grid<std::uint8_t>& map, std::uint8_t kind) {
  std::string d;
  for (int y = map.frame.height - 1, row = 0; y >= 0; --y, ++row) {
    for (int x = 0; x < map.frame.width;) {
      const int begin = x;
      while (x < map.frame.width && map[{x, y}] == kind) ++x;
      if (x > begin) {
        fmt::format_to(std::back_inserter(d), "M{} {}h{}v1h{}z", begin, row, x - begin, begin - x);
      } else {
        ++x;
      }
    }
  }
  return d;
}

std::string line(const GridFrame& frame, const std::vector<Vec2>& places) {
  std::string d;
  for (std::size_t i = 0; i < places.size(); ++i) {
    fmt::format_to(std::back_inserter(d), "{}{:.1f} {:.1f}", i == 0 ? 'M' : 'L',
                   (places[i].x - frame.origin.x) / frame.resolution_m,
                   frame.height - (places[i].y - frame.origin.y) / frame.resolution_m);
  }
  return d;
}

constexpr const char* style =
    "<style>svg{background:#c8ccd2}.free{fill:#fff}.wall{fill:#1b1e24}.driven,.reference{fill:none;"
    "stroke-linejoin:round;vector-effect:non-scaling-stroke}.driven{stroke:#1f5fbf;stroke-width:1.6}"
    ".reference{stroke:#d9703c;stroke-width:1.1;stroke-dasharray:5 3}text{font:13px sans-serif;fill:#222}"
    "</style>\n";

}  // namespace

Grid<std::uint8_t> known_part(const Grid<std::uint8_t>& occupancy) {
  const GridFrame& frame = occupancy.frame;
  const CellExtent known = known_extent(occupancy);
  Grid<std::uint8_t> part;
  part.frame = {frame.corner(known.low), frame.resolution_m, std::max(1, known.width()),
                std::max(1, known.height())};
  part.cells = moved_cells(occupancy.cells, frame, part.frame, {-known.low.x, -known.low.y},
                           static_cast<std::uint8_t>(unknown_cell));
  return part;
}

std::string to_svg(const Grid<std::uint8_t>& occupancy, const std::vector<Vec2>& track,
                   const std::vector<Vec2>& reference) {
  const GridFrame& frame = occupancy.frame;
  const double scale = size_px / std::max(frame.width, frame.height);
  const double width = std::max(420.0, scale * frame.width), height = scale * frame.height + legend_px;
  const double y = height - 0.5 * legend_px;
  std::string svg = fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {0:.0f} {1:.0f}\" width=\"{0:.0f}\" "
      "height=\"{1:.0f}\">\n{2}<g transform=\"scale({3:.5f})\" shape-rendering=\"crispEdges\">\n",
      width, height, style, scale);
  svg += fmt::format("<path class=\"free\" d=\"{}\"/>\n<path class=\"wall\" d=\"{}\"/>\n</g>\n",
                     runs(occupancy, free_cell), runs(occupancy, occupied_cell));
  svg += fmt::format("<g transform=\"scale({:.5f})\">\n<path class=\"driven\" d=\"{}\"/>\n", scale,
                     line(frame, track));
  if (!reference.empty())
    svg += fmt::format("<path class=\"reference\" d=\"{}\"/>\n", line(frame, reference));
  svg += fmt::format(
      "</g>\n<path class=\"driven\" d=\"M12 {0:.0f}h22\"/><text x=\"40\" y=\"{1:.0f}\">driven</text>\n", y,
      y + 4.0);
  if (!reference.empty()) {
    svg += fmt::format(
        "<path class=\"reference\" d=\"M110 {0:.0f}h22\"/><text x=\"138\" y=\"{1:.0f}\">reference</text>\n",
        y, y + 4.0);
  }
  return svg + "</svg>\n";
}

}  // namespace outrider
