// The parts of the navigator that notice when nothing goes on, and get the robot out.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "outrider/navigate/navigator.hpp"

namespace outrider {
namespace {

constexpr double better_s = 0.2;        // by which the time left has to fall to count as progress
constexpr double lately_s = 0.5;        // what was seen within that is not forgotten
constexpr double touch_ahead_m = 0.03;  // of the footprint, where a bumper was pressed
constexpr double back_off_mps = 0.2;
constexpr double turn_s = 2.5;
constexpr double back_off_s = 1.5;
constexpr double touch_back_s = 0.6;  // for which it backs off from what it has touched

}  // namespace

/// Notes what the bumper says. A robot that touches something backs off from there at once.
void Navigator::note_bumper(const Observation& seen) {
  const Pose2 here = pose();
  if (!seen.touching) {
    map_.keep_open(setup_.footprint, here);
    return;
  }
  const double bearing_rad = seen.touch_rad.value_or(odometry_.twist().ahead_mps < 0.0 ? pi : 0.0);
  const double away_m = setup_.footprint.outer_m() + touch_ahead_m;
  map_.note_touch(here * (away_m * direction(bearing_rad)), now_s());
  const double ahead = std::cos(bearing_rad);
  if (ahead * commanded_.ahead_mps <= 0.0 && ahead * odometry_.twist().ahead_mps < moved_mps)
    return;  // it was run into
  back_until_s_ = now_s() + touch_back_s;
  back_mps_ = ahead < 0.0 ? back_off_mps : -back_off_mps;
}

/// Returns the twist straight back from what was touched.
Twist2 Navigator::back_from_touch() {
  left_.nearer_s = track_.moved_s = now_s();
  look_around();
  const MotionState state = state_of({pose().position}, near_);
  const Twist2 back{std::clamp(back_mps_, -state.robot.speed_mps, state.robot.speed_mps), 0.0, 0.0};
  return can_brake(state, back, setup_.motion.margin_m) ? back : Twist2{};
}

/// Notes whether the robot gets nearer in time, in the end by turning, and recovers if it does not.
/// Recoveries are in a row until it is nearer than ever, so an order ends.
void Navigator::note_progress(const GoTo& order) {
  if (order.heading_rad && !setup_.robot.steers()) {
    const double off_rad = std::abs(wrap_angle(*order.heading_rad - pose().heading_rad));
    const double turn_left_s = off_rad / setup_.robot.turn_rate_radps;
    if (at_place_) {
      left_.now_s = turn_left_s;
    } else if (left_.now_s) {
      *left_.now_s += pi / setup_.robot.turn_rate_radps;  // as long as any turn
    }
  }
  if (left_.now_s && *left_.now_s < left_.least_s - better_s) {
    left_.least_s = *left_.now_s;
    left_.nearer_s = now_s();
  }
  if (left_.now_s && *left_.now_s < left_.best_s - better_s) {
    left_.best_s = *left_.now_s;
    recoveries_ = 0;
  }
  if (recovery_ != Recovery::none && now_s() >= recovers_until_s_ - instant_s) {
    recovery_ = Recovery::none;
    left_.nearer_s = now_s();
    left_.least_s = left_.now_s.value_or(std::numeric_limits<double>::infinity());
  }
  if (recovery_ == Recovery::none && now_s() - left_.nearer_s > setup_.options.patience_s + instant_s)
    recover(order);
}

/// Begins the next way out, or gives up.
void Navigator::recover(const GoTo& order) {
  if (recoveries_ >= setup_.options.most_recoveries) {
    const Vec2 to = order.place;
    if (!curves_.why_none.empty()) {
      progress_ = {Progress::State::blocked, {}, curves_.why_none};
      return;
    }
    progress_ = {
        Progress::State::blocked, left_.now_s,
        left_.now_s
            ? fmt::format("no progress towards ({:.2f}, {:.2f}) after {} recoveries", to.x, to.y, recoveries_)
            : fmt::format("no way to ({:.2f}, {:.2f}) around what stands there", to.x, to.y)};
    return;
  }
  constexpr std::pair<Recovery, double> ways[] = {
      {Recovery::forget, 0.0}, {Recovery::turn, turn_s}, {Recovery::back_off, back_off_s}};
  const auto& [way, takes_s] = ways[recoveries_++ % 3];
  recovery_ = way;
  recovers_until_s_ = now_s() + takes_s;
  if (way == Recovery::forget) map_.forget_but(now_s(), lately_s);
  curves_.way.reset();
  curves_.why_none.clear();
  curves_.arc.reset();
}

/// Returns the twist of a way out: a turn to where the way leads, or straight back; none if it is not safe.
Twist2 Navigator::recovery_twist(const MotionState& state) const {
  Twist2 twist;
  if (recovery_ == Recovery::turn) {
    const auto down = field_.downhill(state.pose.position);
    const double off_rad = down ? wrap_angle(heading_of(*down) - state.pose.heading_rad) : 1.0;
    twist.turn_radps = std::clamp(off_rad, -setup_.robot.turn_rate_radps, setup_.robot.turn_rate_radps);
  } else {
    twist.ahead_mps = -std::min(back_off_mps, state.robot.speed_mps);
  }
  return can_brake(state, twist, setup_.motion.margin_m) ? twist : Twist2{};
}

}  // namespace outrider
