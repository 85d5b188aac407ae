#include "outrider/sim/simulated_robot.hpp"

#include <utility>

namespace outrider {

SimulatedRobot::SimulatedRobot(SimulatedBody body, SimulatedDevices devices)
    : body_(std::move(body)), devices_(std::move(devices)) {}

double SimulatedRobot::time_s() const {
  return std::visit([](const auto& body) { return body.time_s(); }, body_);
}

const Pose2& SimulatedRobot::pose() const {
  return std::visit([](const auto& body) -> const Pose2& { return body.pose(); }, body_);
}

Observation SimulatedRobot::sense() {
  Observation seen;
  seen.time_s = time_s();
  if (auto* body = std::get_if<TwistBody>(&body_)) {
    seen.odometry = body->odometry();
    seen.touching = body->take_touch();
  }
  if (devices_.laser) seen.scan = devices_.laser->look(pose(), seen.time_s);
  return seen;
}

void SimulatedRobot::act(const Command& command) {
  std::visit([&](auto& body) { body.run_until(body.begin(command)); }, body_);
}

SimulatedRobot simulated_explorer(const World& world, const Pose2& start, const RobotModel& robot,
                                  const ExplorerSimParams& params, std::uint64_t seed) {
  const Rng rng(seed);
  return SimulatedRobot(TwistBody(world, start, robot, params.wheels, rng.child("wheels")),
                        {SimulatedLaser(world, params.laser, rng.child("laser"))});
}

}  // namespace outrider
