#include "path_picture.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <tuple>
#include <utility>

namespace outrider {
namespace {

constexpr double map_px = 860.0;  // of the longer side of the map
constexpr double edge_px = 20.0;
constexpr double line_px = 24.0;         // of text
constexpr double least_label_px = 56.0;  // a cell that holds the costs of an expansion
// Colours that also differ for the colour-blind: Okabe and Ito, Color Universal Design, 2008.
constexpr std::array<const char*, 6> colours = {"#0072b2", "#d55e00", "#009e73",
                                                "#cc79a7", "#b8860b", "#56b4e9"};

/// Where things of the map stand on the page, in px.
struct View {
  GridFrame frame;
  double cell_px = 1.0;

  [[nodiscard]] Vec2 operator()(Vec2 p) const {
    return {edge_px + (p.x - frame.origin.x) / frame.resolution_m * cell_px,
            edge_px + (frame.height - (p.y - frame.origin.y) / frame.resolution_m) * cell_px};
  }
  [[nodiscard]] double px(double length_m) const { return length_m / frame.resolution_m * cell_px; }
  [[nodiscard]] double width() const { return frame.width * cell_px; }
  [[nodiscard]] double height() const { return frame.height * cell_px; }
};

template <class... Args>
void put(std::string& svg, fmt::format_string<Args...> text, Args&&... args) {
  fmt::format_to(std::back_inserter(svg), text, std::forward<Args>(args)...);
}

/// One rectangle a run of set cells, in units of cells with y down.
void draw_cells(std::string& svg, const View& view, const Grid<std::uint8_t>& grid, const char* kind) {
  if (grid.cells.empty()) return;
  const GridFrame& frame = grid.frame;
  put(svg, "<path class=\"{}\" transform=\"translate({} {}) scale({:.6g})\" d=\"", kind, edge_px, edge_px,
      view.cell_px);
  for (int y = 0; y < frame.height; ++y) {
    for (int x = 0; x < frame.width; ++x) {
      if (grid[{x, y}] == 0) continue;
      const int first = x;
      while (x < frame.width && grid[{x, y}] != 0) ++x;
      put(svg, "M{} {}h{}v1h-{}z", first, frame.height - 1 - y, x - first, x - first);
    }
  }
  svg += "\"/>\n";
}

void draw_obstacle(std::string& svg, const View& view, const RoundedPolygon& shape) {
  put(svg, "<path class=\"solid\" stroke-width=\"{:.3f}\" d=\"", 2.0 * view.px(shape.radius_m));
  char command = 'M';
  for (const Vec2 p : shape.core) {
    const Vec2 at = view(p);
    put(svg, "{}{:.2f} {:.2f}", std::exchange(command, 'L'), at.x, at.y);
  }
  svg += "z\"/>\n";
}

/// Later paths are thinner, so that equal ones stay visible.
void draw_path(std::string& svg, const View& view, const PathPicture& picture, std::size_t index) {
  const auto count = static_cast<double>(picture.paths.size());
  put(svg, "<polyline class=\"path\" stroke=\"{}\" stroke-width=\"{:.2f}\" points=\"",
      colours[index % colours.size()],
      picture.paths.size() == 1 ? 3.0 : 9.0 - 6.5 * static_cast<double>(index) / (count - 1.0));
  for (const Vec2 p : picture.paths[index].plan.waypoints) {
    const Vec2 at = view(p);
    put(svg, "{:.2f},{:.2f} ", at.x, at.y);
  }
  svg += "\"/>\n";
}

/// The colour of a share of the search, from light to dark.
std::string turn_colour(double share) {
  return fmt::format("hsl({:.0f},75%,{:.0f}%)", 48.0 - 34.0 * share, 80.0 - 38.0 * share);
}

/// Dots where the search was, a path for each of some shares of it.
void draw_dots(std::string& svg, const View& view, const PathPicture& picture) {
  constexpr std::size_t shares = 16;
  const auto& expansions = picture.trace.expansions;
  const double dot_px = std::clamp(0.5 * view.cell_px, 1.0, 16.0);
  for (std::size_t k = 0; k < shares; ++k) {
    put(svg, "<path class=\"dot\" stroke=\"{}\" stroke-width=\"{:.2f}\" d=\"",
        turn_colour(static_cast<double>(k) / (shares - 1)), dot_px);
    for (std::size_t i = k * expansions.size() / shares; i < (k + 1) * expansions.size() / shares; ++i) {
      const Vec2 at = view(picture.ground->point(picture.ground->at(expansions[i].state)));
      put(svg, "M{:.1f} {:.1f}h0", at.x, at.y);
    }
    svg += "\"/>\n";
  }
}

/// Each dot's parent, turn and costs, where there is room for them.
void draw_labels(std::string& svg, const View& view, const PathPicture& picture) {
  const auto point = [&](std::uint32_t state) {
    return view(picture.ground->point(picture.ground->at(state)));
  };
  const auto& expansions = picture.trace.expansions;
  for (const Expansion& expansion : expansions) {
    const Vec2 at = point(expansion.state), parent = point(expansion.parent);
    put(svg, "<path class=\"parent\" d=\"M{:.1f} {:.1f}L{:.1f} {:.1f}\"/>\n", at.x, at.y, parent.x, parent.y);
  }
  for (std::size_t i = 0; i < expansions.size(); ++i) {
    const Vec2 at = point(expansions[i].state);
    put(svg,
        "<text class=\"label\" x=\"{0:.1f}\" y=\"{1:.1f}\"><tspan font-weight=\"700\">{2}</tspan> f {3:.2f}"
        "<tspan x=\"{0:.1f}\" dy=\"11\">{4:.2f} + {5:.2f}</tspan></text>\n",
        at.x, at.y + 17.0, i + 1, expansions[i].f, expansions[i].g, expansions[i].h);
  }
}

/// A ring at the start, disks at the goals.
void draw_ends(std::string& svg, const View& view, const PathPicture& picture) {
  std::vector<std::tuple<Vec2, const char*, const char*>> ends{{picture.start, "from", "from"}};
  for (const Vec2 goal : picture.goals) ends.emplace_back(goal, "goal", "to");
  for (const auto& [point, kind, name] : ends) {
    const Vec2 at = view(point);
    const bool right = at.x > edge_px + 0.8 * view.width();
    put(svg,
        "<circle class=\"{}\" cx=\"{:.2f}\" cy=\"{:.2f}\" r=\"6\"/>\n"
        "<text class=\"halo\" x=\"{:.2f}\" y=\"{:.2f}\"{}>{}</text>\n",
        kind, at.x, at.y, at.x + (right ? -11.0 : 11.0), at.y + 5.0, right ? " text-anchor=\"end\"" : "",
        name);
  }
}

/// A round length between a tenth and a quarter of the map.
double scale_length(double width_m) {
  const double power = std::pow(10.0, std::floor(std::log10(0.25 * width_m)));
  for (const double step : {5.0, 2.0}) {
    if (step * power <= 0.25 * width_m) return step * power;
  }
  return power;
}

void draw_legend(std::string& svg, const View& view, const PathPicture& picture) {
  double y = 2.0 * edge_px + view.height() + 12.0;
  const double length_m = scale_length(view.frame.width * view.frame.resolution_m);
  const double right = edge_px + view.width();
  put(svg,
      "<path class=\"scale\" d=\"M{0:.2f} {1:.2f}v6H{2:.2f}v-6\"/>\n"
      "<text x=\"{3:.2f}\" y=\"{4:.2f}\" text-anchor=\"end\">{5:g} m</text>\n",
      right - view.px(length_m), y - 9.0, right, right, y + 15.0, length_m);
  for (std::size_t i = 0; i < picture.paths.size(); ++i, y += line_px) {
    put(svg,
        "<path stroke=\"{}\" stroke-width=\"4\" d=\"M{} {:.2f}h28\"/>\n"
        "<text x=\"{}\" y=\"{:.2f}\">{}  {:.2f} m</text>\n",
        colours[i % colours.size()], edge_px, y - 5.0, edge_px + 38.0, y, picture.paths[i].name,
        length_of(picture.paths[i].plan));
  }
}

}  // namespace

std::string to_svg(const PathPicture& picture) {
  const GridFrame& frame = picture.blocked.frame;
  const View view{frame, map_px / std::max(frame.width, frame.height)};
  const double width = std::max(view.width(), 360.0) + 2.0 * edge_px;
  const double height =
      view.height() + 3.0 * edge_px + line_px * std::max(1.2, static_cast<double>(picture.paths.size()));
  std::string svg = fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0:.0f}\" height=\"{1:.0f}\" viewBox=\"0 0 {0:.0f} "
      "{1:.0f}\">\n",
      width, height);
  svg +=
      "<style>\n"
      "svg{background:#fbfbf9;font:15px system-ui,sans-serif}.free{fill:#fff}.near{fill:#e3e6e2}"
      ".solid{fill:#4a4f55;stroke:#4a4f55;stroke-linejoin:round;stroke-linecap:round}.solid[transform]{"
      "stroke:none}"
      ".path{fill:none;stroke-linejoin:round;stroke-linecap:round}.scale{fill:none;stroke:#333}"
      "text{fill:#222}.halo{paint-order:stroke;stroke:#fff;stroke-width:4px;font-weight:600}"
      ".dot{fill:none;stroke-linecap:round}.parent{stroke:#8a5a00;stroke-width:1}"
      ".label{font-size:10px;text-anchor:middle;paint-order:stroke;stroke:#fff;stroke-width:3px}"
      ".from{fill:#fff;stroke:#222;stroke-width:3}.goal{fill:#222;stroke:#fff;stroke-width:2}\n"
      "@media(prefers-color-scheme:dark){svg{background:#16181b}.free{fill:#202327}.near{fill:#33383d}"
      ".solid{fill:#8d949b;stroke:#8d949b}.scale{stroke:#ccc}text{fill:#e6e6e6}.halo,.label{stroke:#202327}}"
      "\n"
      "</style>\n";
  put(svg,
      "<clipPath id=\"map\"><rect x=\"{0}\" y=\"{0}\" width=\"{1:.2f}\" height=\"{2:.2f}\"/></clipPath>\n",
      edge_px, view.width(), view.height());
  put(svg,
      "<g clip-path=\"url(#map)\">\n<rect class=\"free\" x=\"{0}\" y=\"{0}\" width=\"{1:.2f}\" "
      "height=\"{2:.2f}\"/>\n",
      edge_px, view.width(), view.height());
  draw_cells(svg, view, picture.blocked, "near");
  draw_cells(svg, view, picture.occupied, "solid");
  for (const RoundedPolygon& shape : picture.obstacles) draw_obstacle(svg, view, shape);
  svg += "</g>\n";
  if (picture.ground) draw_dots(svg, view, picture);
  for (std::size_t i = 0; i < picture.paths.size(); ++i) draw_path(svg, view, picture, i);
  const bool room = view.cell_px >= least_label_px;
  if (picture.ground && room) draw_labels(svg, view, picture);
  draw_ends(svg, view, picture);
  draw_legend(svg, view, picture);
  return svg + "</svg>\n";
}

}  // namespace outrider
