// explore_on_grid(): a quick simulation of an exploration on a grid, for the comparison of strategies.
//
// The robot knows its pose, its laser has no noise, and it drives straight along its path at full speed and
// turns on the spot. It decides by the same decide() as the mission, each half metre and when its goal is
// seen. So a run takes half a second instead of minutes, and what is compared is the choice of views alone. A
// pure function of its arguments but for max_decision_s.
#pragma once

#include <functional>
#include <vector>

#include "outrider/jobs/explore/choose/decide.hpp"
#include "outrider/motion/robot_model.hpp"
#include "outrider/world/grid.hpp"

namespace outrider::bench {

/// The exploration to simulate.
struct GridExploration {
  const Grid<std::uint8_t>& solid;  ///< cells other than 0 are solid, and so is everything outside
  Vec2 start;
  double range_m = 3.5;
  RobotModel robot;
  ExploreOptions options;
};

/// The result of an exploration.
struct GridExplorationRun {
  bool complete = false;  ///< it knows 99.5 % of the cells on which it can stand, and is home
  double driven_m = 0.0;
  double time_s = 0.0;  ///< of driving and turning
  int decisions = 0;
  double max_decision_s = 0.0;  ///< by the clock given, 0 without one
  std::vector<Vec2> track;
};

Outcome<GridExplorationRun> explore_on_grid(const GridExploration& asked,
                                            const std::function<double()>& processor_s = nullptr);

}  // namespace outrider::bench
