// Balls in flight among the robots of a team, whose bodies are upright cylinders of their radius and height.
//
// The distance of a ball from a body is Lipschitz in time, so conservative advancement (contact.hpp) never
// misses a contact. Level ground.
#pragma once

#include <optional>
#include <vector>

#include "outrider/ballistics/flight.hpp"
#include "outrider/jobs/guard/problem.hpp"
#include "outrider/motion/closest_approach.hpp"
#include "team/team_schedule.hpp"

namespace outrider {

/// A ball that was fired, or would be.
struct TeamBall {
  Flight flight;
  double fired_s = 0.0;
  double lands_s = 0.0;
};

/// Returns the true place of a robot that drives so, and stands between the drives and after the last.
/// O(waypoints).
Vec2 place_at(const RobotModel& robot, const TimedDrives& driven, double time_s);

/// Returns the first time since it was fired at which the ball touches the body of a robot that drives so.
std::optional<double> touches_body(const GuardProblem& problem, const TeamBall& ball,
                                   const TimedDrives& driven);

/// Returns true if the ball may come nearer than 5 cm to the body of a robot that is somewhere in these
/// presences while they last.
bool may_touch(const GuardProblem& problem, const TeamBall& ball, const std::vector<Presence>& present);

}  // namespace outrider
