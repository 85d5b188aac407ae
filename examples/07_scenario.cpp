// Reads the mission of a scenario file, changes options by name, and loads the files it names.
#include <fmt/format.h>

#include "outrider/io/scenario/scenario.hpp"
#include "outrider/job/run_job.hpp"
#include "outrider/jobs/guard/job.hpp"

using namespace outrider;

int main() {
  GuardJob job;
  if (const auto read = read_scenario(job, "scenarios/yard/yard.yaml"); !read) {
    fmt::print("{}\n", to_string(read.error()));
    return 1;
  }
  if (!change(job, {{"robot.radius", "0.3"}})) return 1;
  if (const auto refused = change(job, {{"robot.radius", "-1"}}); !refused)
    fmt::print("{}\n", to_string(refused.error()));
  if (const auto typo = change(job, {{"robot.raduis", "0.3"}}); !typo)
    fmt::print("{}\n", to_string(typo.error()));
  const auto warnings = job.load();
  if (!warnings) return 1;
  const GuardProblem& problem = job.scenario.problem;
  fmt::print("{} targets in {}, a robot of {} m, {} warnings\n", problem.targets.size(), problem.world.name,
             problem.robot.radius_m, warnings->size());
}

// Prints:
// robot.radius: '-1' is not valid; expected a number from 0 to 100 m
// robot.raduis: there is no option 'robot.raduis'; did you mean 'robot.radius'?
// 24 targets in yard, a robot of 0.3 m, 0 warnings
