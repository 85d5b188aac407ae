// Runs a whole mission without a file: a yard, two cats, a plan, its execution, the report and the log.
#include <fmt/format.h>

#include "outrider/jobs/guard/run/run.hpp"
#include "outrider/log/messages/gun_messages.hpp"
#include "outrider/log/topics.hpp"

using namespace outrider;

int main() {
  GuardScenario scenario;
  GuardProblem& problem = scenario.problem;
  problem.world.name = "court";
  problem.world.bounds = {{-3.0, -3.0}, {3.0, 3.0}};
  problem.world = problem.world.with({"floor", {}, HalfSpaceShape{}});
  problem.world = problem.world.with({"wall", {{0.0, 0.5, 0.5}, {}}, BoxShape{{2.0, 0.1, 0.5}}});
  problem.targets = {{"tom", {0.0, 2.0, 0.0}, {0.5, 0.2, 0.4}}, {"felix", {2.0, -1.0, 0.0}, {0.5, 0.2, 0.4}}};
  problem.start = {{-2.0, -2.0}, radians(90.0)};

  const auto guard = prepare_guard(std::move(scenario));
  if (!guard) return 1;
  Log log;
  const auto run = run_guard({**guard}, log);
  if (!run) return 1;

  fmt::print("{}: {} stops\n", run->status, (*guard)->plan->tour->stops.size());
  for (const auto& row : table_named(*run, "targets").rows) {
    fmt::print("{}: {} after {} shots\n", std::get<std::string>(row[0]), std::get<std::string>(row[1]),
               std::get<double>(row[3]));
  }
  for (const auto& [time_ns, shot] : log.messages<outrider_msgs::Shot>(topic::shots)) {
    fmt::print("{:.1f} s: a shot at {}, which {}\n", seconds(time_ns), shot.target,
               shot.hit ? "hits" : "misses");
  }
}

// Prints:
// done: 1 stops
// tom: reached after 1 shots
// felix: reached after 1 shots
// 0.8 s: a shot at felix, which hits
// 1.7 s: a shot at tom, which hits
