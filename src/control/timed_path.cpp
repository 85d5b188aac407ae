#include "outrider/control/timed_path.hpp"

#include <algorithm>
#include <cmath>

#include "outrider/core/units.hpp"
#include "via.hpp"

namespace outrider {
namespace {

constexpr double spacing_m = 0.01;
constexpr double most_points = 20'000.0;      ///< of straight parts
constexpr double sharp_rad = radians(120.0);  ///< larger corners are not rounded
constexpr double least_reach_m = 0.004;       ///< of a rounded corner along either leg
constexpr double least_leg_m = 0.001;         ///< shorter legs are left out

bool turns_in_place(const FollowOptions& options) { return options.mode == "rotate_then_go"; }

PathLimits limits_of(const FollowOptions& options, const Chassis& chassis) {
  PathLimits limits{options.speed_mps,
                    options.acceleration_mps2,
                    turns_in_place(options),
                    options.turn_rate_radps,
                    options.turn_acceleration_radps2,
                    options.wheel_speed_radps,
                    0.0,
                    0.0};
  for (const Wheel& wheel : chassis.wheels) {
    const double per_speed =
        turns_in_place(options) ? std::abs(wheel.per_ahead) : std::hypot(wheel.per_ahead, wheel.per_left);
    limits.per_speed = std::max(limits.per_speed, per_speed);
    limits.per_turn = std::max(limits.per_turn, std::abs(wheel.per_turn));
  }
  return limits;
}

Limits turning_limits(const FollowOptions& options, const Chassis& chassis) {
  const double per_turn = limits_of(options, chassis).per_turn;
  return {std::min(options.turn_rate_radps, options.wheel_speed_radps / per_turn),
          options.turn_acceleration_radps2};
}

/// The corners of the legs from a position to the next stop, without legs of no length, and the index of that
/// stop.
struct Legs {
  std::vector<Vec2> corners;
  std::vector<double> rooms;  // of each of the corners; unused at the ends
  std::size_t stop = 0;
};
Legs legs_to_stop(Vec2 start, const std::vector<Waypoint>& waypoints, std::size_t first,
                  const FollowOptions& options) {
  Legs legs{{start}, {0.0}, first};
  for (std::size_t i = first; i < waypoints.size(); ++i) {
    legs.stop = i;
    const Vec2 at = waypoints[i].pose.position;
    const bool moves = distance(at, legs.corners.back()) > least_leg_m;
    if (moves) {
      legs.corners.push_back(at);
      legs.rooms.push_back(used_room * room_at(waypoints[i], options));
    }
    if (waypoints[i].stop) break;
  }
  return legs;
}

/// Adds a turn in place.
void add_turn(TimedPath& motion, const Pose2& from, double turn_rad, const FollowOptions& options,
              const Chassis& chassis) {
  const Limits limits = turning_limits(options, chassis);
  TimedPathSection section{
      motion.duration_s, duration(std::abs(turn_rad), limits), from, turn_rad, limits, {}, {}};
  motion.duration_s += section.duration_s;
  motion.sections.push_back(std::move(section));
}

Pose2 end_of(const TimedPath& motion) { return pose_at(motion, motion.duration_s); }

/// Adds the path from corner `begin` to corner `end` of the legs, on which no corner is sharp.
void add_path(TimedPath& motion, const Legs& legs, std::size_t begin, std::size_t end,
              const FollowOptions& options, const Chassis& chassis) {
  const std::vector<Vec2> corners(legs.corners.begin() + static_cast<std::ptrdiff_t>(begin),
                                  legs.corners.begin() + static_cast<std::ptrdiff_t>(end) + 1);
  const std::vector<double> rooms(legs.rooms.begin() + static_cast<std::ptrdiff_t>(begin) + 1,
                                  legs.rooms.begin() + static_cast<std::ptrdiff_t>(end));
  double length_m = 0.0;
  for (std::size_t i = 1; i < corners.size(); ++i) length_m += distance(corners[i - 1], corners[i]);
  TimedPathSection section{motion.duration_s, 0.0, end_of(motion), 0.0, {}, {}, {}};
  section.path = rounded_path(corners, rooms, std::max(spacing_m, length_m / most_points));
  if (turns_in_place(options)) {
    const double turn = wrap_angle(section.path.front().tangent_rad - section.from.heading_rad);
    add_turn(motion, section.from, turn, options, chassis);
    section.start_s = motion.duration_s;
    section.from.heading_rad += turn;
  }
  section.profile = speed_profile(section.path, limits_of(options, chassis));
  section.duration_s = section.profile.times_s.back();
  motion.duration_s += section.duration_s;
  motion.sections.push_back(std::move(section));
}

bool is_sharp(const Legs& legs, std::size_t corner) {
  const Vec2 in = legs.corners[corner] - legs.corners[corner - 1];
  const Vec2 out = legs.corners[corner + 1] - legs.corners[corner];
  const double turn = std::abs(std::atan2(cross(in, out), dot(in, out)));
  return turn > sharp_rad || 4.0 * legs.rooms[corner] < least_reach_m * std::sin(0.5 * turn);
}

Pose2 pose_on(const TimedPathSection& section, double time_s) {
  const auto& times = section.profile.times_s;
  const auto next = std::ranges::upper_bound(times, time_s);
  const auto i =
      static_cast<std::size_t>(std::clamp<std::ptrdiff_t>(next - times.begin(), 1, std::ssize(times) - 1));
  const PathPoint &a = section.path[i - 1], &b = section.path[i];
  const double duration_s = times[i] - times[i - 1];
  const double t = std::clamp(time_s - times[i - 1], 0.0, duration_s);
  const double from_mps = section.profile.speeds_mps[i - 1], to_mps = section.profile.speeds_mps[i];
  const double way_m = b.along_m - a.along_m;
  const double acceleration = duration_s > 0.0 ? (to_mps - from_mps) / duration_s : 0.0;
  const double share = way_m > 0.0 ? std::min(1.0, (from_mps + 0.5 * acceleration * t) * t / way_m) : 1.0;
  const double turned =
      a.tangent_rad + share * (b.tangent_rad - a.tangent_rad) - section.path.front().tangent_rad;
  return {a.position + share * (b.position - a.position), section.from.heading_rad + turned};
}

}  // namespace

TimedPath timed_path_to_stop(const Pose2& start, const std::vector<Waypoint>& waypoints, std::size_t first,
                             const FollowOptions& options, const Chassis& chassis) {
  const Legs legs = legs_to_stop(start.position, waypoints, first, options);
  TimedPath motion{{{0.0, 0.0, start, 0.0, {}, {}, {}}}, 0.0};
  const bool stays =
      legs.corners.size() == 2 && distance(legs.corners[0], legs.corners[1]) <= options.within_m;
  for (std::size_t begin = 0, i = 1; i < legs.corners.size() && !stays; ++i) {
    if (i + 1 < legs.corners.size() && !is_sharp(legs, i)) continue;
    add_path(motion, legs, begin, i, options, chassis);
    begin = i;
  }
  if (turns_in_place(options)) {
    const Pose2 end = end_of(motion);
    const double turn = remaining_turn_rad(start.heading_rad, waypoints[legs.stop], end.heading_rad);
    add_turn(motion, end, turn, options, chassis);
  }
  return motion;
}

Pose2 pose_at(const TimedPath& motion, double time_s) {
  auto next = std::ranges::upper_bound(motion.sections, time_s, {}, &TimedPathSection::start_s);
  if (next != motion.sections.begin()) --next;
  const TimedPathSection& section = *next;
  const double t = time_s - section.start_s;
  if (!section.path.empty()) return pose_on(section, t);
  const double turned = covered(std::abs(section.turn_rad), section.turning, t);
  return {section.from.position, section.from.heading_rad + std::copysign(turned, section.turn_rad)};
}

double ideal_time_s(const Pose2& start, const std::vector<Waypoint>& waypoints, const FollowOptions& options,
                    const Chassis& chassis, double pause_s) {
  double time_s = 0.0;
  Pose2 from = start;
  for (std::size_t first = 0; first < waypoints.size();) {
    std::size_t stop = first;
    while (!waypoints[stop].stop && stop + 1 < waypoints.size()) ++stop;
    double part_s = timed_path_to_stop(from, waypoints, first, options, chassis).duration_s;
    if (!turns_in_place(options)) {
      const double turn = remaining_turn_rad(from.heading_rad, waypoints[stop], from.heading_rad);
      part_s = std::max(part_s, duration(std::abs(turn), turning_limits(options, chassis)));
    }
    time_s += part_s + pause_s;
    from = waypoints[stop].pose;
    first = stop + 1;
  }
  return time_s;
}

}  // namespace outrider
