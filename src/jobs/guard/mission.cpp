#include "outrider/jobs/guard/mission.hpp"

#include <utility>

namespace outrider {
namespace {

bool shoots(const Command& command) {
  const auto* const drive = std::get_if<FollowWaypoints>(&command);
  return std::holds_alternative<Fire>(command) || (drive != nullptr && !drive->shots.empty());
}

}  // namespace

GuardMission::GuardMission(const GuardProblem& problem, const FiringMap& firing_map, const GuardPlan& plan)
    : tasks(tasks_of(problem, plan)), problem_(&problem), firing_map_(&firing_map), tour_(&plan) {}

GuardMission::GuardMission(const ArrivalPlan& plan)
    : tasks(tasks_of(plan)),
      problem_(&plan.yard.problem),
      firing_map_(&plan.yard.firing_map),
      arrivals_(&plan) {}

GuardMission::GuardMission(const MovingPlan& plan)
    : moving(begin_moving(plan)), problem_(&plan.problem), firing_map_(&plan.firing_map), walkers_(&plan) {
  tasks.records.resize(plan.problem.targets.size());
}

void GuardMission::note(const Observation& seen) {
  if (walkers_ != nullptr) {
    note_moving(moving, tasks, seen, *walkers_);
    return;
  }
  note_shots(tasks, seen, *problem_, *firing_map_);
  if (arrivals_ != nullptr) note_arrivals(arriving, tasks, seen, *arrivals_);
}

std::optional<Command> GuardMission::propose(const Observation& seen) {
  if (walkers_ != nullptr) return next_command(moving, tasks, seen, *walkers_);
  if (arrivals_ != nullptr) return next_command(arriving, tasks, seen, *arrivals_);
  return next_command(tasks, seen, *problem_, *firing_map_);
}

std::optional<Command> GuardMission::step(const Observation& seen, const Budget& budget) {
  note(seen);
  tasks.budget = budget;
  if (auto wait = give_up_silent_gun(tasks, seen)) return wait;
  if (!tasks.given_up.empty()) return std::nullopt;
  if (!problem_->supplies.any()) return propose(seen);
  while (!stores.stranded) {
    GuardMission tried = *this;
    auto command = tried.propose(seen);
    const auto store = command ? lacking(*command, tried.tasks, seen, *problem_, *firing_map_) : std::nullopt;
    // A shot that is put off was not fired.
    if (!store || !command || !shoots(*command)) *this = std::move(tried);
    if (!store) {
      if (command) note_command(stores, *command);
      return command;
    }
    provide(stores, tasks, *store, seen, *problem_, *firing_map_);
  }
  return std::nullopt;
}

}  // namespace outrider
