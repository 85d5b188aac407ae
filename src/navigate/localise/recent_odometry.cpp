#include "outrider/navigate/recent_odometry.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "outrider/motion/limited_twist.hpp"

namespace outrider {
namespace {

constexpr double measured_part = 0.3;                     // of the measured twist in the believed one
constexpr double faster_part = 1.2;                       // of its limits, than which no robot is
constexpr double most_time_s = 1e12, most_place_m = 1e6;  // of what makes sense

bool makes_sense(const Pose2& pose) {
  return std::abs(pose.position.x) <= most_place_m && std::abs(pose.position.y) <= most_place_m &&
         std::abs(pose.heading_rad) <= most_place_m;
}

}  // namespace

void RecentOdometry::note(const Observation& seen, const Twist2& commanded, const RobotModel& robot,
                          double period_s) {
  const TimedOdometry last = track_.empty() ? TimedOdometry{} : track_.back();
  Pose2 odometry = makes_sense(seen.odometry) ? seen.odometry : last.odometry;
  double time_s = std::abs(seen.time_s) <= most_time_s ? seen.time_s + ahead_s_ : last.time_s;
  if (!track_.empty()) {
    // A heading that was wrapped is no whole turn.
    odometry.heading_rad =
        last.odometry.heading_rad + wrap_angle(odometry.heading_rad - last.odometry.heading_rad);
    if (time_s < last.time_s - remembered_s) {  // the clock was put back
      ahead_s_ += last.time_s + period_s - time_s;
      time_s = last.time_s + period_s;
    }
    const double passed_s = time_s - last.time_s;
    if (passed_s <= 0.0) return;
    const Twist2 then = twist_after(twist_, commanded, robot, passed_s);
    const Twist2 expected = 0.5 * (twist_ + then);
    const Twist2 measured = twist_between(last.odometry, odometry, passed_s);
    const Twist2 believed = then + measured_part * (measured + -1.0 * expected);
    const double most_mps = faster_part * robot.speed_mps;
    const double most_radps = faster_part * robot.turn_rate_radps;
    twist_ = {std::clamp(believed.ahead_mps, -most_mps, most_mps), 0.0,
              std::clamp(believed.turn_radps, -most_radps, most_radps)};
  }
  track_.push_back({time_s, odometry});
  while (track_.size() > 2 && track_.front().time_s < time_s - remembered_s) track_.pop_front();
  time_s_ = time_s;
}

Pose2 RecentOdometry::at(double time_s) const {
  for (std::size_t i = track_.size() - 1; i > 0; --i) {
    const TimedOdometry &from = track_[i - 1], &to = track_[i];
    if (time_s < from.time_s) continue;
    const double part = std::clamp((time_s - from.time_s) / (to.time_s - from.time_s), 0.0, 1.0);
    return moved(from.odometry, twist_between(from.odometry, to.odometry, 1.0), part);
  }
  return track_.front().odometry;
}

}  // namespace outrider
