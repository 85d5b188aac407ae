// The parts of the navigator that drive a robot that steers like a car to a place.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "outrider/navigate/curved_way.hpp"
#include "outrider/navigate/navigator.hpp"

namespace outrider {
namespace {

constexpr double off_way_m = 0.15;       // its way, from where it plans anew
constexpr double curves_beyond_m = 0.4;  // that is looked at ahead of where the robot could stop
constexpr double short_m = 0.05;         // before what stands on its way
constexpr double touched_part = 0.5;     // of the margin, with which a way is still free
constexpr double curves_again_s = 1.0;   // least time between two plans
constexpr double longer_curves_s = 1.5;  // a new way that takes so much longer counts as a recovery
constexpr double open_m = 4.0;           // of ground around a goal that lies outside the window
constexpr std::size_t most_curve_cells = 1'000'000;
constexpr double rim_m = 0.05;  // between the points around what moves
constexpr double away_m = 0.6;  // of an arc to get out of a place
constexpr double away_step_m = 0.03;
constexpr double away_mps = 0.2;
constexpr double shown_m = 0.1;                          // between the points of a way that is told
constexpr double slower_parts[] = {1.0, 0.6, 0.3, 0.1};  // parts of its speed that it tries

/// Returns the time that is left on a way, s.
double left_on(const TrackFollower& way, double speed_mps) {
  double left_m = 0.0;
  for (std::size_t i = way.at().piece; i < way.track()->size(); ++i)
    left_m += (i == way.at().piece ? 1.0 - way.at().part : 1.0) * length_of((*way.track())[i]);
  return left_m / speed_mps;
}

/// Returns points around what moves.
void add_moving(const std::vector<MovingThing>& moving, std::vector<Vec2>& points) {
  for (const MovingThing& thing : moving) {
    const int count = std::max(4, static_cast<int>(2.0 * pi * thing.radius_m / rim_m));
    for (int i = 0; i < count; ++i)
      points.push_back(thing.place + thing.radius_m * direction(2.0 * pi * i / count));
  }
}

std::string why_no_curves(Vec2 place, const RobotModel& robot, const Fault& fault) {
  const bool is_tight = fault.code == FaultCode::budget_exhausted;
  return fmt::format(
      "no way to ({:.2f}, {:.2f}) around what stands there{}", place.x, place.y,
      is_tight ? fmt::format(" was found with a turning radius of {:g} m", robot.turning_radius_m) : "");
}

}  // namespace

std::vector<Vec2> Navigator::way(double most_m) const {
  if (!curves_.way) return field_.way(pose().position, most_m);
  std::vector<Vec2> points = {pose().position};
  for (int i = 0; i * shown_m < most_m; ++i) {
    const auto place = curves_.way->ahead_of(curves_.way->at(), i * shown_m);
    points.push_back(
        curves_.way->pose_at(place.value_or(TrackPlace{curves_.way->track()->size(), 0.0})).position);
    if (!place) break;
  }
  return points;
}

/// Returns the next twist of a robot that steers on the way to a place.
Twist2 Navigator::go_in_curves(const GoTo& order) {
  look_around();
  near_.find_distances();
  const MotionState state = state_of(order, near_);
  if (in_zone_) {
    curves_.way.reset();
    static_cast<void>(zones_on_window());
    return leave_zone(state);
  }
  if (curves_.way) {
    curves_.way->note(state.pose);
    // It steers to the way, if it about looks along it, and else plans anew.
    if (curves_.way->heading_to_turn_to(state.pose)) curves_.way->go_on(state.pose);
    if (curves_.way->heading_to_turn_to(state.pose)) curves_.way.reset();
  }
  const bool arcs = recovery_ == Recovery::turn || recovery_ == Recovery::back_off;
  if (!arcs && needs_curves(state)) plan_curves(order);
  left_.now_s.reset();
  if (curves_.way) left_.now_s = left_on(*curves_.way, setup_.robot.speed_mps);
  note_progress(order);
  if (progress_.state != Progress::State::underway) return {};
  if (recovery_ == Recovery::turn || recovery_ == Recovery::back_off) return arc_away(state);
  return curves_.way && !curves_.way->is_done() ? along_curves(state) : Twist2{};
}

/// Returns true if there is no way, the robot has come off it or is at its end, or something stands on it.
bool Navigator::needs_curves(const MotionState& state) const {
  if (curves_.why_none.empty() && !curves_.way) return true;
  if (now_s() - curves_.planned_s < curves_again_s - instant_s) return false;
  if (!curves_.way) return map_.changes() != curves_.changes || recovery_ == Recovery::forget;
  if (curves_.way->is_done()) return std::abs(odometry_.twist().ahead_mps) < moved_mps;
  if (curves_.way->beside_m(state.pose.position) > off_way_m) return true;
  if (map_.changes() == curves_.changes) return false;
  Surroundings seen;
  seen.look(map_, state.pose.position, setup_.map.reach_m);
  seen.leave_inside(setup_.footprint, state.pose);
  const double least_m = std::min(touched_part * setup_.motion.margin_m,
                                  seen.gap(setup_.footprint, state.pose, Surroundings::most_m) - 1e-3);
  const auto is_free = [&](const Pose2& at) {
    return seen.gap(setup_.footprint, at, Surroundings::most_m) >= least_m;
  };
  return curves_.way->free_m(is_free, setup_.map.reach_m) < setup_.map.reach_m;
}

/// Plans a curved way, around what moves too where the robot did not get on. A way that is longer than the
/// one before counts as a recovery.
void Navigator::plan_curves(const GoTo& order) {
  const Pose2 here = pose();
  const bool was_underway = curves_.way.has_value() && !curves_.way->is_done();
  const double before_s = curves_.way ? left_on(*curves_.way, setup_.robot.speed_mps) : 0.0;
  curves_.planned_s = now_s();
  curves_.changes = map_.changes();
  GoalGround ground{map_.frame(), {}, nullptr, zones_on_window()};
  ZoneCells zones;
  if (far_ && localiser_->is_located()) {
    ground = far_->ground(map_, recoveries_ == 0);
  } else {
    ground.obstacles = map_.places();
    const Box2 window = map_.frame().bounds();
    const Vec2 low = order.place - Vec2{open_m, open_m}, high = order.place + Vec2{open_m, open_m};
    if (!window.contains(low) || !window.contains(high)) {
      Box2 box = window;
      box.include(low);
      box.include(high);
      for (const Mark& mark : map_.behind()) ground.obstacles.push_back(mark.place);
      double cell_m = setup_.map.resolution_m;
      for (ground.frame = covering(box, cell_m); ground.frame.size() > most_curve_cells;
           ground.frame = covering(box, cell_m))
        cell_m *= 1.25;
      zones = zones_.cells(ground.frame, room_of_zones_m());
      if (ground.zones != nullptr) ground.zones = &zones;
    }
  }
  if (recoveries_ > 0) add_moving(moving_, ground.obstacles);
  auto way = plan_curved_way(
      ground, setup_.footprint, setup_.robot,
      {here, order.place, order.within_m, order.heading_rad, setup_.motion.wide_m, setup_.motion.margin_m},
      workspace_);
  curves_.why_none.clear();
  if (!way) {
    curves_.why_none = why_no_curves(order.place, setup_.robot, way.error());
    return;
  }
  if (way->empty()) return;
  curves_.way.emplace(std::make_shared<const TrackPieces>(std::move(*way)));
  const double left_s = left_on(*curves_.way, setup_.robot.speed_mps);
  if (left_.best_s == std::numeric_limits<double>::infinity()) left_.best_s = left_s;
  if (!was_underway || left_s < before_s + longer_curves_s) return;
  if (recoveries_ >= setup_.options.most_recoveries) return;
  ++recoveries_;
  left_.least_s = left_s;
  left_.nearer_s = now_s();
}

/// Returns the next twist along the way, from which the robot can brake; slowly, or none, where it cannot.
Twist2 Navigator::along_curves(const MotionState& state) {
  if (!curves_.way) return {};
  const double speed_mps = std::abs(odometry_.twist().ahead_mps);
  const double look_m = speed_mps * speed_mps / setup_.robot.acceleration_mps2 + curves_beyond_m;
  const double least_m =
      std::min(setup_.motion.margin_m, near_.gap(setup_.footprint, state.pose, Surroundings::most_m) - 1e-3);
  const auto is_free = [&](const Pose2& at) {
    return near_.gap(setup_.footprint, at, Surroundings::most_m) >= least_m;
  };
  const double free_m = curves_.way->free_m(is_free, look_m);
  const double room_m = free_m < look_m ? std::max(0.0, free_m - short_m) : look_m;
  const Twist2 twist =
      drivable(curves_.way->twist(state.pose, limits_, setup_.options.period_s, room_m), setup_.robot);
  for (const double part : slower_parts) {
    if (can_brake(state, part * twist, setup_.motion.margin_m)) return part * twist;
  }
  return {};
}

/// Returns the twist along the longest free arc, ahead or backwards, for as long as a recovery lasts.
Twist2 Navigator::arc_away(const MotionState& state) {
  if (!curves_.arc) {
    const double ahead = std::min(away_mps, state.robot.speed_mps);
    const double least_m = std::min(setup_.motion.margin_m,
                                    near_.gap(setup_.footprint, state.pose, Surroundings::most_m) - 1e-3);
    double longest_m = 0.0;
    curves_.arc = Twist2{};
    for (const double way : {-1.0, 1.0}) {
      for (const double curve : {0.0, 1.0, -1.0}) {
        const Twist2 arc = drivable({way * ahead, 0.0, curve * state.robot.turn_rate_radps}, state.robot);
        double free_m = 0.0;
        while (free_m < away_m &&
               near_.gap(setup_.footprint, moved(state.pose, arc, (free_m + away_step_m) / ahead),
                         Surroundings::most_m) >= least_m)
          free_m += away_step_m;
        if (free_m <= longest_m) continue;
        longest_m = free_m;
        curves_.arc = arc;
      }
    }
  }
  return can_brake(state, *curves_.arc, setup_.motion.margin_m) ? *curves_.arc : Twist2{};
}

}  // namespace outrider
