#include "svg_pursuit.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>

#include "runs.hpp"
#include "text.hpp"

namespace outrider {
namespace {

constexpr double width_px = 900.0;
constexpr double chart_px = 190.0;
constexpr std::size_t most_frames = 600;
constexpr std::string_view wall_colour = "#3f454b", target_colour = "#c2185b", bound_colour = "#00785a";
constexpr std::array<std::string_view, 8> cost_colours = {"#fbfaf5", "#f4ecd4", "#ecdcae", "#e0c88a",
                                                          "#d0b06a", "#b9944f", "#9c783a", "#7d5c28"};
constexpr std::array<std::string_view, 6> robot_colours = {"#0a6cc4", "#d55e00", "#009e73",
                                                           "#7c4d9e", "#56b4e9", "#333333"};

using Points = std::vector<Vec2>;

/// Costs from which each colour begins: every cost its own where they are few, else equal shares of cells.
std::vector<double> levels_of(const ReportPursuit& pursuit) {
  std::vector<std::pair<double, double>> counts;  // cost, cells
  double cells = 0.0;
  for (std::size_t i = 0; i + 1 < pursuit.cost_runs.size(); i += 2) {
    if (!(pursuit.cost_runs[i] >= 0.0 && pursuit.cost_runs[i + 1] > 0.0)) continue;  // walls, and NaN
    counts.emplace_back(pursuit.cost_runs[i], pursuit.cost_runs[i + 1]);
    cells += pursuit.cost_runs[i + 1];
  }
  std::ranges::sort(counts);
  std::vector<double> distinct;
  for (const auto& [cost, count] : counts) {
    if (distinct.empty() || cost > distinct.back()) distinct.push_back(cost);
  }
  if (distinct.size() <= cost_colours.size()) return distinct;
  std::vector<double> levels{distinct.front()};
  double before = 0.0;
  for (const auto& [cost, count] : counts) {
    const double share = static_cast<double>(levels.size()) / static_cast<double>(cost_colours.size());
    if (before >= share * cells && cost > levels.back()) levels.push_back(cost);
    before += count;
  }
  return levels;
}

/// Rectangles for each run of cells of one colour, three at most: its first row, whole rows, its last row; a
/// path for each colour. Nothing where the runs do not fill the map.
std::string cost_map(const ReportPursuit& pursuit, double px) {
  if (fault_of_runs(pursuit.cost_runs, pursuit.columns, pursuit.rows)) return {};
  const std::vector<double> levels = levels_of(pursuit);
  std::vector<std::string> paths(levels.size() + 1);  // the last: walls
  double at = 0.0;
  for (std::size_t i = 0; i + 1 < pursuit.cost_runs.size(); i += 2) {
    const double cost = pursuit.cost_runs[i];
    const auto level = std::upper_bound(levels.begin(), levels.end(), cost) - levels.begin();
    std::string& path =
        cost < 0.0 ? paths.back() : paths[static_cast<std::size_t>(std::max<std::ptrdiff_t>(1, level)) - 1];
    for (double left = pursuit.cost_runs[i + 1]; left >= 1.0;) {
      const double column = std::fmod(at, pursuit.columns), row = std::floor(at / pursuit.columns);
      const double run = std::min(left, pursuit.columns - column);
      const double rows = run < pursuit.columns ? 1.0 : std::floor(left / run);
      fmt::format_to(std::back_inserter(path), "M{:.2f} {:.2f}h{:.2f}v{:.2f}h-{:.2f}z", column * px,
                     (pursuit.rows - row - rows) * px, run * px, rows * px, run * px);
      at += run * rows;
      left -= run * rows;
    }
  }
  std::string svg;
  const std::size_t last = std::max<std::size_t>(1, levels.size() - 1);
  for (std::size_t i = 0; i < paths.size(); ++i) {
    const auto colour =
        i + 1 == paths.size() ? wall_colour : cost_colours[i * (cost_colours.size() - 1) / last];
    if (!paths[i].empty()) svg += fmt::format("<path fill=\"{}\" d=\"{}\"/>\n", colour, paths[i]);
  }
  return svg;
}

std::string polyline(const Points& points, std::string_view colour, double width,
                     std::string_view more = {}) {
  std::string svg = "<polyline fill=\"none\" points=\"";
  for (std::size_t i = 0; i < points.size(); ++i) {
    const bool straight = i > 0 && i + 1 < points.size() &&
                          std::abs(cross(points[i] - points[i - 1], points[i + 1] - points[i])) < 1e-9 &&
                          dot(points[i] - points[i - 1], points[i + 1] - points[i]) > 0.0;
    if (!straight) fmt::format_to(std::back_inserter(svg), "{:.1f},{:.1f} ", points[i].x, points[i].y);
  }
  return svg + fmt::format("\" stroke=\"{}\" stroke-width=\"{}\" stroke-linejoin=\"round\"{}/>\n", colour,
                           width, more);
}

/// A dot that is where the points are, one after the other in equal times; it stays at the last.
std::string moving_dot(const Points& points, std::size_t frames, std::size_t every, std::string_view colour,
                       double seconds) {
  std::string x, y;
  for (std::size_t f = 0; f < frames; ++f) {
    const Vec2 p = points[std::min(f * every, points.size() - 1)];
    fmt::format_to(std::back_inserter(x), "{}{:.1f}", f == 0 ? "" : ";", p.x);
    fmt::format_to(std::back_inserter(y), "{}{:.1f}", f == 0 ? "" : ";", p.y);
  }
  return fmt::format(
      "<circle r=\"6\" cx=\"{:.1f}\" cy=\"{:.1f}\" fill=\"{}\" stroke=\"#fff\" stroke-width=\"1.5\">"
      "<animate attributeName=\"cx\" dur=\"{}s\" repeatCount=\"indefinite\" values=\"{}\"/>"
      "<animate attributeName=\"cy\" dur=\"{}s\" repeatCount=\"indefinite\" values=\"{}\"/></circle>\n",
      points.back().x, points.back().y, colour, seconds, x, seconds, y);
}

std::string label(Vec2 at, std::string_view text, std::string_view more = {}) {
  return fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\"{}>{}</text>\n", at.x, at.y, more, text);
}

struct Line {
  std::string name;
  std::string_view colour;
  Points points;  ///< in the units of the axes
};

constexpr double headroom = 18.0;  // above the largest value, for its number

/// Lines over an axis from 0; the legend stands above.
std::string chart(Vec2 corner, Vec2 size, std::string_view unit, const std::vector<Line>& lines) {
  Vec2 most{1e-9, 1e-9};
  for (const Line& line : lines) {
    for (const Vec2 p : line.points) most = {std::max(most.x, p.x), std::max(most.y, p.y)};
  }
  const Vec2 scale{size.x / most.x, (size.y - headroom) / most.y};
  std::string svg = fmt::format(
      "<rect x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" height=\"{:.1f}\" fill=\"#fff\" "
      "stroke=\"#d5dce1\"/>\n",
      corner.x, corner.y, size.x, size.y);
  double legend_x = corner.x;
  for (const Line& line : lines) {
    Points points;
    for (const Vec2 p : line.points) {
      points.push_back({corner.x + scale.x * p.x, corner.y + size.y - scale.y * p.y});
    }
    if (points.size() > 1) svg += polyline(points, line.colour, 2);
    if (points.size() == 1) {
      svg += fmt::format("<circle r=\"4\" cx=\"{:.1f}\" cy=\"{:.1f}\" fill=\"{}\"/>\n", points[0].x,
                         points[0].y, line.colour);
    }
    svg += label({legend_x, corner.y - 7.0}, line.name, fmt::format(" fill=\"{}\"", line.colour));
    legend_x += 8.2 * static_cast<double>(line.name.size()) + 14.0;
  }
  svg += label({corner.x, corner.y + size.y + 15.0}, fmt::format("0 {}", unit));
  svg += label({corner.x + size.x, corner.y + size.y + 15.0}, fmt::format("{:.0f} {}", most.x, unit),
               " text-anchor=\"end\"");
  return svg + label({corner.x + 4.0, corner.y + 13.0}, fmt::format("{:.0f}", most.y));
}

/// A staircase: a value holds until the next.
Points steps(const std::vector<ReportBound>& bounds, double ReportBound::* x, double ReportBound::* y) {
  Points points;
  for (const ReportBound& bound : bounds) {
    if (!std::isfinite(bound.*x) || !std::isfinite(bound.*y)) continue;
    const Vec2 next{bound.*x, bound.*y};
    if (!points.empty() && points.back() == next) continue;
    if (!points.empty()) points.push_back({next.x, points.back().y});
    points.push_back(next);
  }
  return points;
}

std::string charts(const ReportPursuit& pursuit, double top) {
  const double half = 0.5 * (width_px - 60.0);
  const auto& bounds = pursuit.bounds;
  Points paid;
  for (std::size_t s = 0; s < pursuit.paid.size(); ++s)
    paid.push_back({static_cast<double>(s), pursuit.paid[s]});
  const double end = paid.empty() ? 0.0 : paid.back().x;
  const auto held = [&](double ReportBound::* value) {
    Points points = steps(bounds, &ReportBound::time_s, value);
    if (!points.empty() && points.back().x < end) points.push_back({end, points.back().y});
    return points;
  };
  const Vec2 size{half, chart_px - 70.0};
  std::string svg = chart({20.0, top + 34.0}, size, "s",
                          {{"paid", robot_colours[0], paid},
                           {"best catch known", target_colour, held(&ReportBound::cost)},
                           {"lower bound", bound_colour, held(&ReportBound::lower_bound)}});
  const Points cost = steps(bounds, &ReportBound::expansions, &ReportBound::cost);
  if (cost.empty()) return svg;
  return svg + chart({40.0 + half, top + 34.0}, size, "expansions of planning",
                     {{"best catch known", target_colour, cost},
                      {"lower bound", bound_colour,
                       steps(bounds, &ReportBound::expansions, &ReportBound::lower_bound)}});
}

}  // namespace

