// Runs a whole mission without a file: a yard, two cats, a plan, its execution, and the report.
#include <fmt/format.h>

#include "outrider/jobs/guard/run.hpp"
#include "outrider/report/json.hpp"

using namespace outrider;

int main() {
  GuardProblem problem;
  problem.world.name = "court";
  problem.world.bounds = {{-3.0, -3.0}, {3.0, 3.0}};
  problem.world = problem.world.with({"floor", {}, HalfSpaceShape{}});
  problem.world = problem.world.with({"wall", {{0.0, 0.5, 0.5}, {}}, BoxShape{{2.0, 0.1, 0.5}}});
  problem.targets = {{"tom", {0.0, 2.0, 0.0}, {0.5, 0.2, 0.4}}, {"felix", {2.0, -1.0, 0.0}, {0.5, 0.2, 0.4}}};
  problem.start = {{-2.0, -2.0}, radians(90.0)};

  const GuardOptions options;
  const auto firing_map = build_firing_map(problem, options);
  if (!firing_map) return 1;
  const auto plan = plan_guard(problem, *firing_map, options, {});
  if (!plan) return 1;
  const auto run = run_guard(
      {.problem = problem, .firing_map = *firing_map, .plan = *plan, .options = options, .seed = 1});
  if (!run) return 1;
  const Report& report = *run;

  fmt::print("{}: {} stops\n", report.status, plan->stops.size());
  for (const ReportTarget& target : report.targets) {
    fmt::print("{}: {} after {} shots\n", target.name, target.status, target.shots);
  }
  const auto again = report_from_json(to_json(report));
  fmt::print("the report reads back: {}\n", again && to_json(*again) == to_json(report));
}

// Prints:
// done: 1 stops
// tom: reached after 1 shots
// felix: reached after 1 shots
// the report reads back: true
