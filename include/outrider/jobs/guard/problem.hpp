// GuardProblem: hit every target in a yard with a ballistic water gun, in the least time.
#pragma once

#include <string>
#include <vector>

#include "outrider/ballistics/shot.hpp"
#include "outrider/core/options.hpp"
#include "outrider/geometry/pose.hpp"
#include "outrider/motion/robot_model.hpp"
#include "outrider/robot/supplies.hpp"
#include "outrider/sim/faults/execution_errors.hpp"
#include "outrider/world/world.hpp"

namespace outrider {

/// A guard problem.
struct GuardProblem {
  World world;
  std::vector<Target> targets;
  Pose2 start{{0.0, -9.5}, radians(90.0)};
  RobotModel robot;
  GunModel gun;
  Air air;
  ExecutionErrors errors;
  Supplies supplies;
  bool fires_driving = true;   ///< the robot can fire while it drives
  bool targets_block = false;  ///< targets are obstacles for the robot and for shots at other targets
  std::int64_t tries = 3;      ///< number of missed shots after which a target has failed
  double give_up_s = 60.0;     ///< a target is not tried again if a hit takes longer on average; 0: never
};

/// Returns the height below which the robot needs room: of its body, or of its barrel at the steepest pitch.
/// The gun may point anywhere while the robot drives and aims, so it passes under nothing that a raised
/// barrel touches.
double room_height(const GuardProblem& problem);

/// Options of the planning.
struct GuardOptions {
  std::string planner = "best_tour";     ///< a name of the catalogue (catalog.hpp)
  double resolution_m = 0.1;             ///< grid spacing of the places where the robot may stand
  double margin_m = 0.03;                ///< least distance of a planned flight from every solid
  double pitch_step_rad = radians(2.5);  ///< spacing of the pitches that are tried
  double aim_step_m = 0.05;        ///< spacing of the aim points that are tried before a target is given up
  std::int64_t stops = 300;        ///< maximum number of stops given to the tour solver at a time
  std::int64_t refinements = 2;    ///< how often stops near the best tour are selected again, more finely
  std::int64_t iterations = 1000;  ///< iterations of each run of the tour solver
  std::int64_t memory_mib = 2048;  ///< memory limit; planning that needs more is refused
  double gap = 0.02;               ///< optimality gap at which the tour solver stops
  bool prove = false;              ///< find an optimal tour of the stops; spend more time on both bounds
  /// Shoot during drives and go on while balls fly, where that makes the mission shorter
  /// (shoot_in_passing()).
  bool shoot_on_the_move = true;
};

std::vector<Option> describe(GuardOptions& options);

}  // namespace outrider