std::string pursuit_picture(const PageReport& report, double seconds) {
  const ReportPursuit& pursuit = *report.pursuit;
  const double px = width_px / std::max(1, pursuit.columns);
  const double map_height = px * pursuit.rows;
  const auto drawn = [&](const Points& way) {
    Points points;
    for (const Vec2 p : way) {
      points.push_back({px / pursuit.cell_m * (p.x - report.bounds.low.x),
                        map_height - px / pursuit.cell_m * (p.y - report.bounds.low.y)});
    }
    return points;
  };
  std::string svg = fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {0:.0f} {1:.0f}\" width=\"{0:.0f}\" "
      "height=\"{1:.0f}\" font-family=\"sans-serif\" font-size=\"13\" fill=\"#222\">\n<title>{2}</title>\n"
      "<rect width=\"100%\" height=\"100%\" fill=\"#fbfcfc\"/>\n<g shape-rendering=\"crispEdges\">\n",
      width_px, map_height + chart_px, markup_text(report.job + ": " + report.world_name));
  svg += cost_map(pursuit, px) + "</g>\n";
  const Points target = drawn(pursuit.target);
  std::size_t longest = 1;
  for (const auto& way : pursuit.robots) longest = std::max(longest, way.size());
  const std::size_t every = (longest + most_frames - 1) / most_frames;
  const std::size_t frames = (longest + every - 1) / every + 1;
  if (!target.empty()) {
    const Points seen(target.begin(),
                      target.begin() + static_cast<std::ptrdiff_t>(std::min(longest, target.size())));
    svg += polyline(target, target_colour, 1.5, " stroke-dasharray=\"2 4\" opacity=\"0.7\"");
    svg += polyline(seen, target_colour, 2.5) + moving_dot(seen, frames, every, target_colour, seconds);
  }
  for (std::size_t i = 0; i < pursuit.robots.size(); ++i) {
    const Points way = drawn(pursuit.robots[i]);
    if (way.empty()) continue;
    const std::string_view colour = robot_colours[i % robot_colours.size()];
    svg += polyline(way, colour, 3);
    svg += fmt::format(
        "<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"5\" fill=\"#fff\" stroke=\"{}\" stroke-width=\"2.5\"/>\n",
        way.front().x, way.front().y, colour);
    svg += moving_dot(way, frames, every, colour, seconds);
  }
  return svg + charts(pursuit, map_height) + "</svg>\n";
}

}  // namespace outrider
