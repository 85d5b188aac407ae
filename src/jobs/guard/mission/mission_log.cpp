#include "outrider/jobs/guard/mission/mission_log.hpp"

#include "run/guard_log.hpp"
#include "run/regions_log.hpp"

namespace outrider {

struct GuardMissionLog::Parts {
  Parts(Log& log, const PreparedGuard& guard) : targets(log, queue, guard.scenario.problem.targets) {}

  LogQueue queue;
  TargetLog targets;
};

GuardMissionLog::GuardMissionLog(Log& log, const PreparedGuard& guard) {
  const GuardProblem& problem = guard.scenario.problem;
  log_yard(log, problem, guard.scenario.options, static_cast<std::uint64_t>(guard.scenario.seed), false);
  log_firing_map(log, guard.plan->firing_map);
  log_blocked_flights(log, problem, guard.plan->firing_map);
  log_tour(log, problem, draft_of(problem, *guard.plan->tour));
  parts_ = std::make_unique<Parts>(log, guard);
}

GuardMissionLog::~GuardMissionLog() = default;

void GuardMissionLog::note(const GuardMission& mission, double time_s) {
  parts_->targets.note(mission, time_s);
}

}  // namespace outrider
