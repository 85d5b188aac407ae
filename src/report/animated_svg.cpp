#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "keyframes.hpp"
#include "outrider/core/units.hpp"
#include "outrider/report/pictures.hpp"
#include "text.hpp"

namespace outrider {
namespace {

constexpr double card_width_px = 720.0;
constexpr double pad_px = 18.0;
constexpr double strip_px = 40.0;  // under the plan: clock and counter
constexpr std::size_t most_bytes = 400'000;

// Water is blue, the robot amber; the states are apart for every kind of colour vision and by shape.
constexpr std::string_view water = "#62c6ff";
constexpr std::string_view robot_colour = "#ffc857";
constexpr std::string_view waiting = "#a9b8c4";

std::string_view colour(std::string_view status) {
  if (status == "reached") return "#2fd3a5";
  if (status == "failed") return "#ff8f4d";
  return "#c7a0e6";
}

// Three decimals (1 mm), without zeros at the end.
std::string number(double value) {
  if (!std::isfinite(value)) return "0";
  std::string text = fmt::format("{:.3f}", value);
  text.erase(text.find_last_not_of('0') + 1);
  if (text.back() == '.') text.pop_back();
  return text == "-0" ? "0" : text;
}

std::string point(Vec2 p) { return fmt::format("{} {}", number(p.x), number(p.y)); }

// Values of one attribute over the loop.
struct Frames {
  std::string times;
  std::string values;

  void add(double share, std::string_view value) {
    if (!times.empty()) {
      times += ';';
      values += ';';
    }
    times += fmt::format("{:.5g}", std::round(std::clamp(share, 0.0, 1.0) * 1e5) / 1e5);
    values += value;
  }
};

struct Scene {
  const Report& report;
  LoopClock clock;
  Box2 area;
  double scale = 1.0;       // px per m
  double tolerance = 0.01;  // of the motion, m; half of it in rad

  [[nodiscard]] double pixels(double px) const { return px / scale; }
  [[nodiscard]] double share(double run_s) const { return clock.to_loop(run_s) / clock.loop_s(); }

