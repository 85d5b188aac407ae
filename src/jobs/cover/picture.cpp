#include "picture.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <utility>

namespace outrider {
namespace {

constexpr double size_px = 900.0;
constexpr double legend_px = 62.0;

/// World to picture: metres to pixels, y down.
struct View {
  Vec2 low;
  Vec2 high;
  double scale;

  [[nodiscard]] Vec2 at(Vec2 p) const { return {scale * (p.x - low.x), scale * (high.y - p.y)}; }
};

void add_ring(std::string& d, const View& view, const std::vector<Vec2>& ring) {
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Vec2 p = view.at(ring[i]);
    fmt::format_to(std::back_inserter(d), "{}{:.2f} {:.2f}", i == 0 ? 'M' : 'L', p.x, p.y);
  }
  d += 'Z';
}

std::string shape(const View& view, const Region& region, const char* style) {
  std::string d;
  for (const RingedPolygon& polygon : region) {
    add_ring(d, view, polygon.outer);
    for (const auto& hole : polygon.holes) add_ring(d, view, hole);
  }
  return fmt::format("<path d=\"{}\" fill-rule=\"evenodd\" {}/>\n", d, style);
}

/// The pieces of one role, with true arcs.
std::string pieces(const View& view, const CoverPlan& plan, PieceRole role, const char* style) {
  std::string d;
  for (std::size_t i = 0; i < plan.track.pieces.size(); ++i) {
    if (plan.roles[i] != role) continue;
    const PathPiece& piece = plan.track.pieces[i];
    const Vec2 from = view.at(piece.from), to = view.at(piece.to);
    fmt::format_to(std::back_inserter(d), "M{:.2f} {:.2f}", from.x, from.y);
    if (piece.turn_rad == 0.0) {
      fmt::format_to(std::back_inserter(d), "L{:.2f} {:.2f}", to.x, to.y);
      continue;
    }
    const double radius = view.scale * distance(piece.centre, piece.from);
    fmt::format_to(std::back_inserter(d), "A{0:.2f} {0:.2f} 0 {1} {2} {3:.2f} {4:.2f}", radius,
                   std::abs(piece.turn_rad) > 3.14159 ? 1 : 0, piece.turn_rad < 0.0 ? 1 : 0, to.x, to.y);
  }
  return fmt::format("<path d=\"{}\" fill=\"none\" stroke-linejoin=\"round\" {}/>\n", d, style);
}

std::string line(const View& view, const std::vector<Vec2>& points, const char* style) {
  std::string d;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Vec2 p = view.at(points[i]);
    fmt::format_to(std::back_inserter(d), "{}{:.2f} {:.2f}", i == 0 ? 'M' : 'L', p.x, p.y);
  }
  return fmt::format("<path d=\"{}\" fill=\"none\" {}/>\n", d, style);
}

std::string text_at(double x, double y, const std::string& text) {
  return fmt::format(
      "<text x=\"{:.0f}\" y=\"{:.0f}\" font-family=\"sans-serif\" font-size=\"14\" fill=\"#222\">{}</text>\n",
      x, y, text);
}

std::string legend(double y, const CoverPlan& plan, const Coverage& coverage) {
  const std::pair<const char*, std::string> entries[] = {
      {"#cfe3d4", fmt::format("covered {:.2f} %", 100.0 * coverage.fraction)},
      {"#8fbf9f", fmt::format("overlap {:.4g} m2", coverage.overlap_m2)},
      {"#d55e00", fmt::format("missed {:.2g} m2", coverage.missed_m2)},
      {"#332288", "laps"},
      {"#0072b2", "lanes"},
      {"#e69f00", "moves"}};
  std::string text;
  double x = 12.0;
  for (const auto& [colour, name] : entries) {
    fmt::format_to(std::back_inserter(text),
                   "<rect x=\"{:.0f}\" y=\"{:.0f}\" width=\"14\" height=\"14\" fill=\"{}\"/>", x, y + 14.0,
                   colour);
    text += text_at(x + 20.0, y + 26.0, name);
    x += 44.0 + 7.4 * static_cast<double>(name.size());
  }
  return text + text_at(12.0, y + 50.0,
                        fmt::format("{}: {:.2f} m, {} stops, {} laps, {} cells, {} lanes", plan.method,
                                    plan.sums.length_m, plan.sums.stops, plan.laps, plan.cells, plan.lanes));
}

}  // namespace

std::string cover_picture(const CoverPlan& plan, const Coverage& coverage, const std::vector<Vec2>& driven) {
  Box2 box = bounds_of(plan.ground.area);
  box = box.grown(0.02 * std::max(box.size().x, box.size().y));
  const View view{box.low, box.high, size_px / std::max(box.size().x, box.size().y)};
  const Vec2 size = view.scale * box.size();
  std::string svg = fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0:.0f}\" height=\"{1:.0f}\" viewBox=\"0 0 {0:.2f} "
      "{1:.2f}\">\n<rect width=\"100%\" height=\"100%\" fill=\"#ffffff\"/>\n"
      "<rect width=\"{2:.2f}\" height=\"{3:.2f}\" fill=\"#4a4f55\"/>\n",
      std::max(size.x, size_px), size.y + legend_px, size.x, size.y);
  const Vec2 start = view.at(plan.track.start.position);
  svg += shape(view, plan.ground.area, "fill=\"#f1e9dc\"");
  svg += shape(view, coverage.covered, "fill=\"#cfe3d4\"");
  svg += shape(view, coverage.overlap, "fill=\"#8fbf9f\"");
  svg += shape(view, coverage.missed, "fill=\"#d55e00\"");
  if (!driven.empty())
    svg += line(view, driven, "stroke=\"#111\" stroke-width=\"0.5\" stroke-opacity=\"0.6\"");
  svg += pieces(view, plan, PieceRole::lap, "stroke=\"#332288\" stroke-width=\"1.3\"");
  svg += pieces(view, plan, PieceRole::lane, "stroke=\"#0072b2\" stroke-width=\"1.3\"");
  svg += pieces(view, plan, PieceRole::move, "stroke=\"#e69f00\" stroke-width=\"1.3\"");
  fmt::format_to(std::back_inserter(svg),
                 "<circle cx=\"{:.2f}\" cy=\"{:.2f}\" r=\"5\" fill=\"#fff\" stroke=\"#332288\" "
                 "stroke-width=\"2\"/>\n",
                 start.x, start.y);
  return svg + legend(size.y, plan, coverage) + "</svg>\n";
}

}  // namespace outrider
