#include "outrider/sim/bodies/waypoint_body.hpp"

#include <cmath>

#include "outrider/motion/profile.hpp"

namespace outrider {
namespace {

constexpr double sample_period_s = 0.1;

}  // namespace

WaypointBody::WaypointBody(const RobotModel& robot, const BodyGround& on, const Pose2& start,
                           const ExecutionErrors& errors, const Rng& rng, const WayFaults& faults)
    : robot_(robot),
      on_(on),
      errors_(errors),
      rng_(rng),
      pose_(start),
      hindrance_(faults, robot.radius_m, [&ground = on.ground, radius_m = robot.radius_m](Segment line) {
        return ground.segment_free(line, radius_m);
      }) {}

std::vector<Vec2> WaypointBody::displaced_waypoints(std::vector<Vec2> waypoints) {
  const Vec2 error = random_in_disk(rng_, errors_.position_m);
  heading_error_rad_ = errors_.heading_rad * rng_.uniform(-1.0, 1.0);
  waypoints.back() = displaced_goal(waypoints, robot_.radius_m, on_.ground, on_.rules, error);
  return waypoints;
}

void WaypointBody::turn_to(double heading_rad, const std::function<void()>& sample) {
  const double from = pose_.heading_rad;
  const double turn = wrap_angle(heading_rad - from);
  const double whole = duration(std::abs(turn), robot_.turning());
  const double begin = time_s_;
  const auto cut_s = hindrance_.cuts_turn(begin, begin + whole);
  const double total = cut_s ? *cut_s - begin : whole;
  for (int i = 1; i * sample_period_s < total; ++i) {
    const double t = i * sample_period_s;
    const double done = covered(std::abs(turn), robot_.turning(), t);
    time_s_ = begin + t;
    pose_.heading_rad = wrap_angle(from + std::copysign(done, turn));
    sample();
  }
  time_s_ = begin + total;
  const double done = cut_s ? covered(std::abs(turn), robot_.turning(), total) : std::abs(turn);
  pose_.heading_rad = cut_s ? wrap_angle(from + std::copysign(done, turn)) : heading_rad;
  turned_rad_ += done;
  if (cut_s) give_up_way();
  if (total > 0.0) sample();
}

StraightDrive WaypointBody::begin_straight(Vec2 goal, const std::function<void()>& sample) {
  const Vec2 from = pose_.position;
  const double length = on_.ground.length({from, goal});
  if (length == 0.0) return {from, goal, 0.0, time_s_, 0.0};
  turn_to(heading_of(goal - from), sample);
  if (stopped_) return {from, goal, 0.0, time_s_, 0.0};
  return {from, goal, length, time_s_, duration(length, robot_.straight())};
}

void WaypointBody::be_on(const StraightDrive& drive, double after_s) {
  time_s_ = drive.begin_s + after_s;
  pose_.position = point_on(drive, covered(drive.length_m, robot_.straight(), after_s));
}

Vec2 WaypointBody::point_on(const StraightDrive& drive, double way_m) const {
  const HeightField* const terrain = on_.ground.terrain();
  return terrain != nullptr ? terrain->walked({drive.from, drive.goal}, way_m)
                            : drive.from + way_m / drive.length_m * (drive.goal - drive.from);
}

Platform WaypointBody::platform_on(const StraightDrive& drive, double after_s) const {
  const Vec2 at = point_on(drive, covered(drive.length_m, robot_.straight(), after_s));
  const double speed = speed_after(drive.length_m, robot_.straight(), after_s);
  const HeightField* const terrain = on_.ground.terrain();
  if (terrain == nullptr) return {at, speed / drive.length_m * (drive.goal - drive.from)};
  const Vec2 along = 1.0 / distance(drive.from, drive.goal) * (drive.goal - drive.from);
  const double slope = dot(terrain->gradient(at), along);
  const double level = speed / std::hypot(1.0, slope);
  return {at, level * along, level * slope};
}

Stance WaypointBody::stance_on(Vec2 from, Vec2 to, double after_s) const {
  const double length = on_.ground.length({from, to});
  if (length == 0.0) return stance_at(on_.rules, from);
  const StraightDrive drive{from, to, length, 0.0, 0.0};
  return stance_at(on_.rules, point_on(drive, covered(length, robot_.straight(), after_s)));
}

void WaypointBody::end_straight(const StraightDrive& drive) {
  time_s_ = drive.begin_s + drive.total_s;
  pose_.position = drive.goal;
  driven_m_ += drive.length_m;
}

std::optional<double> WaypointBody::stopped_after_s(const StraightDrive& drive) {
  return hindrance_.cuts_leg(
      {{drive.from, drive.goal}, robot_.straight(), drive.begin_s, drive.total_s, hindrance_.kidnapped()});
}

void WaypointBody::cut_short(const StraightDrive& drive, double after_s) {
  be_on(drive, after_s);
  driven_m_ += covered(drive.length_m, robot_.straight(), after_s);
  give_up_way();
}

void WaypointBody::give_up_way() {
  stopped_ = true;
  hindrance_.note_cut();
  time_s_ += hindrance_.gives_up_after_s(time_s_);
}

bool WaypointBody::suffer() {
  const auto elsewhere = hindrance_.put_elsewhere(pose_, time_s_);
  if (elsewhere) pose_ = *elsewhere;
  return elsewhere.has_value();
}

void WaypointBody::end_way() { pose_.heading_rad = wrap_angle(pose_.heading_rad + heading_error_rad_); }

}  // namespace outrider
