#include "outrider/sim/simulated_robot.hpp"

#include <algorithm>
#include <utility>

#include "outrider/log/messages/conversions.hpp"

namespace outrider {
namespace {

void sense_body(TwistBody& body, Observation& seen) {
  seen.odometry = logged_pose(body.odometry());
  seen.touching = body.take_touch();
  if (seen.touching) seen.touch_rad = body.touch_rad();
}
/// Nobody counts the turns of its wheels: its odometry stays at the start.
void sense_body(const WheelBody&, Observation&) {}
void sense_body(const PieceBody& body, Observation& seen) { seen.odometry = body.pose(); }
void sense_body(const WaypointBody& body, Observation& seen) { seen.odometry = body.pose(); }
void sense_body(const NavigatedBody& body, Observation& seen) {
  seen.odometry = body.believed_pose();
  seen.gave_up = !body.why_stopped().empty();
}
void sense_body(const RigidBody& body, Observation& seen) { seen.odometry = body.pose(); }

}  // namespace

SimulatedRobot::SimulatedRobot(SimulatedBody body, SimulatedDevices devices, const Kidnapping& kidnapping,
                               const ClockFaults& clock)
    : body_(std::move(body)), devices_(std::move(devices)), kidnapping_(kidnapping), clock_(clock) {}

SimulatedRobot::SimulatedRobot(Log& log, WaypointBody body, SimulatedDevices devices)
    : body_(std::move(body)), devices_(std::move(devices)), log_(&log) {
  begin(std::get<WaypointBody>(body_));
}

SimulatedRobot::SimulatedRobot(Log& log, RigidBody body, SimulatedDevices devices)
    : body_(std::move(body)), devices_(std::move(devices)), log_(&log) {
  begin(std::get<RigidBody>(body_));
}

SimulatedRobot::SimulatedRobot(Log& log, NavigatedBody body, SimulatedDevices devices)
    : body_(std::move(body)), devices_(std::move(devices)), log_(&log) {
  begin(std::get<NavigatedBody>(body_));
}

double SimulatedRobot::time_s() const {
  return std::visit([](const auto& body) { return body.time_s(); }, body_);
}

const Pose2& SimulatedRobot::pose() const {
  return std::visit([](const auto& body) -> const Pose2& { return body.pose(); }, body_);
}

Observation SimulatedRobot::sense() {
  Observation seen;
  seen.time_s = time_s();
  std::visit([&](auto& body) { sense_body(body, seen); }, body_);
  if (devices_.laser) {
    const auto* twist = std::get_if<TwistBody>(&body_);
    seen.scan = devices_.laser->look(pose(), seen.time_s, twist != nullptr ? &twist->walk_ins() : nullptr);
  }
  if (devices_.camera) seen.image = devices_.camera->newest(seen.time_s);
  if (devices_.gun) seen.gun = devices_.gun->state();
  if (devices_.stores) seen.stores = {devices_.stores->water(), devices_.stores->charge_j()};
  if (devices_.targets) seen.targets = devices_.targets->look(seen.time_s);
  const auto flying = std::stable_partition(flights_.begin(), flights_.end(), [&](const ShotResult& shot) {
    return shot.landed_s <= seen.time_s + instant_s;
  });
  seen.shots.assign(flights_.begin(), flying);
  flights_.erase(flights_.begin(), flying);
  if (seen.scan) seen.scan->time_s += clock_.ahead_s(seen.scan->time_s);
  if (seen.image) seen.image->taken_s += clock_.ahead_s(seen.image->taken_s);
  seen.time_s += clock_.ahead_s(seen.time_s);
  return seen;
}

/// Returns the command with true times.
Command SimulatedRobot::in_true_time(Command command) const {
  const double ahead_s = clock_.ahead_s(time_s());
  if (auto* twist = std::get_if<DriveTwist>(&command)) twist->until_s -= ahead_s;
  if (auto* wheels = std::get_if<DriveWheels>(&command)) wheels->until_s -= ahead_s;
  return command;
}

void SimulatedRobot::act(const Command& given) {
  const Command command = in_true_time(given);
  if (auto* body = std::get_if<WaypointBody>(&body_)) return act_on(*body, command);
  if (auto* body = std::get_if<NavigatedBody>(&body_)) {
    act_on(*body, command);
    return;
  }
  if (auto* body = std::get_if<RigidBody>(&body_)) return act_on(*body, command);
  const double until_s = std::visit([&](auto& body) { return body.begin(command); }, body_);
  auto& camera = devices_.camera;
  while (time_s() < until_s - instant_s) {
    const bool image_due = camera && camera->due_s() <= until_s + instant_s;
    run_until(image_due ? std::min(camera->due_s(), until_s) : until_s);
    if (!image_due) continue;
    std::visit([&](const auto& body) { camera->take(body.pose(), body.twist(), body.time_s()); }, body_);
  }
}

void SimulatedRobot::run_until(double time_s) {
  std::visit([&](auto& body) { body.run_until(time_s); }, body_);
  if (kidnapped_ || this->time_s() < kidnapping_.at_s) return;
  kidnapped_ = true;
  const Pose2 elsewhere = compose(pose(), {{0.0, kidnapping_.by_m}, kidnapping_.by_rad});
  if (auto* wheels = std::get_if<WheelBody>(&body_)) wheels->put(elsewhere);
  if (auto* twist = std::get_if<TwistBody>(&body_)) twist->put(elsewhere);
}

SimulatedRobot simulated_explorer(const World& world, const Pose2& start, const RobotModel& robot,
                                  const ExplorerSimParams& params, std::uint64_t seed,
                                  std::optional<SimulatedTagCamera> camera) {
  const Rng rng(seed);
  return SimulatedRobot(
      TwistBody(world, start, robot, params.wheels, rng.child("wheels"), params.faults, rng.child("walk-ins"),
                params.footprint),
      {.laser = SimulatedLaser(world, params.laser, rng.child("laser"), params.faults, params.link),
       .camera = std::move(camera)},
      params.faults.kidnapping, params.faults.clock);
}

}  // namespace outrider
