#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "draw.hpp"
#include "outrider/geometry/polyline.hpp"
#include "outrider/log/conversions.hpp"
#include "outrider/log/mapping_messages.hpp"
#include "outrider/log/motion_messages.hpp"
#include "outrider/log/topics.hpp"

namespace outrider::picture {
namespace {

/// Colours that people with every kind of colour vision tell apart. Source: Okabe and Ito, Color Universal
/// Design, 2008, and Tol, Colour schemes, 2021.
constexpr std::array<const char*, 10> colours = {"#0072b2", "#d55e00", "#009e73", "#cc79a7", "#332288",
                                                 "#e69f00", "#56b4e9", "#882255", "#117733", "#999933"};

struct Track {
  std::vector<double> times_s = {};
  std::vector<Pose2> poses = {};
  std::vector<Vec2> points = {};

  void add(double time_s, const geometry_msgs::Pose& pose) {
    times_s.push_back(time_s);
    poses.push_back(pose_of(pose));
    points.push_back(poses.back().position);
  }
};

Track track_of(const nav_msgs::Path& path) {
  Track track;
  for (const auto& pose : path.poses) track.add(seconds(nanoseconds_of(pose.header.stamp)), pose.pose);
  return track;
}

/// Returns the poses on a channel, of whatever type it is; of a channel of paths those of the newest path.
Track track_on(const Log& log, std::string_view topic) {
  if (const auto* path = log.latest<nav_msgs::Path>(topic)) return track_of(*path);
  Track track;
  for (const auto& one : log.messages<geometry_msgs::PoseStamped>(topic))
    track.add(one.time_s(), one.message.pose);
  for (const auto& one : log.messages<geometry_msgs::PoseWithCovarianceStamped>(topic))
    track.add(one.time_s(), one.message.pose.pose);
  for (const auto& one : log.messages<nav_msgs::Odometry>(topic))
    track.add(one.time_s(), one.message.pose.pose);
  return track;
}

/// Returns the topics of the tracks: the true ones and the settled ones, or else the belief.
std::vector<std::string_view> main_topics(const Log& log) {
  std::vector<std::string_view> topics;
  for (const Channel& channel : log.channels()) {
    const bool main = channel.topic.ends_with(topic::pose) || channel.topic.ends_with(topic::trajectory);
    if (main && track_on(log, channel.topic).poses.size() > 1) topics.push_back(channel.topic);
  }
  if (topics.empty()) topics.push_back(topic::belief);
  return topics;
}

/// Returns the odometry as if it had begun where the robot was first: its own frame begins anywhere.
std::vector<Vec2> odometry_of(const Log& log) {
  const Track odometry = track_on(log, topic::odometry);
  const Track main = track_on(log, main_topics(log).front());
  if (odometry.poses.empty() || main.poses.empty()) return odometry.points;
  const Pose2 map_T_odom = compose(main.poses.front(), inverse(odometry.poses.front()));
  std::vector<Vec2> points;
  for (const Vec2 point : odometry.points) points.push_back(map_T_odom * point);
  return points;
}

std::string words_of(std::string_view topic) {
  if (topic == topic::pose) return "driven";
  if (topic == topic::trajectory) return "settled track";
  return topic == topic::belief ? "believed track" : std::string(topic.substr(1, topic.find('/', 1) - 1));
}

/// Colours a track by a class of each leg, which begins at the pose of that index.
template <class ClassOf, class StyleOf>
void draw_parts(Sheet& sheet, const Track& track, const ClassOf& class_of, const StyleOf& style_of) {
  std::map<int, std::string> paths;
  std::vector<Vec2> part;
  for (std::size_t i = 0; i + 1 < track.points.size(); ++i) {
    part.push_back(track.points[i]);
    if (i + 2 < track.points.size() && class_of(i + 1) == class_of(i)) continue;
    part.push_back(track.points[i + 1]);
    paths[class_of(i)] += sheet.line(part);
    part.clear();
  }
  for (const auto& [which, path] : paths) {
    const bool first = which == paths.begin()->first, last = which == paths.rbegin()->first;
    const auto [words, style] = style_of(which, first ? ", at first" : last ? ", at last" : "");
    sheet.put("track", path, line_sample, words, style);
  }
}

/// Colours a track by the passes over an area, or else by time.
void draw_only_track(Sheet& sheet, const Log& log, const Track& track, const std::string& words) {
  using Style = std::pair<std::string, std::string>;
  using Pass = Stamped<outrider_msgs::CoveragePass>;
  constexpr int slices = 24;
  const auto& passes = log.messages<outrider_msgs::CoveragePass>(topic::coverage_passes);
  if (!passes.empty()) {
    const std::array<Style, 4> roles = {
        Style{"move", "#6b4000"}, {"lane", "#0a6cc4"}, {"lap", "#97237f"}, {"other", "#566470"}};
    const auto role = [&](std::size_t i) {
      const auto next = std::ranges::upper_bound(passes, nanoseconds(track.times_s[i]), {}, &Pass::time_ns);
      const auto& name = next == passes.begin() ? next->message.role : std::prev(next)->message.role;
      return static_cast<int>(
          std::min<std::ptrdiff_t>(3, std::ranges::find(roles, name, &Style::first) - roles.begin()));
    };
    return draw_parts(sheet, track, role, [&](int which, const std::string&) {
      const auto& [name, colour] = roles[static_cast<std::size_t>(which)];
      return Style{words + ": " + name, "stroke:" + colour};
    });
  }
  const double begin_s = track.times_s.front(), span_s = std::max(1e-9, track.times_s.back() - begin_s);
  const auto slice = [&](std::size_t i) {
    return std::min(slices - 1, static_cast<int>(slices * (track.times_s[i] - begin_s) / span_s));
  };
  draw_parts(sheet, track, slice, [&](int which, const std::string& when) {
    return Style{when.empty() ? "" : words + when,
                 "stroke:" + mixed(0xf0a52b, 0x5a2a00, which / (slices - 1.0))};
  });
}

/// Draws some 40 heads of arrows along a track at most.
void draw_arrows(Sheet& sheet, const Track& track) {
  std::vector<Vec2> points;
  for (const Vec2 point : track.points) {
    if (finite(point)) points.push_back(sheet.at(point));
  }
  const double spacing_px = std::max(80.0, length_of(points) / 40.0);
  double since_px = 0.4 * spacing_px;
  std::string path;
  for (std::size_t i = 1; i < points.size(); ++i) {
    const double leg_px = distance(points[i - 1], points[i]);
    since_px += leg_px;
    if (since_px < spacing_px || leg_px == 0.0) continue;
    since_px = 0.0;
    const Vec2 ahead = 6.0 / leg_px * (points[i] - points[i - 1]), side = 0.7 * perpendicular(ahead);
    path += polyline({points[i] - ahead + side, points[i], points[i] - ahead - side});
  }
  sheet.put("arrow", path);
}

/// Draws the robot to size, but large enough to be seen, with its heading.
void draw_robot(Sheet& sheet, const Pose2& pose, double radius_m, const std::string& when) {
  const auto shape = [](double r, Vec2 nose) {
    return fmt::format(
        "m-{0:.1f} 0a{0:.1f} {0:.1f} 0 1 0 {1:.1f} 0a{0:.1f} {0:.1f} 0 1 0-{1:.1f} 0zm{0:.1f} 0l{2:.1f} "
        "{3:.1f}",
        r, 2.0 * r, 1.5 * r * nose.x, 1.5 * r * nose.y);
  };
  if (!finite(pose)) return;
  const double radius_px = std::max(4.0, std::isfinite(radius_m) ? sheet.px_per_m * radius_m : 0.0);
  sheet.put("robot " + when,
            shape_at(sheet.at(pose.position), shape(radius_px, direction(-pose.heading_rad))),
            shape_at({15.0, 7.0}, shape(5.0, {1.0, 0.0})), "robot at the " + when);
}

/// Draws the paths of each planner; later ones are thinner, so that equal ones stay visible.
void draw_plans(Sheet& sheet, const Log& log) {
  std::string path;
  for (const auto& plan : log.messages<nav_msgs::Path>(topic::plan))
    path += sheet.line(track_of(plan.message).points);
  sheet.put("planned", path, line_sample, "planned path");
  std::size_t drawn = 0;
  for (const Channel& channel : log.channels()) {
    if (!channel.topic.starts_with(topic::plan_of)) continue;
    path.clear();
    double length_m = 0.0;
    const auto& plans = log.messages<nav_msgs::Path>(channel.topic);
    for (const auto& plan : plans) {
      const std::vector<Vec2> points = track_of(plan.message).points;
      path += sheet.line(points);
      length_m += length_of(points);
    }
    const std::string paths = plans.size() == 1 ? "" : fmt::format("{} paths, ", plans.size());
    sheet.put("track", path, line_sample,
              fmt::format("{}: {}{:.2f} m", channel.topic.substr(topic::plan_of.size()), paths, length_m),
              fmt::format("stroke:{};stroke-width:{:.1f}", colours[drawn % colours.size()],
                          std::max(1.2, 4.0 - 0.4 * static_cast<double>(drawn))));
    ++drawn;
  }
}

/// Draws the belief, with ellipses wherever it has come some way.
void draw_belief(Sheet& sheet, const Log& log) {
  sheet.put("belief", sheet.line(track_on(log, topic::belief).points), line_sample, words_of(topic::belief));
  std::string path;
  Vec2 last{-1e9, -1e9};
  for (const auto& belief : log.messages<geometry_msgs::PoseWithCovarianceStamped>(topic::belief)) {
    const auto& [pose, c] = belief.message.pose;
    const Vec2 at = sheet.at(pose_of(pose).position);
    if (!(distance(at, last) > 200.0 * sheet.detail_px)) continue;
    last = at;
    path += sheet.ellipse(pose_of(pose).position, c[0], c[1], c[7]);
  }
  sheet.put("doubt", path, shape_at({15.0, 7.0}, small_disk), "its uncertainty, 2\u03c3");
}

}  // namespace

void draw_lines(Sheet& sheet, const Log& log) {
  const auto* info = log.latest<outrider_msgs::RunInfo>(topic::run);
  draw_plans(sheet, log);
  sheet.put("odometry", sheet.line(odometry_of(log)), line_sample, "odometry alone");
  sheet.put("reference", sheet.line(track_on(log, topic::reference).points), line_sample, "reference");
  sheet.put("target", sheet.line(track_on(log, topic::target_pose).points), line_sample, "target");
  draw_belief(sheet, log);
  const double radius_m = info == nullptr ? 0.0 : info->robot_radius;
  for (const Pose2& start : track_on(log, topic::start).poses) draw_robot(sheet, start, radius_m, "start");
  const auto topics = main_topics(log);
  for (std::size_t i = 0; i < topics.size(); ++i) {
    const Track track = track_on(log, topics[i]);
    if (track.poses.empty()) break;
    if (topics.size() == 1) {
      draw_only_track(sheet, log, track, words_of(topics[i]));
    } else {
      sheet.put("track", sheet.line(track.points), line_sample, words_of(topics[i]),
                fmt::format("stroke:{}", colours[i % colours.size()]));
    }
    draw_arrows(sheet, track);
    draw_robot(sheet, track.poses.front(), radius_m, "start");
    draw_robot(sheet, track.poses.back(), radius_m, "end");
  }
  if (const auto* loops = log.latest<outrider_msgs::Loops>(topic::loops)) {
    std::string path;
    const std::size_t stride = 1 + loops->loops.size() / 5000;
    for (std::size_t i = 0; i < loops->loops.size(); i += stride) {
      path += sheet.line({vec2_of(loops->loops[i].from), vec2_of(loops->loops[i].to)});
    }
    sheet.put("loop", path, line_sample, fmt::format("loop closed ({})", loops->loops.size()));
  }
}

}  // namespace outrider::picture
