#include "outrider/sim/simulated_laser.hpp"

namespace outrider {

std::optional<LaserScan> SimulatedLaser::look(const Pose2& world_T_robot, double time_s) {
  constexpr double instant_s = 1e-9;  // times closer than this are one
  const double turns = (time_s + instant_s) * finder_.model().rate_hz;
  if (turns < static_cast<double>(turns_)) return std::nullopt;
  turns_ = static_cast<std::int64_t>(turns) + 1;
  return finder_.look(compose(world_T_robot, finder_.model().robot_T_laser), time_s, rng_);
}

}  // namespace outrider
