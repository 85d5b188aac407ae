#include "motion/steer.hpp"

#include <algorithm>
#include <cmath>

#include "outrider/core/units.hpp"

namespace outrider {
namespace {

constexpr double least_lookahead_m = 0.3;
constexpr double lookahead_s = 0.6;           // at full speed to the point of the way that the robot aims at
constexpr double behind_rad = radians(60.0);  // off its heading, where it turns before it goes
constexpr double turn_gain = 3.0;             // 1/s, of turns in place
constexpr double slower[] = {1.0, 0.6, 0.3, 0.1};  // parts of its speed that it tries

class Steer final : public LocalMotion {
 public:
  explicit Steer(const LocalMotionOptions& options) : margin_m_(options.margin_m) {}

  Twist2 choose(const MotionState& state) override {
    const RobotModel& robot = state.robot;
    const Vec2 here = state.pose.position;
    const double lookahead_m = std::max(least_lookahead_m, lookahead_s * robot.speed_mps);
    const double left_m = distance(here, state.goal);
    const Vec2 aim = left_m < lookahead_m ? state.goal : state.field.way(here, lookahead_m).back();
    const Vec2 ahead = state.pose.to_local(aim);
    if (norm(ahead) < 1e-6) return {};
    const double off_rad = heading_of(ahead);
    if (std::abs(off_rad) < behind_rad) {
      const double per_m = 2.0 * ahead.y / squared_norm(ahead);  // curvature of the arc to there
      const double braking_mps = std::sqrt(robot.acceleration_mps2 * left_m);
      const double turning_mps = robot.turn_rate_radps / std::max(std::abs(per_m), 1e-6);
      const double most_mps = std::min({robot.speed_mps, braking_mps, turning_mps});
      for (const double part : slower) {
        const Twist2 arc{part * most_mps, 0.0, part * most_mps * per_m};
        if (can_brake(state, arc, margin_m_)) return arc;
      }
    }
    const Twist2 turn{0.0, 0.0,
                      std::clamp(turn_gain * off_rad, -robot.turn_rate_radps, robot.turn_rate_radps)};
    return can_brake(state, turn, margin_m_) ? turn : Twist2{};
  }

 private:
  double margin_m_;
};

}  // namespace

std::unique_ptr<LocalMotion> make_steer(const LocalMotionOptions& options) {
  return std::make_unique<Steer>(options);
}

}  // namespace outrider
