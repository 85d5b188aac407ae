#include "motion/dynamic_window.hpp"

#include <algorithm>
#include <cmath>

namespace outrider {
namespace {

constexpr double lookahead_m = 1.5;  // to the point of the way that the robot aims at
constexpr double foresight_s = 1.0;
constexpr int speeds = 9;
constexpr int turns = 21;
// Weights of Fox et al.: heading, clearance, speed.
constexpr double heading_weight = 2.0;
constexpr double clearance_weight = 0.2;
constexpr double speed_weight = 0.2;
constexpr double far_m = 0.5;  // clearance beyond which more is worth nothing

class DynamicWindow final : public LocalMotion {
 public:
  explicit DynamicWindow(const LocalMotionOptions& options) : options_(options) {}

  Twist2 choose(const MotionState& state) override {
    const RobotModel& robot = state.robot;
    const double reach_s = std::max(state.period_s, 0.25);
    Twist2 low = twist_after(state.twist, {0.0, 0.0, -robot.turn_rate_radps}, robot, reach_s);
    Twist2 high = twist_after(state.twist, {robot.speed_mps, 0.0, robot.turn_rate_radps}, robot, reach_s);
    const double to_goal_m = distance(state.pose.position, state.goal);
    high.ahead_mps =
        std::min({high.ahead_mps, robot.speed_mps, std::sqrt(robot.acceleration_mps2 * to_goal_m)});
    low.ahead_mps = std::clamp(low.ahead_mps, 0.0, high.ahead_mps);
    const Vec2 aim =
        to_goal_m < lookahead_m ? state.goal : state.field.way(state.pose.position, lookahead_m).back();
    Twist2 best;
    double most = -1.0;
    for (int i = 0; i < speeds; ++i) {
      for (int k = 0; k < turns; ++k) {
        const Twist2 twist{low.ahead_mps + (high.ahead_mps - low.ahead_mps) * i / (speeds - 1), 0.0,
                           low.turn_radps + (high.turn_radps - low.turn_radps) * k / (turns - 1)};
        const double worth = worth_of(state, twist, aim);
        if (worth <= most || !can_brake(state, twist, options_.margin_m)) continue;
        most = worth;
        best = twist;
      }
    }
    return best;
  }

 private:
  /// Returns the objective of a pair; negative where it touches something.
  [[nodiscard]] double worth_of(const MotionState& state, const Twist2& twist, Vec2 aim) const {
    double room_m = far_m;
    for (int step = 1; step <= 5; ++step) {
      const Pose2 pose = moved(state.pose, twist, foresight_s * step / 5);
      room_m = std::min(room_m, state.near.gap(state.footprint, pose, far_m));
      if (room_m < options_.margin_m) return -1.0;
    }
    const double ahead_s =
        0.5 * foresight_s * std::min(1.0, distance(state.pose.position, aim) / lookahead_m);
    const Pose2 then = moved(state.pose, twist, ahead_s);
    const double off_rad = std::abs(wrap_angle(heading_of(aim - then.position) - then.heading_rad));
    return heading_weight * (1.0 - off_rad / pi) + clearance_weight * room_m / far_m +
           speed_weight * twist.ahead_mps / state.robot.speed_mps;
  }

  LocalMotionOptions options_;
};

}  // namespace

std::unique_ptr<LocalMotion> make_dynamic_window(const LocalMotionOptions& options) {
  return std::make_unique<DynamicWindow>(options);
}

}  // namespace outrider
