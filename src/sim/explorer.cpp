#include "outrider/sim/explorer.hpp"

#include <algorithm>
#include <cmath>

namespace outrider {
namespace {

constexpr double step_s = 0.005;
constexpr double instant_s = 1e-9;  ///< times closer than this are one
constexpr double apart_m = 1e-3;    ///< a robot so far from everything touches it no more
constexpr double farthest_m = 1.0;  ///< that gap_m() tells
constexpr int halvings = 20;        ///< with which the place of a contact is found

/// What the solids put in the way between what the wheels climb and the robot's top.
std::vector<RoundedPolygon> obstacles(const World& world, const RobotModel& robot, double climbs_m) {
  return Ground::of(world, robot.height_m, climbs_m, robot.max_slope_rad).obstacles();
}

Box2 box_around(const std::vector<RoundedPolygon>& pieces) {
  Box2 box;
  for (const RoundedPolygon& piece : pieces) {
    box.include(piece.bounds().low);
    box.include(piece.bounds().high);
  }
  return box;
}

double nearer_by(double from, double to, double most) { return from + std::clamp(to - from, -most, most); }

}  // namespace

ExplorerGround::ExplorerGround(const World& world, const RobotModel& robot, double climbs_m)
    : radius_m_(robot.radius_m), ground_({{0.0, 0.0}, {0.0, 0.0}}, {}) {
  std::vector<RoundedPolygon> pieces = obstacles(world, robot, climbs_m);
  bounds_ = box_around(pieces);
  if (!bounds_.empty()) ground_ = Ground(bounds_.grown(2.0 * (radius_m_ + farthest_m)), std::move(pieces));
}

bool ExplorerGround::free(Segment s) const {
  if (bounds_.empty()) return true;
  const Box2 near = bounds_.grown(radius_m_ + farthest_m);
  if (near.contains(s.a) && near.contains(s.b)) return ground_.segment_free(s, radius_m_);
  const std::vector<Vec2> corners = {
      near.low, {near.high.x, near.low.y}, near.high, {near.low.x, near.high.y}};
  const auto inside = cut(corners, s.a, s.b - s.a, 0.0, 1.0);
  if (!inside) return true;
  const auto at = [&](double t) { return s.a + t * (s.b - s.a); };
  return ground_.segment_free({at(inside->low), at(inside->high)}, radius_m_);
}

double ExplorerGround::gap_m(Vec2 centre) const {
  if (bounds_.empty() || !bounds_.grown(radius_m_ + farthest_m).contains(centre)) return farthest_m;
  return ground_.clearance(centre, radius_m_ + farthest_m) - radius_m_;
}

SimulatedExplorer::SimulatedExplorer(const World& world, const Pose2& start, const RobotModel& robot,
                                     const ExplorerTruth& truth, std::uint64_t seed)
    : robot_(robot),
      wheels_(truth.wheels),
      laser_(world, truth.laser),
      ground_(world, robot, truth.wheels.climbs_m),
      laser_rng_(Rng(seed).child("laser")),
      wheel_rng_(Rng(seed).child("wheels")),
      pose_(start) {
  left_scale_ += wheels_.scale_error * wheel_rng_.normal();
  right_scale_ += wheels_.scale_error * wheel_rng_.normal();
}

ExplorerObservation SimulatedExplorer::sense() {
  ExplorerObservation seen{time_s_, odometry_, std::nullopt, touching_ || touched_};
  const double turns = (time_s_ + instant_s) * laser_.model().rate_hz;
  if (turns >= static_cast<double>(turns_)) {
    seen.scan = laser_.look(compose(pose_, laser_.model().robot_T_laser), time_s_, laser_rng_);
    turns_ = static_cast<std::int64_t>(turns) + 1;
  }
  touched_ = false;
  return seen;
}

void SimulatedExplorer::act(const ExplorerCommand& command) {
  while (time_s_ < command.until_s - instant_s) {
    const bool last = command.until_s - time_s_ < step_s + instant_s;
    const double duration_s = last ? command.until_s - time_s_ : step_s;
    speed_up(command.twist, duration_s);
    pass(duration_s);
    time_s_ = last ? command.until_s : time_s_ + step_s;
  }
}

void SimulatedExplorer::speed_up(const Twist2& wanted, double duration_s) {
  const double ahead = std::clamp(wanted.ahead_mps, -robot_.speed_mps, robot_.speed_mps);
  const double turn = std::clamp(wanted.turn_radps, -robot_.turn_rate_radps, robot_.turn_rate_radps);
  twist_.ahead_mps = nearer_by(twist_.ahead_mps, ahead, robot_.acceleration_mps2 * duration_s);
  twist_.turn_radps = nearer_by(twist_.turn_radps, turn, robot_.turn_acceleration_radps2 * duration_s);
}

void SimulatedExplorer::pass(double duration_s) {
  count_wheels(duration_s);
  Pose2 next = moved(pose_, twist_, duration_s);
  const Vec2 here = pose_.position;
  const Vec2 way = next.position - here;
  if (!ground_.free({here, next.position})) {
    double free = 0.0;
    double part = 0.5;
    for (int i = 0; i < halvings; ++i, part *= 0.5) {
      if (ground_.free({here, here + (free + part) * way})) free += part;
    }
    next.position = here + free * way;
    if (!touching_) ++contacts_;
    touching_ = touched_ = true;
  } else if (touching_) {
    touching_ = ground_.gap_m(next.position) < apart_m;
  }
  driven_m_ += distance(here, next.position);
  turned_rad_ += std::abs(next.heading_rad - pose_.heading_rad);
  pose_ = next;
}

/// The way of a wheel as the robot counts it.
double SimulatedExplorer::counted_m(double way_m, double scale) {
  return scale * way_m + wheels_.noise_m * std::sqrt(std::abs(way_m)) * wheel_rng_.normal();
}

void SimulatedExplorer::count_wheels(double duration_s) {
  const double aside = 0.5 * wheels_.track_m * twist_.turn_radps;
  const double left_m = counted_m((twist_.ahead_mps - aside) * duration_s, left_scale_);
  const double right_m = counted_m((twist_.ahead_mps + aside) * duration_s, right_scale_);
  odometry_ = moved(odometry_, {0.5 * (left_m + right_m), 0.0, (right_m - left_m) / wheels_.track_m}, 1.0);
}

}  // namespace outrider