  [[nodiscard]] std::string animate(std::string_view attribute, const Frames& frames,
                                    std::string_view mode = "linear") const {
    return fmt::format(
        R"svg(<animate attributeName="{}" dur="{}s" repeatCount="indefinite" calcMode="{}" keyTimes="{}" values="{}"/>)svg",
        attribute, number(clock.loop_s()), mode, frames.times, frames.values);
  }
  [[nodiscard]] std::string transform(std::string_view type, const Frames& frames) const {
    return fmt::format(
        R"svg(<animateTransform attributeName="transform" type="{}" dur="{}s" repeatCount="indefinite" keyTimes="{}" values="{}"/>)svg",
        type, number(clock.loop_s()), frames.times, frames.values);
  }
  /// Shown from one share of the loop to another.
  [[nodiscard]] std::string shown(double from, double to) const {
    if (from <= 0.0 && to >= 1.0) return {};
    Frames frames;
    frames.add(0.0, from <= 0.0 ? "1" : "0");
    if (from > 0.0) frames.add(from, "1");
    if (to < 1.0) frames.add(to, "0");
    return animate("opacity", frames, "discrete");
  }
};

Box2 drawn_area(const Report& report) {
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

// Outline of a core grown by its radius: straight edges and arcs, counter-clockwise.
std::string outline(const RoundedPolygon& shape) {
  const std::vector<Vec2>& core = shape.core;
  const double r = shape.radius_m;
  if (core.empty()) return {};
  if (core.size() == 1) {
    const Vec2 side{r, 0.0};
    return fmt::format("M{}A{r} {r} 0 1 1 {}A{r} {r} 0 1 1 {}Z", point(core[0] - side), point(core[0] + side),
                       point(core[0] - side), fmt::arg("r", number(r)));
  }
  std::string path;
  for (std::size_t i = 0; i < core.size(); ++i) {
    const Vec2 a = core[i];
    const Vec2 b = core[(i + 1) % core.size()];
    const Vec2 out = (r / std::max(distance(a, b), 1e-12)) * -perpendicular(b - a);
    if (i > 0 && r > 0.0) {
      path += fmt::format("A{0} {0} 0 0 1 {1}", number(r), point(a + out));
    } else {
      path += fmt::format("{}{}", i == 0 ? 'M' : 'L', point(a + out));
    }
    if (r > 0.0) path += fmt::format("L{}", point(b + out));
  }
  if (r > 0.0) {
    const Vec2 out = (r / std::max(distance(core[0], core[1]), 1e-12)) * -perpendicular(core[1] - core[0]);
    path += fmt::format("A{0} {0} 0 0 1 {1}", number(r), point(core[0] + out));
  }
  return path + "Z";
}

// Low things dark, high things light.
std::string shade(double share) {
  const auto mix = [&](int low, int high) {
    return static_cast<int>(std::lround(low + (high - low) * share));
  };
  return fmt::format("#{:02x}{:02x}{:02x}", mix(0x36, 0x94), mix(0x47, 0xa6), mix(0x55, 0xb4));
}

std::string grid(const Scene& scene) {
  const Box2& area = scene.area;
  const double across = std::max(area.size().x, area.size().y);
  const double step = std::max(1.0, std::pow(10.0, std::ceil(std::log10(across / 60.0))));
  std::string path;
  for (int i = 0; i <= 60; ++i) {
    const double x = (std::ceil(area.low.x / step) + i) * step;
    const double y = (std::ceil(area.low.y / step) + i) * step;
    if (x <= area.high.x) {
      path += fmt::format("M{} {}V{}", number(x), number(area.low.y), number(area.high.y));
    }
    if (y <= area.high.y) {
      path += fmt::format("M{} {}H{}", number(area.low.x), number(y), number(area.high.x));
    }
  }
  return fmt::format(R"svg(<path d="{}" stroke="#1c2a35" stroke-width="{}"/>)svg", path,
                     number(scene.pixels(1.0)));
}

std::string solids(const Scene& scene) {
  std::vector<std::pair<double, std::size_t>> order;  // from low to high, ties as in the report
  double highest = 1e-3;
  for (std::size_t i = 0; i < scene.report.solids.size(); ++i) {
    const ReportSolid& solid = scene.report.solids[i];
    if (solid.footprint.empty() || !std::isfinite(solid.high_z_m)) continue;
    order.emplace_back(solid.high_z_m, i);
    highest = std::max(highest, solid.high_z_m);
  }
  std::ranges::sort(order);
  std::string text;
  for (const auto& [top_m, index] : order) {
    const ReportSolid& solid = scene.report.solids[index];
    std::string path;
    for (const RoundedPolygon& piece : solid.footprint) path += outline(piece);
    const std::string tone = shade(std::sqrt(std::clamp(top_m / highest, 0.0, 1.0)));
    if (solid.blocks_driving) {
      text += fmt::format(R"svg(<path d="{}" fill="{}"/>)svg", path, tone);
    } else {
      text += fmt::format(
          R"svg(<path d="{}" fill="{tone}" fill-opacity=".22" stroke="{tone}" stroke-width="{}" stroke-dasharray="{dash} {dash}"/>)svg",
          path, number(scene.pixels(1.0)), fmt::arg("tone", tone),
          fmt::arg("dash", number(scene.pixels(3.0))));
    }
    text += '\n';
  }
  return text;
}

std::string mark(std::string_view status, double r) {
  const std::string ink = number(r * 0.34);
  const auto stroke = [&](std::string_view path) {
    return fmt::format(
        R"svg(<path d="{}" fill="none" stroke="#101820" stroke-width="{}" stroke-linecap="round" stroke-linejoin="round"/>)svg",
        path, ink);
  };
  if (status == "reached") {
    return fmt::format(R"svg(<circle r="{}" fill="{}"/>)svg", number(r), colour(status)) +
           stroke(fmt::format("M{} {}L{} {}L{} {}", number(-0.45 * r), number(0.0), number(-0.1 * r),
                              number(-0.38 * r), number(0.48 * r), number(0.38 * r)));
  }
  if (status == "failed") {
    const std::string d = number(1.25 * r);
    const std::string x = number(0.38 * r);
    return fmt::format(R"svg(<path d="M0 -{0}L{0} 0L0 {0}L-{0} 0Z" fill="{1}"/>)svg", d, colour(status)) +
           stroke(fmt::format("M-{0} -{0}L{0} {0}M-{0} {0}L{0} -{0}", x));
  }
  return fmt::format(R"svg(<rect x="-{0}" y="-{0}" width="{1}" height="{1}" fill="{2}"/>)svg",
                     number(0.95 * r), number(1.9 * r), colour(status)) +
         stroke(fmt::format("M-{0} 0H{0}", number(0.5 * r)));
}

std::string targets(const Scene& scene) {
  std::string text;
  const double r = scene.pixels(6.5);
  for (const ReportTarget& target : scene.report.targets) {
    const double done = std::isfinite(target.done_s) ? scene.share(target.done_s) : 1.0;
    text += fmt::format(R"svg(<g transform="translate({})"><title>{}</title>)svg", point(xy(target.centre)),
                        markup_text(target.name));
    text += fmt::format(
        R"svg(<rect x="{}" y="{}" width="{}" height="{}" transform="rotate({})" fill="{}" fill-opacity=".35"/>)svg",
        number(-0.5 * target.size.x), number(-0.5 * target.size.y), number(target.size.x),
        number(target.size.y), number(degrees(target.yaw_rad)), waiting);
    if (done > 0.0) {
      text += fmt::format(
          R"svg(<circle r="{}" fill="#101820" fill-opacity=".6" stroke="{}" stroke-width="{}">{}</circle>)svg",
          number(0.85 * r), waiting, number(0.28 * r), scene.shown(0.0, done));
    }
    text += fmt::format("<g{}>{}{}</g></g>\n", done > 0.0 ? R"( opacity="0")" : "", scene.shown(done, 1.0),
                        mark(target.status, r));
  }
  return text;
}

// The instants at which the motion is given, in the loop's time, and the state then.
std::vector<std::pair<double, TrackSample>> samples(const Scene& scene) {
  std::vector<double> times = scene.clock.changes();
  for (const TrackSample& sample : scene.report.track) times.push_back(sample.time_s);
  std::ranges::sort(times);
  times.erase(std::ranges::unique(times).begin(), times.end());
  std::vector<std::pair<double, TrackSample>> states;
  states.reserve(times.size() + 1);
  for (const double time_s : times) {
    states.emplace_back(scene.share(time_s), sample_at(scene.report.track, time_s));
  }
  states.emplace_back(1.0, states.back().second);
  return states;
}

Frames angle_frames(const Scene& scene, const std::vector<std::pair<double, TrackSample>>& states,
                    double (*angle)(const TrackSample&)) {
  std::vector<Key> keys;
  double total = angle(states.front().second);
  double before = total;
  for (const auto& [share, state] : states) {
    total += wrap_angle(angle(state) - before);
    before = angle(state);
    keys.push_back({share, {total, 0.0}});
  }
  Frames frames;
  for (const Key& key : simplified(keys, 0.5 * scene.tolerance)) {
    frames.add(key.time, number(std::round(degrees(key.value.x) * 100.0) / 100.0));
  }
  return frames;
}

// The way driven grows under the robot as a dash as long as the way so far.
std::string driven(const Scene& scene, const std::vector<Key>& keys) {
  double total = 0.0;
  for (std::size_t i = 1; i < keys.size(); ++i) total += distance(keys[i - 1].value, keys[i].value);
  if (total <= 0.0) return {};
  std::string path = fmt::format("M{}", point(keys.front().value));
  Frames offset;
  double so_far = 0.0;
  for (std::size_t i = 0; i < keys.size(); ++i) {
    if (i > 0 && !(keys[i].value == keys[i - 1].value)) {
      path += fmt::format("L{}", point(keys[i].value));
      so_far += distance(keys[i - 1].value, keys[i].value);
    }
    offset.add(keys[i].time, fmt::format("{:.5f}", 1.0 - so_far / total));
  }
  const std::string faint = fmt::format(
      R"svg(<path d="{}" fill="none" stroke="{}" stroke-opacity=".2" stroke-width="{}" stroke-linejoin="round"/>)svg",
      path, robot_colour, number(scene.pixels(1.2)));
  return faint +
         fmt::format(
             R"svg(<path d="{}" pathLength="1" fill="none" stroke="{}" stroke-opacity=".85" stroke-width="{}" stroke-linejoin="round" stroke-dasharray="1 1" stroke-dashoffset="1">{}</path>)svg",
             path, robot_colour, number(scene.pixels(2.0)), scene.animate("stroke-dashoffset", offset)) +
         "\n";
}

std::string robot(const Scene& scene, std::string_view turn_body, std::string_view turn_gun,
                  std::string_view move) {
  const double r = std::max(scene.report.robot_radius_m, scene.pixels(8.0));
  const double gun = std::max(scene.report.gun_length_m, 1.6 * r);
  const std::string body = fmt::format(
      R"svg(<circle r="{}" fill="#101820" stroke="{c}" stroke-width="{}"/><path d="M{} 0L{} {}L{} {}Z" fill="{c}"/>)svg",
      number(r), number(scene.pixels(2.0)), number(0.82 * r), number(0.3 * r), number(0.36 * r),
      number(0.3 * r), number(-0.36 * r), fmt::arg("c", robot_colour));
  const std::string barrel = fmt::format(
      R"svg(<path d="M0 0H{}" stroke="{}" stroke-width="{}" stroke-linecap="round"/><circle r="{}" fill="{}"/>)svg",
      number(gun), water, number(scene.pixels(3.4)), number(0.26 * r), water);
  return fmt::format("<g>{}<g>{}{}</g><g>{}{}</g></g>\n", move, turn_body, body, turn_gun, barrel);
}

std::string motion(const Scene& scene) {
  if (scene.report.track.empty()) {
    const Pose2& start = scene.report.start;
    const std::string turned = fmt::format(R"svg(<g transform="translate({}) rotate({})">)svg",
                                           point(start.position), number(degrees(start.heading_rad)));
    return turned + robot(scene, "", "", "") + "</g>";
  }
  const auto states = samples(scene);
  std::vector<Key> positions;
  positions.reserve(states.size());
  for (const auto& [share, state] : states) positions.push_back({share, state.pose.position});
  positions = simplified(positions, scene.tolerance);
  Frames move;
  for (const Key& key : positions) move.add(key.time, point(key.value));
  const Frames body = angle_frames(scene, states, [](const TrackSample& s) { return s.pose.heading_rad; });
  const Frames gun = angle_frames(scene, states, [](const TrackSample& s) { return s.gun_yaw_rad; });
  return driven(scene, positions) + robot(scene, scene.transform("rotate", body),
                                          scene.transform("rotate", gun), scene.transform("translate", move));
}

// The ball grows as it rises; its shadow runs beside it.
std::string flight(const Scene& scene, const ReportShot& shot) {
  const double from = scene.share(shot.time_s);
  const double to = scene.share(shot.time_s + shot.flight_s);
  const Vec2 muzzle = xy(shot.muzzle);
  const Vec2 end = xy(shot.contact_point);
  const std::string_view tone = shot.hit ? water : colour("failed");

  Frames along_x, along_y, line;
  for (Frames* frames : {&along_x, &along_y}) {
    const bool x = frames == &along_x;
    const std::string first = number(x ? muzzle.x : muzzle.y);
    const std::string last = number(x ? end.x : end.y);
    frames->add(0.0, first);
    frames->add(from, first);
    frames->add(to, last);
    frames->add(1.0, last);
  }
  for (const auto& [share, value] : {std::pair{0.0, "0"}, {from, "0"}, {from, ".9"}, {to, ".9"}}) {
    line.add(share, value);
  }
  line.add(std::min(1.0, to + 0.02), ".28");
  line.add(1.0, ".28");
  std::string text = fmt::format(
      R"svg(<line x1="{x}" y1="{y}" x2="{x}" y2="{y}" stroke="{}" stroke-opacity="0" stroke-width="{}" stroke-linecap="round"{}>{}{}{}</line>)svg",
      tone, number(scene.pixels(1.6)),
      shot.hit ? "" : fmt::format(R"svg( stroke-dasharray="{0} {0}")svg", number(scene.pixels(4.0))),
      scene.animate("x2", along_x), scene.animate("y2", along_y), scene.animate("stroke-opacity", line),
      fmt::arg("x", number(muzzle.x)), fmt::arg("y", number(muzzle.y)));

  Frames ball, shadow, radius;
  constexpr int steps = 6;
  ball.add(0.0, point(muzzle));
  shadow.add(0.0, point(muzzle));
  radius.add(0.0, number(scene.pixels(3.0)));
  for (int i = 0; i <= steps; ++i) {
    const double t = shot.flight_s * i / steps;
    const double z =
        std::max(0.0, shot.muzzle.z + shot.velocity_mps.z * t - 0.5 * scene.report.gravity_mps2 * t * t);
    const Vec2 at = muzzle + (static_cast<double>(i) / steps) * (end - muzzle);
    const double share = from + (to - from) * i / steps;
    ball.add(share, point(at));
    shadow.add(share, point(at + 0.3 * z * Vec2{1.0, -1.0}));
    radius.add(share, number(scene.pixels(3.0 + 1.6 * std::min(z, 4.0))));
  }
  ball.add(1.0, point(end));
  shadow.add(1.0, point(end));
  radius.add(1.0, number(scene.pixels(3.0)));
  const std::string visible = scene.shown(from, to);
  text += fmt::format(R"svg(<g opacity="0">{}<g>{}<circle r="{}" fill="#000" fill-opacity=".5"/></g>)svg",
                      visible, scene.transform("translate", shadow), number(scene.pixels(3.0)));
  text += fmt::format(
      R"svg(<g>{}<circle r="{}" fill="#fff" stroke="{}" stroke-width="{}">{}</circle></g></g>)svg",
      scene.transform("translate", ball), number(scene.pixels(3.0)), water, number(scene.pixels(1.5)),
      scene.animate("r", radius));

  const double spread = std::min(1.0, to + 0.6 / scene.clock.loop_s());
  Frames ring, fade;
  for (const auto& [share, size] : {std::pair{0.0, 0.0}, {to, 0.0}, {spread, 20.0}, {1.0, 20.0}}) {
    ring.add(share, number(scene.pixels(size)));
  }
  for (const auto& [share, value] : {std::pair{0.0, "0"}, {to, "0"}, {to, "1"}, {spread, "0"}, {1.0, "0"}}) {
    fade.add(share, value);
  }
  text += fmt::format(
      R"svg(<circle cx="{}" cy="{}" r="0" fill="none" stroke="{}" stroke-width="{}" opacity="0">{}{}</circle>)svg",
      number(end.x), number(end.y), tone, number(scene.pixels(2.0)), scene.animate("r", ring),
      scene.animate("opacity", fade));
  return text + "\n";
}

bool can_be_drawn(const ReportShot& shot) {
  const Vec3 sum = shot.muzzle + shot.velocity_mps + shot.contact_point;
  return shot.time_s >= 0.0 && shot.flight_s > 0.0 &&
         std::isfinite(sum.x + sum.y + sum.z + shot.time_s + shot.flight_s);
}

std::string flights(const Scene& scene) {
  std::string text;
  for (const ReportShot& shot : scene.report.shots) {
    if (can_be_drawn(shot)) text += flight(scene, shot);
  }
  return text;
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
  for (std::size_t i = 0; i <= reached.size(); ++i) {
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
  text += grid(scene) + solids(scene) + targets(scene) + motion(scene) + flights(scene) + "</g>\n";
  return text + strip(scene, pad_px + plan_px) + "</svg>\n";
}

}  // namespace

std::string to_animated_svg(const Report& report, double seconds) {
  const double loop_s = std::isfinite(seconds) ? std::clamp(seconds, 1.0, 600.0) : 20.0;
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
