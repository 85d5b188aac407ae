#include "outrider/sim/simulated_laser.hpp"

#include <utility>

namespace outrider {
namespace {

constexpr double instant_s = 1e-9;  // times closer than this are one

}  // namespace

void SimulatedLaser::spoil(LaserScan& scan, double time_s) {
  for (float& range : scan.ranges_m) {
    if (range >= scan.least_m && range <= scan.most_m) range += static_cast<float>(faults_.bias_m);
    if (faults_.outliers > 0.0 && fault_rng_.uniform() < faults_.outliers)
      range = static_cast<float>(fault_rng_.uniform(scan.least_m, scan.most_m));
  }
  if (time_s < faults_.frozen_from_s || frozen_.empty())
    frozen_ = scan.ranges_m;
  else
    scan.ranges_m = frozen_;
}

std::optional<LaserScan> SimulatedLaser::look(const Pose2& world_T_robot, double time_s) {
  const double turns = (time_s + instant_s) * finder_.model().rate_hz;
  if (turns >= static_cast<double>(turns_)) {
    turns_ = static_cast<std::int64_t>(turns) + 1;
    LaserScan scan = finder_.look(compose(world_T_robot, finder_.model().robot_T_laser), time_s, rng_);
    spoil(scan, time_s);
    if (!faults_.blind(time_s)) under_way_.push_back(std::move(scan));
  }
  if (under_way_.empty() || under_way_.front().time_s + faults_.latency_s > time_s + instant_s)
    return std::nullopt;
  LaserScan scan = std::move(under_way_.front());
  under_way_.pop_front();
  return scan;
}

}  // namespace outrider
