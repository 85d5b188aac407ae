#include "outrider/picture/plan_view.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "outrider/core/text.hpp"
#include "outrider/log/append.hpp"
#include "outrider/log/messages/conversions.hpp"
#include "outrider/log/topics.hpp"
#include "sheet.hpp"

namespace outrider {
namespace {

using namespace picture;

constexpr double margin_px = 20.0, head_px = 48.0, most_aspect = 0.8;

/// Returns the style sheet of the looks, and their symbols.
std::string styles() {
  std::string css =
      "svg{fill:none;stroke-linejoin:round;stroke-linecap:round}\n"
      "text{font:13px system-ui,-apple-system,\"Segoe UI\",\"Noto Sans\",\"DejaVu "
      "Sans\",sans-serif;fill:#15212b}\n"
      ".title{font-size:19px;font-weight:650}.soft{fill:#566470}\n"
      ".name{font-size:12px;paint-order:stroke;stroke:#fff;stroke-width:3px}\n";
  std::string symbols;
  for (const Look& look : looks) {
    css += fmt::format(".{}{{{}}}\n", look.kind, look.css);
    if (!look.symbol.empty()) symbols += fmt::format("<path id=\"{}\" d=\"{}\"/>\n", look.kind, look.symbol);
  }
  return fmt::format("<style>\n{}</style>\n<defs>\n{}</defs>\n", css, symbols);
}

/// Returns a round length that is drawn between 45 and 113 px long, m.
double grid_step(double px_per_m) {
  const double least_m = 45.0 / px_per_m, power = std::pow(10.0, std::floor(std::log10(least_m)));
  return least_m <= power         ? power
         : least_m <= 2.0 * power ? 2.0 * power
         : least_m <= 5.0 * power ? 5.0 * power
                                  : 10.0 * power;
}

void draw_grid(Sheet& sheet, const Box2& box, double step_m) {
  const auto& [low, high] = box;
  for (double x = std::ceil(low.x / step_m) * step_m; x < high.x; x += step_m)
    sheet.line("grid", std::array{Vec2{x, low.y}, Vec2{x, high.y}});
  for (double y = std::ceil(low.y / step_m) * step_m; y < high.y; y += step_m)
    sheet.line("grid", std::array{Vec2{low.x, y}, Vec2{high.x, y}});
}

/// Returns the corners that the run gives, or else the box of everything that can be drawn; with the true
/// track.
Box2 drawn_box(const Log& log) {
  Box2 box;
  if (const auto* info = log.latest<outrider_msgs::RunInfo>(topic::run))
    box = {vec2_of(info->low), vec2_of(info->high)};
  if (!finite(box.low) || !finite(box.high) || box.empty()) {
    Sheet probe({{0.0, 0.0}, {0.0, 0.0}}, 1.0, 1e-3);
    draw_ground(probe, log);
    draw_events(probe, log);
    box = probe.seen().empty() ? Box2{{0.0, 0.0}, {0.0, 0.0}}
                               : probe.seen().grown(0.03 * norm(probe.seen().size()));
  }
  for (const Pose2& pose : poses_of(log)) {
    if (finite(pose)) box.include(pose.position);
  }
  return box.size().x > 0.0 && box.size().y > 0.0 ? box : box.grown(1.0);
}

/// Returns the name of the run, its duration, and a bar as long as a step of the grid.
std::string head(const Log& log, double width_px, double px_per_m) {
  const auto* info = log.latest<outrider_msgs::RunInfo>(topic::run);
  std::string title =
      info == nullptr ? "" : info->job + (info->job.empty() || info->world.empty() ? "" : ": ") + info->world;
  if (title.empty()) title = "Plan view";
  const double step_m = grid_step(px_per_m), left_px = width_px - margin_px - step_m * px_per_m;
  return fmt::format(
      "<title>{0}</title>\n<text x=\"{1}\" y=\"30\"><tspan class=\"title\">{0}</tspan>"
      "<tspan class=\"soft\" dx=\"12\">{2}</tspan></text>\n<path stroke=\"#15212b\" stroke-width=\"1.5\" "
      "d=\"M{3:.1f} "
      "22v5h{4:.1f}v-5\"/>\n"
      "<text class=\"soft\" text-anchor=\"end\" x=\"{5:.1f}\" y=\"29\">{6:g} m</text>\n",
      markup_text(title), margin_px, log.end_s() > 0.0 ? duration_text(log.end_s()) : "", left_px,
      step_m * px_per_m, left_px - 8.0, step_m);
}

std::string drawn(const Log& log, double width_px, const Box2& box, double detail_px) {
  const double room_px = width_px - 2.0 * margin_px;
  const double px_per_m = std::min(room_px / box.size().x, most_aspect * room_px / box.size().y);
  const Vec2 plan_px = px_per_m * box.size();
  Sheet sheet(box, px_per_m, detail_px);
  draw_ground(sheet, log);
  draw_events(sheet, log);
  draw_grid(sheet, box, grid_step(px_per_m));
  double legend_px = 0.0;
  const std::string legend = sheet.legend(margin_px, head_px + plan_px.y + 16.0, room_px, legend_px);
  return fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{width:.0f}\" height=\"{height:.0f}\" viewBox=\"0 0 "
      "{width:.0f} "
      "{height:.0f}\" role=\"img\">\n{}<rect width=\"100%\" height=\"100%\" fill=\"#fff\"/>\n{}"
      "<svg x=\"{x:.1f}\" y=\"{y}\" width=\"{w:.1f}\" height=\"{h:.1f}\">\n{}</svg>\n"
      "<path stroke=\"#d5dce1\" d=\"M{x:.1f} {y}h{w:.1f}v{h:.1f}h-{w:.1f}Z\"/>\n{}</svg>\n",
      styles(), head(log, width_px, px_per_m), sheet.drawing(), legend, fmt::arg("width", width_px),
      fmt::arg("height", head_px + plan_px.y + legend_px + 26.0), fmt::arg("x", 0.5 * (width_px - plan_px.x)),
      fmt::arg("y", head_px), fmt::arg("w", plan_px.x), fmt::arg("h", plan_px.y));
}

}  // namespace

std::string plan_view(const Log& log, const PlanViewOptions& options) {
  const Box2 box = drawn_box(log);
  double detail_px = 0.25;
  std::string svg;
  do {
    svg = drawn(log, std::max(options.width_px, 200.0), box, detail_px);
    detail_px *= 2.0;
  } while (svg.size() > options.most_bytes && detail_px < 100.0);
  return svg;
}

}  // namespace outrider
