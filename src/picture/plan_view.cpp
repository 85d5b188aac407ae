#include "outrider/picture/plan_view.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "draw.hpp"
#include "outrider/core/text.hpp"
#include "outrider/log/append.hpp"
#include "outrider/log/conversions.hpp"
#include "outrider/log/topics.hpp"

namespace outrider {
namespace {

using namespace picture;

constexpr double margin_px = 20.0, head_px = 48.0, most_aspect = 0.8;

constexpr std::string_view style = R"(<style>
text{font:13px system-ui,-apple-system,"Segoe UI","Noto Sans","DejaVu Sans",sans-serif;fill:#15212b}
.title{font-size:19px;font-weight:650}.soft{fill:#566470}
.name{font-size:12px;paint-order:stroke;stroke:#fff;stroke-width:3px;stroke-linejoin:round}
path{fill:none;stroke-linejoin:round;stroke-linecap:round}
.frame{stroke:#d5dce1}.scale{stroke:#15212b;stroke-width:1.5}.grid{stroke:#15212b;stroke-opacity:.07}
.cells{shape-rendering:crispEdges}.unknown{fill:#e4e8eb}.full{fill:#4d5c68}.close{fill:#f3ded3}.rim{stroke:#f3ded3}
.beyond{fill:#d5dce1}.reach{fill:#f8efd9}.strip{stroke:#00785a;stroke-opacity:.25}.covered{fill:#b9d1ba}
.overlap{fill:#00785a;fill-opacity:.3}.missed{fill:#c54c06}.border{stroke:#15212b;stroke-width:1.2}
.steep{fill:#c54c06;fill-opacity:.13}.contour{stroke:#5f7d46}.solid{stroke-width:.6}.truth{fill:#15212b;fill-opacity:.14}
.overhead{fill:#566470;fill-opacity:.16;stroke:#566470;stroke-dasharray:4 3}
.planned{stroke:#a9cdea;stroke-width:5;stroke-opacity:.75}.reference{stroke:#00785a;stroke-width:1.8;stroke-dasharray:1.5 4}
.odometry{stroke:#566470;stroke-opacity:.6}.target{stroke:#c54c06;stroke-width:2.4}
.track{stroke-width:2.3}.arrow{stroke:#15212b;stroke-width:1.4}.loop{stroke:#0a6cc4;stroke-opacity:.8}
.belief{stroke:#97237f;stroke-width:1.5;stroke-dasharray:5 3}.doubt{stroke:#97237f;stroke-opacity:.7;fill:#97237f;fill-opacity:.08}
.robot{stroke-width:2;stroke:#6b4000;fill-opacity:.7}.start{fill:#fff}.end{fill:#f0a52b}
.landmark{stroke:#00785a;fill:#00785a;fill-opacity:.15}.dot{fill-opacity:1;stroke:none}.true{stroke:#15212b;stroke-width:1.6}
.tag{fill:#15212b;stroke:#15212b;stroke-width:2}.goal{stroke:#0a6cc4;stroke-width:1.6}.refused{stroke:#7c4d9e;stroke-width:2}
.waypoint{fill:#fff;stroke:#0a6cc4;stroke-width:2}.missing{stroke:#c54c06}.water{fill:#0a6cc4}.charge{fill:#e69f00;stroke:#fff}
.shot{stroke:#0a6cc4;stroke-width:1.2}.miss{stroke:#c54c06;stroke-dasharray:4 3}.walk{stroke:#566470;stroke-dasharray:2 3}
.box{fill:#566470;fill-opacity:.3}.sign{stroke:#fff;stroke-width:1.5}.check{stroke:#fff;stroke-width:1.9}
.reached{fill:#00785a}.failed{fill:#c54c06}.unreachable{fill:#7c4d9e}.waiting{fill:#fff;stroke:#566470;stroke-width:2}
</style>
)";

/// Returns a round length that is drawn between 45 and 113 px long, m.
double grid_step(double px_per_m) {
  const double least_m = 45.0 / px_per_m, power = std::pow(10.0, std::floor(std::log10(least_m)));
  return least_m <= power         ? power
         : least_m <= 2.0 * power ? 2.0 * power
         : least_m <= 5.0 * power ? 5.0 * power
                                  : 10.0 * power;
}

void draw_grid(Sheet& sheet, double step_m) {
  const auto& [low, high] = sheet.box;
  std::string path;
  for (double x = std::ceil(low.x / step_m) * step_m; x < high.x; x += step_m)
    path += sheet.line({{x, low.y}, {x, high.y}});
  for (double y = std::ceil(low.y / step_m) * step_m; y < high.y; y += step_m)
    path += sheet.line({{low.x, y}, {high.x, y}});
  sheet.put("grid", path);
}

void draw(Sheet& sheet, const Log& log) {
  draw_cells(sheet, log);
  if (!sheet.box.empty()) draw_grid(sheet, grid_step(sheet.px_per_m));
  draw_ground(sheet, log);
  draw_lines(sheet, log);
  draw_marks(sheet, log);
}

/// Returns the corners that the run gives, or else the box of everything that can be drawn; with the true
/// track.
Box2 drawn_box(const Log& log) {
  Box2 box;
  if (const auto* info = log.latest<outrider_msgs::RunInfo>(topic::run))
    box = {vec2_of(info->low), vec2_of(info->high)};
  if (!finite(box.low) || !finite(box.high) || box.empty()) {
    Sheet probe{.box = {}, .detail_px = 1e9};
    draw(probe, log);
    box =
        probe.seen.empty() ? Box2{{0.0, 0.0}, {0.0, 0.0}} : probe.seen.grown(0.03 * norm(probe.seen.size()));
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
      "<tspan class=\"soft\" dx=\"12\">{2}</tspan></text>\n<path class=\"scale\" d=\"M{3:.1f} "
      "22v5h{4:.1f}v-5\"/>\n"
      "<text class=\"soft\" text-anchor=\"end\" x=\"{5:.1f}\" y=\"29\">{6:g} m</text>\n",
      escaped(title), margin_px, log.end_s() > 0.0 ? duration_text(log.end_s()) : "", left_px,
      step_m * px_per_m, left_px - 8.0, step_m);
}

std::string drawn(const Log& log, double width_px, const Box2& box, double detail_px) {
  const double room_px = width_px - 2.0 * margin_px;
  Sheet sheet{.box = box,
              .px_per_m = std::min(room_px / box.size().x, most_aspect * room_px / box.size().y),
              .detail_px = detail_px};
  draw(sheet, log);
  const Vec2 plan_px = sheet.px_per_m * box.size();
  double legend_px = 0.0;
  const std::string legend = sheet.legend(margin_px, head_px + plan_px.y + 16.0, room_px, legend_px);
  return fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{width:.0f}\" height=\"{height:.0f}\" viewBox=\"0 0 "
      "{width:.0f} "
      "{height:.0f}\" role=\"img\">\n{}<rect width=\"100%\" height=\"100%\" fill=\"#fff\"/>\n{}"
      "<svg x=\"{x:.1f}\" y=\"{y}\" width=\"{w:.1f}\" height=\"{h:.1f}\">\n{}{}</svg>\n"
      "<path class=\"frame\" d=\"M{x:.1f} {y}h{w:.1f}v{h:.1f}h-{w:.1f}Z\"/>\n{}</svg>\n",
      style, head(log, width_px, sheet.px_per_m), sheet.body, sheet.names, legend,
      fmt::arg("width", width_px), fmt::arg("height", head_px + plan_px.y + legend_px + 26.0),
      fmt::arg("x", 0.5 * (width_px - plan_px.x)), fmt::arg("y", head_px), fmt::arg("w", plan_px.x),
      fmt::arg("h", plan_px.y));
}

}  // namespace

std::string plan_view(const Log& log, const PlanViewOptions& options) {
  const Box2 box = drawn_box(log);
  double detail_px = 0.3;
  std::string svg;
  do {
    svg = drawn(log, std::max(options.width_px, 200.0), box, detail_px);
    detail_px *= 2.0;
  } while (svg.size() > options.most_bytes && detail_px < 100.0);
  return svg;
}

}  // namespace outrider
