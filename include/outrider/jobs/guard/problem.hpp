// The guard problem: hit every target in a yard with a ballistic water gun, soonest.
#pragma once

#include <string>
#include <vector>

#include "outrider/ballistics/shot.hpp"
#include "outrider/core/options.hpp"
#include "outrider/geometry/pose.hpp"
#include "outrider/motion/robot_model.hpp"
#include "outrider/robot/supplies.hpp"
#include "outrider/sim/execution_errors.hpp"
#include "outrider/world/world.hpp"

namespace outrider {

struct GuardProblem {
  World world;
  std::vector<Target> targets;
  Pose2 start{{0.0, -9.5}, radians(90.0)};
  RobotModel robot;
  GunModel gun;
  Air air;
  ExecutionErrors errors;
  Supplies supplies;
  bool targets_block = false;  ///< targets stop the robot and the shots at other targets
  std::int64_t tries = 3;      ///< shots at a target before it has failed
};

struct GuardOptions {
  std::string planner = "best_tour";     ///< a name of the catalogue (catalog.hpp)
  double resolution_m = 0.1;             ///< of the places where the robot may stand
  double margin_m = 0.03;                ///< from a planned flight to every solid
  double pitch_step_rad = radians(2.5);  ///< of the pitches tried
  double aim_step_m = 0.05;              ///< of the aim points tried before a target is given up
  std::int64_t stops = 300;              ///< places handed to the tour solver at a time
  std::int64_t refinements = 2;          ///< times that places near the best tour are looked at closer
  std::int64_t iterations = 1000;        ///< of the tour solver, each time
  std::int64_t group = 4;                ///< targets in a group of shrinking_circles
  std::int64_t memory_mib = 2048;        ///< planning that would need more is refused
  double gap = 0.02;                     ///< part of the tour's time that its lower bound may leave open
  bool prove = false;                    ///< find the best tour of the stops; spend more on both bounds
  bool shoot_on_the_move = false;  ///< hit from the way what makes the mission shorter (passing_plan.hpp)
};

std::vector<Option> describe(GuardOptions& options);

}  // namespace outrider
