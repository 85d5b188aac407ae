#include "team/team_balls.hpp"

#include <algorithm>
#include <cmath>

#include "outrider/ballistics/contact.hpp"
#include "outrider/jobs/guard/plan/passing.hpp"
#include "outrider/motion/profile.hpp"

namespace outrider {
namespace {

constexpr double ball_room_m = 0.05;  // for the errors of a shot

/// Distance of the surface of a ball from a body, some of whose axis is `beside_m` away; negative or 0 if
/// they touch.
double gap_to_body(const GuardProblem& problem, Vec3 ball, double beside_m) {
  const double floor_m = problem.world.floor_z_m;
  const double above_m = std::max({0.0, ball.z - floor_m - problem.robot.height_m, floor_m - ball.z});
  return std::hypot(std::max(0.0, beside_m - problem.robot.radius_m), above_m) - problem.gun.ball_radius_m;
}

/// Returns the first time in [from_s, until_s] of the flight at which `gap_at` is not above `near_m`. The gap
/// changes by no more than the ball moves, and by `speed_mps` in addition.
template <class GapAt>
std::optional<double> first_near(const Flight& flight, double from_s, double until_s, double speed_mps,
                                 double near_m, const GapAt& gap_at) {
  for (double t = from_s; t <= until_s;) {
    const double gap_m = gap_at(t) - near_m;
    if (gap_m <= contact_tolerance_m) return t;
    const double speed = norm(flight.velocity(t)) + speed_mps;
    t += 2.0 * gap_m / (speed + std::sqrt(speed * speed + 2.0 * flight.most_acceleration() * gap_m));
  }
  return std::nullopt;
}

}  // namespace

Vec2 place_at(const RobotModel& robot, const TimedDrives& driven, double time_s) {
  Pose2 pose = driven.start;
  for (const TimedDrive& drive : driven.drives) {
    if (time_s < drive.begin_s) break;
    const double heading_rad = drive.heading_rad.value_or(pose.heading_rad);
    for (const Straight& leg : straights(robot, heading_rad, drive.waypoints)) {
      const double after_s = time_s - drive.begin_s - leg.begin_s;
      if (after_s < 0.0) return leg.from;
      if (after_s < leg.length_s) return platform_on(robot, leg.from, leg.to, after_s).position;
      pose = {leg.to, heading_of(leg.to - leg.from)};
    }
  }
  return pose.position;
}

std::optional<double> touches_body(const GuardProblem& problem, const TeamBall& ball,
                                   const TimedDrives& driven) {
  return first_near(ball.flight, 0.0, ball.lands_s - ball.fired_s, problem.robot.speed_mps, 0.0,
                    [&](double t) {
                      const Vec3 at = ball.flight.position(t);
                      const Vec2 body = place_at(problem.robot, driven, ball.fired_s + t);
                      return gap_to_body(problem, at, distance(xy(at), body));
                    });
}

bool may_touch(const GuardProblem& problem, const TeamBall& ball, const std::vector<Presence>& present) {
  return std::ranges::any_of(present, [&](const Presence& piece) {
    const double from_s = std::max(piece.begin_s, ball.fired_s) - ball.fired_s;
    const double until_s = std::min(piece.end_s, ball.lands_s) - ball.fired_s;
    return first_near(ball.flight, from_s, until_s, 0.0, ball_room_m,
                      [&](double t) {
                        const Vec3 at = ball.flight.position(t);
                        return gap_to_body(problem, at, distance(xy(at), piece.within));
                      })
        .has_value();
  });
}

}  // namespace outrider
