#include "outrider/motion/presence.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "outrider/motion/profile.hpp"
#include "outrider/motion/straights.hpp"

namespace outrider {
namespace {

constexpr double no_end_s = std::numeric_limits<double>::infinity();
constexpr double piece_s = 0.25;  // longest piece of a drive that is compared at once

/// Bounds on what a drive may be off its leg if it ends beside the end of the leg.
struct LegError {
  double shift_s = 0.0;  // the turn to the leg takes so much more or less
  double delay_s = 0.0;  // the drive is so much later at its end, at most
  double along_m = 0.0;  // at a time after the turn, from its place on the leg
};

LegError leg_error(const RobotModel& robot, const Straight& leg, double error_m) {
  if (error_m == 0.0) return {};
  const double length = distance(leg.from, leg.to);
  const double shift_s = duration(error_m < length ? std::asin(error_m / length) : pi, robot.turning());
  // The way driven after some time changes by no more than the length, and so does its part of the length.
  return {shift_s, shift_s + duration(length + error_m, robot.straight()) - leg.length_s, 2.0 * error_m};
}

/// Adds where a robot is while it turns to a leg, from `time_s` on, and drives it.
void add_leg_presences(std::vector<Presence>& present, const RobotModel& robot, const Straight& leg,
                       double time_s, double leaves_s, const LegError& error) {
  present.push_back({time_s, leaves_s + error.shift_s, {leg.from, leg.from}});
  const Limits straight = robot.straight();
  const double length = distance(leg.from, leg.to);
  const Vec2 ahead = 1.0 / length * (leg.to - leg.from);
  const auto pieces = static_cast<int>(std::ceil(leg.length_s / piece_s));
  for (int i = 0; i < pieces; ++i) {
    const double begin_s = leg.length_s * i / pieces, end_s = leg.length_s * (i + 1) / pieces;
    const double rear = std::max(0.0, covered(length, straight, begin_s) - error.along_m);
    const double front = std::min(length, covered(length, straight, end_s) + error.along_m);
    present.push_back({std::max(time_s, leaves_s + begin_s - error.shift_s),
                       leaves_s + end_s + (i + 1 < pieces ? error.shift_s : error.delay_s),
                       {leg.from + rear * ahead, i + 1 < pieces ? leg.from + front * ahead : leg.to}});
  }
}

}  // namespace

Presence standing(Vec2 place, double begin_s) { return {begin_s, no_end_s, {place, place}}; }

std::vector<Presence> presences(const RobotModel& robot, double heading_rad,
                                const std::vector<Vec2>& waypoints, double begin_s, double arrival_error_m) {
  std::vector<Presence> result;
  const std::vector<Straight> legs = straights(robot, heading_rad, waypoints);
  double time_s = begin_s;
  for (std::size_t k = 0; k < legs.size(); ++k) {
    const bool last = k + 1 == legs.size();
    const LegError error = last ? leg_error(robot, legs[k], arrival_error_m) : LegError{};
    add_leg_presences(result, robot, legs[k], time_s, begin_s + legs[k].begin_s, error);
    time_s = result.back().end_s;
  }
  result.push_back(standing(waypoints.back(), time_s));
  return result;
}

bool keep_apart(const std::vector<Presence>& one, const std::vector<Presence>& other, double gap_m) {
  auto first = other.begin();
  for (const Presence& own : one) {
    while (first != other.end() && first->end_s < own.begin_s) ++first;
    for (auto theirs = first; theirs != other.end() && theirs->begin_s <= own.end_s; ++theirs) {
      if (distance(own.within, theirs->within) < gap_m) return false;
    }
  }
  return true;
}

}  // namespace outrider
