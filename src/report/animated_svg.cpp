#include <vector>

#include "outrider/report/pictures.hpp"
#include "svg_cover.hpp"
#include "svg_drive.hpp"
#include "svg_explore.hpp"
#include "svg_pursuit.hpp"
#include "svg_scene.hpp"
#include "svg_slam.hpp"
#include "text.hpp"

namespace outrider {
namespace {

constexpr double card_width_px = 720.0;
constexpr double pad_px = 18.0;
constexpr double strip_px = 40.0;  // under the plan: clock and counter
constexpr std::size_t most_bytes = 400'000;

Box2 drawn_area(const PageReport& report) {
  Box2 box = report.bounds;
  if (box.empty() || !std::isfinite(norm(box.size()))) {
    box = {};
    for (const ReportSolid& solid : report.solids) {
      for (const RoundedPolygon& piece : solid.footprint) {
        box.include(piece.bounds().low);
        box.include(piece.bounds().high);
      }
    }
    for (const TrackSample& sample : report.track) box.include(sample.pose.position);
    box.include(report.start.position);
    box = box.grown(0.5);
  }
  return box;
}

std::string caption(double x, double y, std::string_view anchor, std::string_view animation,
                    std::string_view text) {
  return fmt::format(R"svg(<text x="{}" y="{}" text-anchor="{}"{}>{}{}</text>)svg", number(x), number(y),
                     anchor, animation.empty() ? "" : R"svg( opacity="0")svg", animation, text);
}

// Clock, bar and counter below the plan.
std::string strip(const Scene& scene, double top_px) {
  const double base = top_px + 0.62 * strip_px;
  std::string text =
      R"svg(<g font-family="ui-monospace,SFMono-Regular,Menlo,Consolas,monospace" font-size="15" fill="#d6e0e8">)svg";
  constexpr int steps = 60;
  for (int i = 0; i < steps; ++i) {
    const double from = static_cast<double>(i) / steps;
    const auto seconds =
        static_cast<long long>(std::min(scene.clock.to_run(from * scene.clock.loop_s()), 1e9));
    const double to = static_cast<double>(i + 1) / steps;
    text += caption(pad_px, base, "start", scene.shown(from, to),
                    fmt::format("{}:{:02}", seconds / 60, seconds % 60));
  }
  std::vector<double> reached;
  for (const ReportTarget& target : scene.report.targets) {
    if (target.status == "reached" && std::isfinite(target.done_s))
      reached.push_back(scene.share(target.done_s));
  }
  std::ranges::sort(reached);
  const bool counts = !scene.report.targets.empty();
  for (std::size_t i = 0; counts && i <= reached.size(); ++i) {
    const double from = i == 0 ? 0.0 : reached[i - 1];
    const double to = i == reached.size() ? 1.0 : reached[i];
    if (to <= from) continue;
    text += caption(card_width_px - pad_px, base, "end", scene.shown(from, to),
                    fmt::format("{} / {} reached", i, scene.report.targets.size()));
  }
  text += "</g>";
  const double left = pad_px + 70.0;
  const double length = card_width_px - 2.0 * pad_px - 230.0;
  Frames grow;
  for (const double run_s : scene.clock.changes()) {
    grow.add(scene.share(run_s), number(length * run_s / scene.clock.end_s()));
  }
  grow.add(1.0, number(length));
  text += fmt::format(
      R"svg(<rect x="{x}" y="{y}" width="{}" height="3" rx="1.5" fill="#25343f"/><rect x="{x}" y="{y}" width="0" height="3" rx="1.5" fill="{}">{}</rect>)svg",
      number(length), robot_colour, scene.animate("width", grow), fmt::arg("x", number(left)),
      fmt::arg("y", number(base - 6.5)));
  for (const ReportShot& shot : scene.report.shots) {
    if (!can_be_drawn(shot)) continue;
    text += fmt::format(R"svg(<rect x="{}" y="{}" width="1.5" height="6" fill="{}"/>)svg",
                        number(left + length * shot.time_s / scene.clock.end_s()), number(base - 15.0),
                        shot.hit ? water : colour("failed"));
  }
  return text + "\n";
}

std::string drawn(const Scene& scene) {
  const double plan_px = scene.area.size().y * scene.scale;
  const double height_px = pad_px + plan_px + strip_px + 0.3 * pad_px;
  const Vec2 origin{pad_px - scene.area.low.x * scene.scale, pad_px + scene.area.high.y * scene.scale};
  std::string text = fmt::format(
      R"svg(<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {w} {h}" width="{w}" height="{h}" role="img">)svg"
      "\n<title>{title}</title>\n"
      R"svg(<rect width="{w}" height="{h}" rx="14" fill="#101820"/>)svg"
      "\n",
      fmt::arg("w", number(card_width_px)), fmt::arg("h", number(height_px)),
      fmt::arg("title", markup_text(scene.report.job + ": " + scene.report.world_name)));
  text += fmt::format(
      R"svg(<g transform="translate({}) scale({:.6g} {:.6g})"><rect x="{}" y="{}" width="{}" height="{}" fill="#15202a"/>)svg"
      "\n",
      point(origin), scene.scale, -scene.scale, number(scene.area.low.x), number(scene.area.low.y),
      number(scene.area.size().x), number(scene.area.size().y));
  text += yard(scene) + motion(scene) + "</g>\n";
  return text + strip(scene, pad_px + plan_px) + "</svg>\n";
}

}  // namespace

std::string to_animated_svg(const PageReport& report, double seconds) {
  const double loop_s = std::isfinite(seconds) ? std::clamp(seconds, 1.0, 600.0) : 20.0;
  if (report.pursuit) return pursuit_picture(report, loop_s);
  if (report.cover) return cover_picture(report, loop_s);
  if (report.drive) return drive_picture(report);
  if (report.slam) return slam_picture(report, loop_s);
  if (report.explore && report.shots.empty()) return explore_picture(report, loop_s);
  Scene scene{.report = report, .clock = LoopClock(report, loop_s), .area = drawn_area(report)};
  const double across_m = std::max(scene.area.size().x, 1e-3);
  scene.scale = (card_width_px - 2.0 * pad_px) / across_m;
  std::string text = drawn(scene);
  while (text.size() > most_bytes && scene.tolerance < 1e3) {
    scene.tolerance *= 2.0;
    text = drawn(scene);
  }
  return text;
}

}  // namespace outrider
