// GuardSimNode: a simulated robot with a gun behind topics, in a yard with targets that leave when they are
// hit.
//
//   gun/command  sensor_msgs/JointState   ->   joint_states  sensor_msgs/JointState: yaw and pitch of the gun
//   gun/fire     std_msgs/Float64              gun/hit       std_msgs/String: who was hit, as somebody in the
//                                                            yard sees it; three times, since messages get
//                                                            lost
//
// and what every RobotSimNode sends, with map -> odom without errors. A differential drive
// (sim/bodies/twist_body.hpp) carries the gun of the job guard (sim/simulated_gun.hpp): its joints turn at
// their rates, and each ball leaves with the errors of the scenario and flies to its first contact. Where a
// drive ends is what comes of the commands, so the error of position of the scenario has no part in it. The
// topics do not say at whom a ball is shot: it hits whom it touches first. Same scenario, options, messages
// and times: same outputs.
#pragma once

#include <deque>
#include <memory>
#include <string>
#include <vector>

#include "outrider/jobs/guard/scenario.hpp"
#include "outrider/jobs/guard/yard/firing_map.hpp"
#include "outrider/log/messages/ros_sensor_messages.hpp"
#include "outrider/nodes/messages/node_messages.hpp"
#include "outrider/nodes/sim/robot_sim_node.hpp"

namespace outrider {

/// The yard in which the robot is simulated.
struct GuardSimYard {
  GuardProblem problem;
  FiringMap firing_map;
  ExplorerWheels wheels;
  GuardSimParams faults;

  /// Makes the yard of a scenario that load_problem() has read. Faults: bad_input for terrain; those of
  /// build_firing_map().
  static Outcome<std::shared_ptr<const GuardSimYard>> make(const GuardScenario& scenario);
};

class GuardSimNode final : public RobotSimNode {
 public:
  GuardSimNode(std::shared_ptr<const GuardSimYard> yard, const RobotSimOptions& options);

  [[nodiscard]] int shots() const { return shots_; }
  /// Returns the number of targets that were hit.
  [[nodiscard]] std::size_t hits() const;
  [[nodiscard]] const std::vector<bool>& gone() const { return gone_; }

 private:
  /// Somebody was hit, and it is told at that time of the simulation.
  struct Hit {
    double time_s = 0.0;
    std::string name;
  };

  Command drive(const Twist2& twist, double until_s) override;
  Whereabouts whereabouts(const Observation& seen) override;
  [[nodiscard]] geometry_msgs::TransformStamped mount(double time_s) const override;
  void send_measured(const Observation& seen, double time_s) override;
  void report() override;
  Status take_aim(const sensor_msgs::JointState& message);
  Status take_fire(const std_msgs::Float64& speed);
  void fire(double speed_mps);

  std::shared_ptr<const GuardSimYard> yard_;
  FaultyLink<GunState> aims_;
  FaultyLink<double> fires_;
  SimulatedGun gun_;
  Rng gun_rng_;
  GunState from_, to_;  ///< of the newest command to the joints
  double began_aim_s_ = 0.0;
  std::vector<bool> gone_;  ///< by target
  std::deque<Hit> told_;    ///< not told yet, in the order of time
  int shots_ = 0;
  std::int64_t contacts_ = 0;
  std::size_t joint_output_, hit_output_;
};

}  // namespace outrider
