#include <fmt/format.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <map>
#include <span>

#include "outrider/core/units.hpp"
#include "outrider/geometry/convex.hpp"
#include "outrider/geometry/polyline.hpp"
#include "outrider/log/messages/conversions.hpp"
#include "outrider/log/messages/gun_messages.hpp"
#include "outrider/log/messages/mapping_messages.hpp"
#include "outrider/log/messages/motion_messages.hpp"
#include "outrider/log/topics.hpp"
#include "sheet.hpp"

namespace outrider::picture {
namespace {

using namespace outrider_msgs;

Vec2 place(const geometry_msgs::Point& point) { return {point.x, point.y}; }

/// Draws the ellipse of two standard deviations.
void draw_ellipse(Sheet& sheet, Kind kind, Vec2 centre, double variance_x, double covariance,
                  double variance_y) {
  const Eigen::Matrix2d matrix{{variance_x, covariance}, {covariance, variance_y}};
  if (!matrix.allFinite()) return;
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> axes(matrix);
  const Eigen::Matrix2d radii =
      2.0 * axes.eigenvectors() * axes.eigenvalues().cwiseMax(0.0).cwiseSqrt().asDiagonal();
  std::vector<Vec2> corners;
  for (double turn_deg = 0.0; turn_deg < 360.0; turn_deg += 15.0) {
    const Vec2 unit = direction(radians(turn_deg));
    const Eigen::Vector2d from_centre = radii * Eigen::Vector2d{unit.x, unit.y};
    corners.push_back(centre + Vec2{from_centre.x(), from_centre.y()});
  }
  sheet.area(kind, {corners});
}

const geometry_msgs::Pose& pose_in(const geometry_msgs::PoseStamped& message) { return message.pose; }
const geometry_msgs::Pose& pose_in(const geometry_msgs::PoseWithCovarianceStamped& message) {
  return message.pose.pose;
}
const geometry_msgs::Pose& pose_in(const nav_msgs::Odometry& message) { return message.pose.pose; }

using Track = std::vector<Pose2>;

/// Returns the poses on a channel, of whatever type it is; of a channel of paths those of the newest path.
Track track_on(const Log& log, std::string_view topic) {
  Track track;
  const auto add = [&](const auto& messages) {
    for (const auto& [time_ns, message] : messages) track.push_back(pose_of(pose_in(message)));
  };
  add(log.messages<geometry_msgs::PoseStamped>(topic));
  add(log.messages<geometry_msgs::PoseWithCovarianceStamped>(topic));
  add(log.messages<nav_msgs::Odometry>(topic));
  if (const auto* path = log.latest<nav_msgs::Path>(topic)) {
    for (const auto& pose : path->poses) track.push_back(pose_of(pose.pose));
  }
  return track;
}

std::vector<Vec2> points_of(const Track& track) {
  std::vector<Vec2> points;
  for (const Pose2& pose : track) points.push_back(pose.position);
  return points;
}
std::vector<Vec2> points_of(const nav_msgs::Path& path) {
  std::vector<Vec2> points;
  for (const auto& pose : path.poses) points.push_back(place(pose.pose.position));
  return points;
}

/// Draws the paths of a planner, whose number and length are in the legend.
void draw_plans(Sheet& sheet, const std::string& planner, const std::vector<Stamped<nav_msgs::Path>>& paths) {
  double length_m = 0.0;
  for (const auto& [time_ns, path] : paths) length_m += length_of(points_of(path));
  const std::string number = paths.size() == 1 ? "" : fmt::format("{} paths, ", paths.size());
  for (const auto& [time_ns, path] : paths)
    sheet.line("coloured", points_of(path), {fmt::format("{}: {}{:.2f} m", planner, number, length_m)});
}

/// Returns true if the paths say when their places are reached: they are those of robots that drive at once.
bool are_timed(const std::vector<Stamped<nav_msgs::Path>>& paths) {
  return std::ranges::any_of(paths, [](const auto& stamped) {
    const auto& poses = stamped.message.poses;
    return poses.size() > 1 &&
           nanoseconds_of(poses.back().header.stamp) > nanoseconds_of(poses.front().header.stamp);
  });
}

/// Draws the paths of robots, each in the next colour; the legend has the robots of each colour.
void draw_fleet(Sheet& sheet, const std::string& planner, const std::vector<Stamped<nav_msgs::Path>>& paths) {
  const std::size_t colours = std::min(paths.size(), palette.size());
  for (std::size_t colour = 0; colour < colours; ++colour) {
    std::string robots;
    for (std::size_t i = colour; i < paths.size() && i < 3 * palette.size(); i += palette.size())
      robots += fmt::format("{}{}", robots.empty() ? "" : ", ", i + 1);
    const char* several = colour + palette.size() < paths.size() ? "s" : "";
    const char* more = colour + 3 * palette.size() < paths.size() ? ", ..." : "";
    const std::string words = fmt::format("{}: robot{} {}{}", planner, several, robots, more);
    for (std::size_t i = colour; i < paths.size(); i += palette.size())
      sheet.line("coloured", points_of(paths[i].message), {words});
  }
}

void draw_planner(Sheet& sheet, const std::string& planner,
                  const std::vector<Stamped<nav_msgs::Path>>& paths) {
  if (paths.size() > 1 && are_timed(paths)) {
    draw_fleet(sheet, planner, paths);
  } else {
    draw_plans(sheet, planner, paths);
  }
}

/// Draws the uncertainty of some 20 beliefs.
void draw_belief(Sheet& sheet,
                 const std::vector<Stamped<geometry_msgs::PoseWithCovarianceStamped>>& beliefs) {
  for (std::size_t i = 0; i < beliefs.size(); i += 1 + beliefs.size() / 20) {
    const auto& [pose, c] = beliefs[i].message.pose;
    draw_ellipse(sheet, "doubt", place(pose.position), c[0], c[1], c[7]);
  }
}

/// A disk, or an outline in the frame of the robot.
struct Body {
  double radius_m = 0.0;
  std::vector<Vec2> outline;
};

Body body_of(const Log& log) {
  Body body;
  if (const auto* info = log.latest<RunInfo>(topic::run)) body.radius_m = info->robot_radius;
  if (const auto* footprint = log.latest<geometry_msgs::PolygonStamped>(topic::footprint)) {
    for (const geometry_msgs::Point32& corner : footprint->polygon.points)
      body.outline.push_back({corner.x, corner.y});
  }
  return body;
}

std::vector<Vec2> outline_at(const Pose2& pose, const Body& body) {
  std::vector<Vec2> outline = body.outline;
  for (Vec2& corner : outline) corner = pose * corner;
  return outline;
}

void draw_robot(Sheet& sheet, Kind kind, const Pose2& pose, const Body& body) {
  sheet.mark(kind, pose);
  std::vector<Vec2> outline = outline_at(pose, body);
  if (outline.empty() && body.radius_m > 0.0)
    outline = circumscribed({{pose.position}, body.radius_m}, radians(15.0));
  if (!outline.empty()) sheet.area(kind, {outline});
}

/// Draws a track, with arrows, and with the robot at both ends. The only one is the darker the later.
void draw_track(Sheet& sheet, const Track& track, const std::string& words, bool is_only, const Body& body) {
  const std::vector<Vec2> points = points_of(track);
  if (is_only) sheet.line("track", points, {words + ", at first"});
  if (!is_only) sheet.line("coloured", points, {words});
  const std::size_t length = 1 + points.size() / 12, stride = 1 + points.size() / 20;
  for (std::size_t i = 0; is_only && i + 1 < points.size(); i += length) {
    const auto part = std::span(points).subspan(i, std::min(length + 1, points.size() - i));
    sheet.line("later", part,
               {words + ", at last", static_cast<double>(i) / static_cast<double>(points.size())});
  }
  for (std::size_t i = stride / 2; i < track.size(); i += stride) sheet.mark("arrow", track[i]);
  draw_robot(sheet, "start", track.front(), body);
  draw_robot(sheet, "end", track.back(), body);
}

/// Draws the true tracks and the settled one, or else the believed one. The odometry is drawn as if it had
/// begun with the first of them: its own frame begins anywhere.
void draw_tracks(Sheet& sheet, const Log& log, const Body& body) {
  std::vector<std::pair<std::string, Track>> tracks;
  for (const Channel& channel : log.channels()) {
    if (!channel.topic.ends_with(topic::pose) && !channel.topic.ends_with(topic::trajectory)) continue;
    const std::string owner = channel.topic.substr(1, channel.topic.find('/', 1) - 1);
    tracks.emplace_back(owner == "pose"         ? "driven"
                        : owner == "trajectory" ? "settled track"
                                                : owner,
                        track_on(log, channel.topic));
  }
  std::erase_if(tracks, [](const auto& track) { return track.second.size() < 2; });
  if (tracks.empty()) tracks.emplace_back("believed track", track_on(log, topic::belief));
  for (const auto& [words, track] : tracks) {
    if (!track.empty()) draw_track(sheet, track, words, tracks.size() == 1, body);
  }
  Track odometry = track_on(log, topic::odometry);
  const Track& first = tracks.front().second;
  const Pose2 map_T_odom =
      odometry.empty() || first.empty() ? Pose2{} : compose(first.front(), inverse(odometry.front()));
  for (Pose2& pose : odometry) pose = compose(map_T_odom, pose);
  sheet.line("odometry", points_of(odometry));
}

void show(Sheet& sheet, const Landmarks& map) {
  for (const Landmark& one : map.landmarks) {
    const Vec2 at = vec2_of(one.position);
    draw_ellipse(sheet, "ellipse", at, one.sigma_x * one.sigma_x, one.correlation * one.sigma_x * one.sigma_y,
                 one.sigma_y * one.sigma_y);
    sheet.mark("landmark", {at}, std::to_string(one.id));
    sheet.mark("true", {vec2_of(one.truth)});
  }
}

void show(Sheet& sheet, const Tags& tags) {
  for (const Tag& tag : tags.tags)
    sheet.mark("tag", {place(tag.position), tag.facing}, fmt::format("tag {}", tag.id));
}

void show(Sheet& sheet, const Waypoints& all) {
  for (std::size_t i = 0; i < all.waypoints.size(); ++i) {
    const Waypoint& one = all.waypoints[i];
    const Kind kind = !one.stop                    ? Kind("passed")
                      : std::isfinite(one.reached) ? Kind("reached")
                                                   : Kind("unreached");
    sheet.mark(kind, {vec2_of(one.position), one.heading}, std::to_string(i + 1));
  }
}

void show(Sheet& sheet, const Supplies& supplies) {
  for (const Station& station : supplies.stations) {
    const Pose2 pose{vec2_of(station.position)};
    if (station.gives_water) sheet.mark("water", pose, station.name);
    if (station.gives_charge) sheet.mark("charge", pose, station.gives_water ? "" : station.name);
  }
}

void show(Sheet& sheet, const Loops& loops) {
  for (const Loop& loop : loops.loops) sheet.line("loop", std::array{vec2_of(loop.from), vec2_of(loop.to)});
}

/// Draws a flight as it looks from above.
void show(Sheet& sheet, const Shot& shot) {
  std::vector<Vec2> flight{place(shot.muzzle)};
  for (const auto& point : shot.path) flight.push_back(place(point));
  flight.push_back(place(shot.contact_point));
  sheet.line(shot.hit ? Kind("hit") : Kind("miss"), flight);
}

/// Draws each target where it was last, with its way there.
void draw_targets(Sheet& sheet, const Log& log) {
  std::map<std::string, std::string> status_of;
  std::map<std::string, std::vector<Vec2>> ways;
  for (const auto& [time_ns, target] : log.messages<Target>(topic::targets))
    status_of[target.name] = target.status;
  for (const auto& [time_ns, at] : log.messages<TargetPosition>(topic::target_positions))
    ways[at.name].push_back(place(at.centre));
  for (const auto& [name, way] : ways) {
    const std::string& status = status_of[name];
    sheet.line("walk", way);
    sheet.mark(status == "reached"       ? Kind("done")
               : status == "failed"      ? Kind("failed")
               : status == "unreachable" ? Kind("unreachable")
                                         : Kind("waiting"),
               {way.back()}, name);
  }
}

/// Draws an outline on the paths of planners, half its length apart and where it turns back.
void draw_on_its_way(Sheet& sheet, const std::vector<Stamped<nav_msgs::Path>>& plans, const Body& body) {
  double reach_m = 0.0;
  for (const Vec2 corner : body.outline) reach_m = std::max(reach_m, norm(corner));
  for (const auto& [time_ns, path] : plans) {
    double driven_m = 0.0;
    for (std::size_t i = 0; i < path.poses.size() && reach_m > 0.0; ++i) {
      const Pose2 pose = pose_of(path.poses[i].pose);
      if (i > 0) driven_m += distance(pose.position, place(path.poses[i - 1].pose.position));
      const bool is_last = i + 1 == path.poses.size();
      const Vec2 before = i > 0 ? pose.position - place(path.poses[i - 1].pose.position) : Vec2{};
      const Vec2 after = is_last ? Vec2{} : place(path.poses[i + 1].pose.position) - pose.position;
      if (driven_m < 0.5 * reach_m && outrider::dot(before, after) >= 0.0 && !is_last) continue;
      driven_m = 0.0;
      sheet.area("body", {outline_at(pose, body)});
    }
  }
}

template <class Message>
void show_newest(Sheet& sheet, const Log& log, std::string_view topic) {
  if (const Message* message = log.latest<Message>(topic)) show(sheet, *message);
}

}  // namespace

void draw_events(Sheet& sheet, const Log& log) {
  const Body body = body_of(log);
  for (const auto& [time_ns, path] : log.messages<nav_msgs::Path>(topic::plan))
    sheet.line("plan", points_of(path));
  for (const Channel& channel : log.channels()) {
    if (channel.topic.starts_with("/robot_") && channel.topic.ends_with(topic::plan)) {
      for (const auto& [time_ns, path] : log.messages<nav_msgs::Path>(channel.topic))
        sheet.line("plan", points_of(path));
    }
    if (channel.topic.starts_with(topic::plan_of)) {
      const auto& plans = log.messages<nav_msgs::Path>(channel.topic);
      draw_planner(sheet, channel.topic.substr(topic::plan_of.size()), plans);
      draw_on_its_way(sheet, plans, body);
    }
  }
  sheet.line("reference", points_of(track_on(log, topic::reference)));
  sheet.line("pursued", points_of(track_on(log, topic::target_pose)));
  sheet.line("belief", points_of(track_on(log, topic::belief)));
  draw_belief(sheet, log.messages<geometry_msgs::PoseWithCovarianceStamped>(topic::belief));
  draw_tracks(sheet, log, body);
  show_newest<Loops>(sheet, log, topic::loops);

  for (const Pose2& pose : track_on(log, topic::start)) draw_robot(sheet, "start", pose, body);
  for (const Pose2& pose : track_on(log, topic::goal)) sheet.mark("goal", {pose.position});
  for (const auto& [time_ns, refusal] : log.messages<Refusal>(topic::refusals))
    sheet.mark("refusal", {vec2_of(refusal.position)});
  show_newest<Landmarks>(sheet, log, topic::landmarks);
  show_newest<Supplies>(sheet, log, topic::supplies);
  show_newest<Tags>(sheet, log, topic::tags);
  show_newest<Waypoints>(sheet, log, topic::waypoints);
  for (const auto& [time_ns, shot] : log.messages<Shot>(topic::shots)) show(sheet, shot);
  draw_targets(sheet, log);
}

}  // namespace outrider::picture
