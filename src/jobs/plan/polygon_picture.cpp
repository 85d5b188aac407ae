#include "polygon_picture.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <iterator>

namespace outrider {
namespace {

constexpr double width_px = 900.0;
constexpr double line_px = 22.0;  // of the legend
constexpr std::array<const char*, 10> colours = {"#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00",
                                                 "#56b4e9", "#882255", "#117733", "#332288", "#999933"};

/// World to picture: metres to pixels, y down.
struct View {
  Vec2 low;
  Vec2 high;
  double scale;

  [[nodiscard]] Vec2 at(Vec2 p) const { return {scale * (p.x - low.x), scale * (high.y - p.y)}; }
};

std::string outline(const View& view, const std::vector<Vec2>& polygon) {
  std::string d;
  for (const Vec2 corner : polygon) {
    const Vec2 p = view.at(corner);
    fmt::format_to(std::back_inserter(d), "{}{:.2f} {:.2f}", d.empty() ? 'M' : 'L', p.x, p.y);
  }
  return d + "Z";
}

std::string line(const View& view, const std::vector<Segment>& segments) {
  std::string d;
  for (const Segment& s : segments) {
    const Vec2 a = view.at(s.a), b = view.at(s.b);
    fmt::format_to(std::back_inserter(d), "M{:.2f} {:.2f}L{:.2f} {:.2f}", a.x, a.y, b.x, b.y);
  }
  return d;
}

/// The pieces with true arcs, or the waypoints where there are none.
std::string way(const View& view, const Plan& plan) {
  const Vec2 start = view.at(plan.waypoints.front());
  std::string d = fmt::format("M{:.3f} {:.3f}", start.x, start.y);
  for (const PathPiece& piece : plan.pieces) {
    const Vec2 to = view.at(piece.to);
    if (piece.turn_rad == 0.0) {
      fmt::format_to(std::back_inserter(d), "L{:.3f} {:.3f}", to.x, to.y);
      continue;
    }
    const double radius = view.scale * distance(piece.centre, piece.from);
    fmt::format_to(std::back_inserter(d), "A{0:.3f} {0:.3f} 0 {1} {2} {3:.3f} {4:.3f}", radius,
                   std::abs(piece.turn_rad) > 3.14159 ? 1 : 0, piece.turn_rad < 0.0 ? 1 : 0, to.x, to.y);
  }
  for (std::size_t i = 1; plan.pieces.empty() && i < plan.waypoints.size(); ++i) {
    const Vec2 to = view.at(plan.waypoints[i]);
    fmt::format_to(std::back_inserter(d), "L{:.3f} {:.3f}", to.x, to.y);
  }
  return d;
}

/// One rectangle a run of blocked cells.
std::string cells(const View& view, const Grid<std::uint8_t>& blocked) {
  std::string d;
  const double side = view.scale * blocked.frame.resolution_m;
  for (int y = 0; y < blocked.frame.height; ++y) {
    for (int x = 0; x < blocked.frame.width; ++x) {
      const int first = x;
      while (x < blocked.frame.width && blocked[{x, y}] != 0) ++x;
      if (x == first) continue;
      const Vec2 p = view.at(blocked.frame.corner({first, y + 1}));
      fmt::format_to(std::back_inserter(d), "M{0:.2f} {1:.2f}h{2:.2f}v{3:.2f}h-{2:.2f}z", p.x, p.y,
                     (x - first) * side, side);
    }
  }
  return d;
}

void draw_ground(std::string& svg, const View& view, const PolygonPicture& picture, Vec2 size) {
  const PolygonGround& ground = *picture.ground;
  const std::string boundary = outline(view, ground.boundary);
  const double grown = 2.0 * view.scale * ground.radius_m;
  const auto add = [&](const std::string& d, std::string_view style) {
    fmt::format_to(std::back_inserter(svg), "<path d=\"{}\" {}/>\n", d, style);
  };
  fmt::format_to(
      std::back_inserter(svg),
      "<clipPath id=\"inside\"><path d=\"{}\"/></clipPath>\n"
      "<rect width=\"{:.2f}\" height=\"{:.2f}\" fill=\"#4a4f55\"/>\n<g clip-path=\"url(#inside)\">\n",
      boundary, size.x, size.y);
  const std::string ring =
      fmt::format("stroke=\"#cfd2cc\" stroke-width=\"{:.3f}\" stroke-linejoin=\"round\"", grown);
  add(boundary, "fill=\"#fbfbf9\"");
  if (picture.blocked != nullptr) add(cells(view, *picture.blocked), "fill=\"#e8d9b8\"");
  add(boundary, "fill=\"none\" " + ring);
  for (const auto& obstacle : ground.obstacles) add(outline(view, obstacle), "fill=\"#cfd2cc\" " + ring);
  for (const auto& obstacle : ground.obstacles) add(outline(view, obstacle), "fill=\"#4a4f55\"");
  add(line(view, picture.legs),
      "fill=\"none\" stroke=\"#5a6068\" stroke-width=\"0.8\" stroke-opacity=\"0.7\"");
  svg += "</g>\n";
}

}  // namespace

std::string polygon_picture(const PolygonPicture& picture) {
  Box2 box = picture.ground->bounds;
  box = box.grown(0.02 * std::max(box.size().x, box.size().y));
  const View view{box.low, box.high, width_px / box.size().x};
  const Vec2 size = view.scale * box.size();
  const double height = size.y + line_px * (static_cast<double>(picture.ways.size()) + 0.6);
  std::string svg = fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0:.0f}\" height=\"{1:.0f}\" viewBox=\"0 0 {0:.2f} "
      "{1:.2f}\">\n<rect width=\"100%\" height=\"100%\" fill=\"#ffffff\"/>\n",
      size.x, height);
  draw_ground(svg, view, picture, size);
  for (std::size_t i = 0; i < picture.ways.size(); ++i) {
    const Plan& plan = picture.ways[i].plan;
    const char* colour = colours[i % colours.size()];
    // Later ways are thinner, so that equal ones stay visible.
    const double stroke = 6.0 - 4.0 * static_cast<double>(i) / static_cast<double>(picture.ways.size());
    const double y = size.y + line_px * (static_cast<double>(i) + 0.9);
    const Vec2 start = view.at(plan.waypoints.front()), goal = view.at(plan.waypoints.back());
    fmt::format_to(
        std::back_inserter(svg),
        "<path d=\"{0}\" fill=\"none\" stroke=\"{1}\" stroke-width=\"{2:.2f}\" "
        "stroke-linejoin=\"round\" stroke-linecap=\"round\"/>\n"
        "<circle cx=\"{3:.2f}\" cy=\"{4:.2f}\" r=\"5\" fill=\"#fff\" stroke=\"{1}\" stroke-width=\"2\"/>"
        "<circle cx=\"{5:.2f}\" cy=\"{6:.2f}\" r=\"5\" fill=\"{1}\"/>\n"
        "<rect x=\"14\" y=\"{7:.2f}\" width=\"26\" height=\"4\" fill=\"{1}\"/>"
        "<text x=\"50\" y=\"{8:.2f}\" font-family=\"sans-serif\" font-size=\"14\" fill=\"#222\">{9}: "
        "{10:.3f} m</text>\n",
        way(view, plan), colour, stroke, start.x, start.y, goal.x, goal.y, y - 7.0, y, picture.ways[i].name,
        length_of(plan));
  }
  return svg + "</svg>\n";
}

}  // namespace outrider
