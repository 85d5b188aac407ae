#include "outrider/sim/bodies/wheel_body.hpp"

#include <algorithm>
#include <cmath>

#include "times.hpp"

namespace outrider {
namespace {

constexpr double at_rest_radps = 1e-3;  ///< slower wheels stand

}  // namespace

WheelBody::WheelBody(Chassis chassis, const WheelFaults& faults, const LinkFaults& link, double patience_s,
                     const Pose2& start, const Rng& rng)
    : chassis_(std::move(chassis)),
      faults_(faults),
      link_(link, rng.child("link")),
      patience_s_(patience_s),
      wheel_rng_(rng.child("wheels")),
      pose_(start) {}

void WheelBody::send(const WheelSpeeds4& wheels) { link_.send(time_s_, wheels); }

double WheelBody::begin(const Command& command) {
  const auto* drive = std::get_if<DriveWheels>(&command);
  if (drive == nullptr) return time_s_;
  send(drive->wheels);
  return drive->until_s;
}

void WheelBody::run_until(double time_s) {
  const double start_s = time_s_;
  const auto steps = static_cast<std::int64_t>((time_s - start_s) / body_step_s + 1e-6);
  for (std::int64_t i = 1; i <= steps; ++i) {
    pass(body_step_s);
    time_s_ = start_s + static_cast<double>(i) * body_step_s;
  }
  if (time_s - time_s_ > 1e-6) pass(time_s - time_s_);
  time_s_ = std::max(time_s_, time_s);
}

/// The speed of one wheel in the next step, rad/s.
double WheelBody::turn_wheel(std::size_t wheel, double duration_s) {
  double target = commanded_[wheel];
  if (std::abs(target) < faults_.deadband_radps) target = 0.0;
  double& speed = followed_[wheel];
  if (faults_.stuck(wheel, time_s_)) {
    speed = 0.0;
    return 0.0;
  }
  const bool starts = std::abs(speed) < at_rest_radps && target != 0.0;
  waited_s_[wheel] = starts ? waited_s_[wheel] + duration_s : 0.0;
  if (starts && waited_s_[wheel] <= faults_.dead_time_s) {
    speed = 0.0;
    return 0.0;
  }
  const double left = faults_.lag_s > 0.0 ? std::exp(-duration_s / faults_.lag_s) : 0.0;
  speed = target + left * (speed - target);
  const double forgets = std::exp(-duration_s / faults_.noise_time_s);
  noise_[wheel] =
      forgets * noise_[wheel] + faults_.noise * std::sqrt(1.0 - forgets * forgets) * wheel_rng_.normal();
  const double sag = std::max(0.1, 1.0 - faults_.sag_per_min * moving_s_ / 60.0);
  const double gain = faults_.gains[wheel] * (speed < 0.0 ? faults_.backwards : 1.0);
  return gain * sag * (1.0 + noise_[wheel]) * speed;
}

void WheelBody::pass(double duration_s) {
  while (const auto wheels = link_.take(time_s_)) {
    commanded_ = *wheels;
    arrived_s_ = time_s_;
  }
  if (time_s_ - arrived_s_ > patience_s_) commanded_ = {};
  WheelSpeeds4 speeds{};
  for (std::size_t i = 0; i < chassis_.wheels.size(); ++i) speeds[i] = turn_wheel(i, duration_s);
  twist_ = twist_of(chassis_, speeds);
  twist_.left_mps *= 1.0 - faults_.strafe_slip;
  pose_ = moved(pose_, twist_, duration_s);
  driven_m_ += speed_of(twist_) * duration_s;
  turned_rad_ += std::abs(twist_.turn_radps) * duration_s;
  if (speed_of(twist_) + std::abs(twist_.turn_radps) > 0.0) moving_s_ += duration_s;
}

}  // namespace outrider
