#include "outrider/sim/bodies/twist_body.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "outrider/log/log.hpp"
#include "outrider/motion/limited_twist.hpp"
#include "times.hpp"

namespace outrider {
namespace {

constexpr double apart_m = 1e-3;      ///< a robot so far from everything touches it no more
constexpr double at_rest_mps = 0.02;  ///< no faster, the robot does not drive
constexpr double hand_m = 0.1;        ///< who puts a robot down leaves so much room around it
constexpr int halvings = 20;          ///< with which the place of a contact is found

}  // namespace

TwistBody::TwistBody(const World& world, const Pose2& start, const RobotModel& robot,
                     const ExplorerWheels& wheels, const Rng& wheel_rng, const ExplorerFaults& faults,
                     const Rng& walk_in_rng, std::optional<Footprint> footprint)
    : robot_(robot),
      wheels_(wheels),
      faults_(faults),
      footprint_(std::move(footprint)),
      ground_(world, robot, wheels.climbs_m),
      walk_ins_(world, start.position, wheels.climbs_m, faults.walk_ins, walk_in_rng),
      wheel_rng_(wheel_rng),
      start_(start),
      pose_(start) {
  left_scale_ += wheels_.scale_error * wheel_rng_.normal();
  right_scale_ += wheels_.scale_error * wheel_rng_.normal();
}

double TwistBody::begin(const Command& command) {
  const auto* drive = std::get_if<DriveTwist>(&command);
  if (drive == nullptr) return time_s_;
  wanted_ = drive->twist;
  return logged_time(drive->until_s);
}

void TwistBody::run_until(double time_s) {
  while (time_s_ < time_s - instant_s) {
    const bool last = time_s - time_s_ < body_step_s + instant_s;
    const double duration_s = last ? time_s - time_s_ : body_step_s;
    twist_ = twist_after(twist_, wanted_, robot_, duration_s);
    walk_ins_.advance(time_s_, {pose_, robot_.radius_m, twist_.ahead_mps > at_rest_mps}, ground_);
    pass(duration_s);
    time_s_ = last ? time_s : time_s_ + body_step_s;
  }
}

void TwistBody::put(const Pose2& pose) {
  const Vec2 whole = pose.position - pose_.position;
  double part = 1.0;
  for (int i = 0; i < halvings && ground_.gap_m(pose_.position + part * whole) < hand_m; ++i) part *= 0.5;
  const Vec2 there = pose_.position + part * whole;
  pose_ = {ground_.gap_m(there) < hand_m ? pose_.position : there, pose.heading_rad};
  twist_ = {};
}

bool TwistBody::take_touch() {
  const bool touched = touching_ || touched_;
  touched_ = false;
  return touched;
}

void TwistBody::pass(double duration_s) {
  const Twist2 on_wheels = rolled();
  count_wheels(on_wheels, duration_s);
  const double grip = 1.0 - faults_.slip;
  Pose2 next = moved(pose_, {grip * on_wheels.ahead_mps, 0.0, grip * on_wheels.turn_radps}, duration_s);
  const Vec2 here = pose_.position;
  const bool open =
      footprint_ ? room_m(next) >= 0.0 || room_m(next) > room_m(pose_) : free({here, next.position});
  if (!open) {
    const bool comes_nearer = footprint_ ? room_m(next) < room_m(pose_) : next.position != here;
    if (!touching_) ++(!comes_nearer || is_walked_into(next) ? walked_into_ : contacts_);
    if (comes_nearer) stop_at_contact(next);
    touching_ = touched_ = true;
    touch_rad_ = wrap_angle(towards_nearest(next.position) - next.heading_rad);
  } else if (touching_) {
    touching_ = room_m(next) < apart_m;
  }
  driven_m_ += distance(here, next.position);
  turned_rad_ += std::abs(next.heading_rad - pose_.heading_rad);
  pose_ = next;
  moving_room_m_ = moving_room_m(pose_);
}

/// Returns true if the robot is commanded to stand, or to turn in place, and touches what comes to it faster
/// than it goes there.
bool TwistBody::is_walked_into(const Pose2& next) const {
  if (wanted_.ahead_mps != 0.0) return false;
  const double now_m = moving_room_m(pose_), then_m = moving_room_m(next);
  return then_m <= room_m(next) && moving_room_m_ - now_m > now_m - then_m;
}

/// The robot would touch something on the way to a pose: a disk turns and stops where it touches, a footprint
/// does not move.
void TwistBody::stop_at_contact(Pose2& next) {
  if (footprint_) {
    next = pose_;
    return;
  }
  const Vec2 here = pose_.position, way = next.position - here;
  double open = 0.0;
  double part = 0.5;
  for (int i = 0; i < halvings; ++i, part *= 0.5) {
    if (free({here, here + (open + part) * way})) open += part;
  }
  next.position = here + open * way;
}

/// Returns true if the robot touches nothing new on the way. It may leave who has come too near.
bool TwistBody::free(Segment way) const {
  if (!ground_.free(way)) return false;
  const double gap_m = walk_ins_.gap_m(way, robot_.radius_m);
  return gap_m >= 0.0 ||
         walk_ins_.gap_m({way.b, way.b}, robot_.radius_m) > walk_ins_.gap_m({way.a, way.a}, robot_.radius_m);
}

/// Returns the gap between the robot at a pose and what is nearest.
double TwistBody::room_m(const Pose2& pose) const {
  const Vec2 centre = pose.position;
  const double ground_m = footprint_ ? ground_.gap_m(*footprint_, pose) : ground_.gap_m(centre);
  return std::min(ground_m, moving_room_m(pose));
}

/// The same to the people and posts that no map has.
double TwistBody::moving_room_m(const Pose2& pose) const {
  if (!footprint_) return walk_ins_.gap_m({pose.position, pose.position}, robot_.radius_m);
  double least_m = std::numeric_limits<double>::infinity();
  for (const RoundedPolygon& disk : walk_ins_.disks())
    least_m = std::min(least_m, footprint_->gap_m(pose, disk));
  return least_m;
}

double TwistBody::towards_nearest(Vec2 centre) const {
  if (ground_.gap_m(centre) <= walk_ins_.gap_m({centre, centre}, robot_.radius_m))
    return ground_.towards_nearest(centre);
  const auto nearest = std::ranges::min_element(
      walk_ins_.disks(), {}, [&](const RoundedPolygon& disk) { return signed_distance(centre, disk); });
  return heading_of(nearest->core.front() - centre);
}

/// The way of a wheel as the robot counts it.
double TwistBody::counted_m(double way_m, double scale) {
  return scale * way_m + wheels_.noise_m * std::sqrt(std::abs(way_m)) * wheel_rng_.normal();
}

/// The twist as the wheels roll it: with a stuck left wheel the robot circles about that.
Twist2 TwistBody::rolled() const {
  if (!faults_.stuck(time_s_)) return twist_;
  const double right_mps = twist_.ahead_mps + 0.5 * wheels_.track_m * twist_.turn_radps;
  return {0.5 * right_mps, 0.0, right_mps / wheels_.track_m};
}

void TwistBody::count_wheels(const Twist2& rolled, double duration_s) {
  const double aside = 0.5 * wheels_.track_m * rolled.turn_radps;
  const double left_m = counted_m((rolled.ahead_mps - aside) * duration_s, left_scale_);
  const double right_m = counted_m((rolled.ahead_mps + aside) * duration_s, right_scale_);
  odometry_ = moved(odometry_, {0.5 * (left_m + right_m), 0.0, (right_m - left_m) / wheels_.track_m}, 1.0);
}

}  // namespace outrider
