// Drives of a simulated robot to a goal by the navigator, which several suites measure.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "outrider/navigate/navigator.hpp"
#include "outrider/sim/simulated_robot.hpp"

namespace outrider::bench {

/// Returns the Clearpath Jackal of the BARN Challenge with a rule of motion.
NavigatorSetup jackal(const std::string& rule);
/// Returns its laser of 270 degrees at 40 Hz and its wheels, with their errors.
ExplorerSimParams jackal_devices(const NavigatorSetup& setup);

/// A drive to a goal.
struct GoalDrive {
  const World& world;
  Pose2 start;
  Vec2 goal;
  const NavigatorSetup& setup;
  const ExplorerSimParams& devices;
  double aimed_m = 0.1;         ///< from the goal by the robot's belief, where it has arrived
  double reached_m = 0.2;       ///< from the goal by its true place, where it is done
  double limit_s = 100.0;       ///< after which it ends
  double set_off_m = 0.1;       ///< way that the robot has driven when the time begins to count
  bool start_unknown = false;   ///< the robot is not told where on its map it starts
  bool ends_when_near = false;  ///< it is done as soon as it is truly near; else when it says so
};

/// The result of a drive. A contact of the robot's own motion ends it.
struct GoalRun {
  bool done = false;
  bool touched = false;
  bool claims = false;   ///< it said that it had arrived
  bool lost = false;     ///< it gave up because it did not know where it was
  std::string why = {};  ///< its reason if it gave up
  std::int64_t walked_into = 0;
  double time_s = 0.0;
  double driven_m = 0.0;
  double located_m = 0.0;  ///< way driven until it knew where it was; negative: it never did
};

GoalRun run(const GoalDrive& drive, std::uint64_t seed);

/// Returns a fault if a rule of motion is not known. It names the flag --rules.
Status check_rules(const std::vector<std::string>& rules);

}  // namespace outrider::bench
