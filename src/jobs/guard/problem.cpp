#include "outrider/jobs/guard/problem.hpp"

#include <algorithm>

#include "outrider/jobs/guard/catalog.hpp"

namespace outrider {

double room_height(const GuardProblem& problem) {
  return std::max(problem.robot.height_m, barrel_top(problem.gun));
}

std::vector<Option> describe(GuardOptions& options) {
  return {
      choice_option("planner", "how the mission is planned; a name of 'outrider list'", &options.planner,
                    names_of(guard_planners())),
      {"resolution", "m", 0.005, 10.0, "spacing of the places where the robot may stand",
       &options.resolution_m},
      {"margin", "m", 0.0, 1.0, "clearance that a planned flight keeps from every solid", &options.margin_m},
      {"pitch_step", "deg", 0.35, 45.0, "spacing of the pitches tried", &options.pitch_step_rad},
      {"aim_step", "m", 0.005, 10.0, "spacing of the points on a target that are tried before it is given up",
       &options.aim_step_m},
      {"stops", "", 1, 2000, "places handed to the tour solver at a time", &options.stops},
      {"refinements", "", 0, 20, "times that the places near the best tour are looked at closer",
       &options.refinements},
      {"iterations", "", 0, 1e7, "iterations of the tour solver each time", &options.iterations},
      {"memory_cap", "MiB", 1, 1e6, "planning that would need more memory is refused", &options.memory_mib},
      {"gap", "", 0, 1, "part of the tour's time that its lower bound may leave open; 1: no such bound",
       &options.gap},
      {"prove", "", 0, 0,
       "prove the best tour of the stops; take minutes and half of the memory for the bounds",
       &options.prove},
      {"shoot_on_the_move", "", 0, 0,
       "shoot while driving and go on while balls fly; false: from rest, with proven bounds of the tour",
       &options.shoot_on_the_move},
  };
}

}  // namespace outrider
