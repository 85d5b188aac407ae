#include "outrider/navigate/local_motion.hpp"

#include <algorithm>
#include <cmath>

#include "motion/dynamic_window.hpp"
#include "motion/sampled_motion.hpp"
#include "motion/steer.hpp"

namespace outrider {
namespace {

constexpr double brake_step_s = 0.02;
constexpr double moving_room_m = 0.1;                    // from what moves
constexpr double sure_mps = 0.2, most_unsure_mps = 0.5;  // standard deviation of its velocity
constexpr double rounding_m = 1e-4;                      // by which a gap may become less because of rounding
constexpr double instant_m = 1e-9;  // the same of a gap to a keep-out zone, which never closes

/// Returns the point of a segment that is nearest to a place.
Vec2 nearest_between(Vec2 from, Vec2 to, Vec2 place) {
  const Vec2 along = to - from;
  const double length2 = squared_norm(along);
  return length2 == 0.0 ? from : from + std::clamp(dot(place - from, along) / length2, 0.0, 1.0) * along;
}

}  // namespace

std::vector<Option> describe(LocalMotionOptions& options) {
  return {
      choice_option("rule", "how the next motion is found", &options.rule, names_of(local_motions())),
      {"margin", "m", 0.0, 1.0, "room beside the footprint that a motion keeps", &options.margin_m},
      {"horizon", "s", 0.2, 10.0, "time for which motions are predicted", &options.horizon_s},
      {"samples", "", 8, 10000, "motions sampled in each round", &options.samples},
      {"rounds", "", 1, 20, "rounds of sampling in each period", &options.rounds},
      {"wide", "m", 0.01, 2.0, "room beside the footprint beyond which more is worth nothing",
       &options.wide_m},
      {"room_weight", "", 0.0, 100.0, "seconds that a second without room costs at full speed",
       &options.room_weight},
  };
}

const std::vector<LocalMotionRow>& local_motions() {
  static const std::vector<LocalMotionRow> rows = {
      {"sampled", "optimises motions of the footprint in time by sampling", make_sampled_motion},
      {"dwa", "the dynamic window approach, as a baseline", make_dynamic_window},
      {"steer", "pure pursuit of the planned way, as a baseline", make_steer},
  };
  return rows;
}

double MotionState::moving_gap(const Pose2& at, double after_s, double most, bool swept) const {
  double least = most;
  if (moving == nullptr) return least;
  for (const MovingThing& thing : *moving) {
    const Vec2 then = thing.place_after(after_s);
    const Vec2 nearest = swept ? nearest_between(thing.place, then, at.position) : then;
    const Vec2 off = nearest - at.position;
    const double radius_m =
        thing.radius_m +
        (swept ? std::clamp(thing.sigma_mps - sure_mps, 0.0, most_unsure_mps) * after_s : 0.0);
    if (norm(off) - radius_m - footprint.outer_m() >= least) continue;
    least = std::min(least, footprint.gap_m(unrotated(at.heading_rad, off)) - radius_m);
  }
  return least;
}

bool can_brake(const MotionState& state, const Twist2& commanded, double margin_m) {
  if (commanded.ahead_mps < 0.0 && !state.may_back) return false;
  const double enough_m = 0.5 * Surroundings::most_m;
  double gap_m = state.near.gap(state.footprint, state.pose, enough_m);
  const double least_m = std::min(margin_m, gap_m - rounding_m);
  const double least_inside_m = state.near.inside_gap(state.footprint, state.pose) - rounding_m;
  const double zone_most_m = state.near.zone_margin_m() + enough_m;
  double zone_m = state.near.zone_gap(state.footprint, state.pose, zone_most_m);
  const double least_zone_m = std::min(state.near.zone_margin_m(), zone_m - instant_m);
  double passed_s = 0.0;
  Pose2 pose = state.pose;
  Twist2 twist = state.twist;
  double left_s = state.period_s;
  while (left_s > 0.0 || twist.ahead_mps != 0.0 || twist.turn_radps != 0.0) {
    const double step_s = left_s > 0.0 ? std::min(brake_step_s, left_s) : brake_step_s;
    const Twist2 next = twist_after(twist, left_s > 0.0 ? commanded : Twist2{}, state.robot, step_s);
    pose = moved_evenly(pose, twist, next, step_s);
    const double moved_m =
        (std::max(std::abs(twist.ahead_mps), std::abs(next.ahead_mps)) +
         state.footprint.outer_m() * std::max(std::abs(twist.turn_radps), std::abs(next.turn_radps))) *
        step_s;
    const double before_m = gap_m;
    gap_m = state.near.gap(state.footprint, pose, enough_m);
    // Between the two poses no point of the footprint is more than half the way from where it is at one of
    // them.
    if (gap_m < least_m || (before_m + gap_m - moved_m < 0.0 && least_m >= 0.0)) return false;
    if (state.near.inside_gap(state.footprint, pose) < least_inside_m) return false;
    const double zone_before_m = zone_m;
    zone_m = state.near.zone_gap(state.footprint, pose, zone_most_m);
    if (zone_m < least_zone_m || zone_before_m + zone_m - moved_m < 0.0) return false;
    twist = next;
    left_s -= step_s;
    passed_s += step_s;
    if (state.moving_gap(pose, passed_s, moving_room_m, true) < moving_room_m) return false;
  }
  return true;
}

}  // namespace outrider
