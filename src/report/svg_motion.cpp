#include <utility>
#include <vector>

#include "outrider/core/units.hpp"
#include "svg_scene.hpp"

namespace outrider {
namespace {

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
  if (scene.report.gun_length_m <= 0.0) return fmt::format("<g>{}<g>{}{}</g></g>\n", move, turn_body, body);
  const std::string barrel = fmt::format(
      R"svg(<path d="M0 0H{}" stroke="{}" stroke-width="{}" stroke-linecap="round"/><circle r="{}" fill="{}"/>)svg",
      number(gun), water, number(scene.pixels(3.4)), number(0.26 * r), water);
  return fmt::format("<g>{}<g>{}{}</g><g>{}{}</g></g>\n", move, turn_body, body, turn_gun, barrel);
}

std::string robot_on_its_way(const Scene& scene) {
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

Vec3 ball_position(const Scene& scene, const ReportShot& shot, double after_s) {
  const double share = shot.flight_s > 0.0 ? after_s / shot.flight_s : 1.0;
  if (shot.path && shot.path->size() > 1) {
    const double step = share * static_cast<double>(shot.path->size() - 1);
    const auto i = std::min(static_cast<std::size_t>(step), shot.path->size() - 2);
    const Vec3 a = (*shot.path)[i];
    return a + (step - static_cast<double>(i)) * ((*shot.path)[i + 1] - a);
  }
  const Vec2 muzzle = xy(shot.muzzle);
  const Vec2 at = muzzle + share * (xy(shot.contact_point) - muzzle);
  const double fallen = 0.5 * scene.report.gravity_mps2 * after_s * after_s;
  return {at.x, at.y, shot.muzzle.z + shot.velocity_mps.z * after_s - fallen};
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
    const Vec3 ball_at = ball_position(scene, shot, t);
    const double z = std::max(0.0, ball_at.z);
    const Vec2 at = xy(ball_at);
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

std::string flights(const Scene& scene) {
  std::string text;
  for (const ReportShot& shot : scene.report.shots) {
    if (can_be_drawn(shot)) text += flight(scene, shot);
  }
  return text;
}

}  // namespace

std::string motion(const Scene& scene) { return robot_on_its_way(scene) + flights(scene); }

}  // namespace outrider
