#include "outrider/jobs/guard/mission/mission.hpp"

#include <utility>

namespace outrider {
namespace {

bool shoots(const Command& command) {
  const auto* const drive = std::get_if<FollowWaypoints>(&command);
  return std::holds_alternative<Fire>(command) || (drive != nullptr && !drive->shots.empty());
}

}  // namespace

GuardMission::GuardMission(const GuardProblem& problem, const FiringMap& firing_map, const GuardPlan& plan)
    : board_(problem, firing_map, plan), targets_(StillTargets{&plan}) {}

GuardMission::GuardMission(const RollingPlan& plan)
    : board_(ArrivingTargets(plan).board()), targets_(ArrivingTargets(plan)) {}

GuardMission::GuardMission(const MovingPlan& plan)
    : board_(MovingTargets(plan).board()), targets_(MovingTargets(plan)) {}

void GuardMission::note(const Observation& seen) {
  std::visit([&](auto& targets) { targets.note(board_, seen); }, targets_);
}

std::optional<Command> GuardMission::propose(const Observation& seen) {
  return std::visit([&](auto& targets) { return targets.propose(board_, seen); }, targets_);
}

std::optional<Command> GuardMission::step(const Observation& seen, const Budget& budget) {
  board_.set_budget(budget);
  note(seen);
  return next(seen);
}

std::optional<Command> GuardMission::next(const Observation& seen) {
  if (auto wait = board_.give_up_silent_gun(seen)) return wait;
  if (!board_.given_up().empty()) return std::nullopt;
  if (!board_.problem().supplies.any()) return propose(seen);
  while (stores_.stranded().empty()) {
    GuardMission tried = *this;
    auto command = tried.propose(seen);
    const auto store = command ? StoreKeeper::lacking(*command, tried.board_, seen) : std::nullopt;
    // A shot that is put off was not fired.
    if (!store || !command || !shoots(*command)) *this = std::move(tried);
    if (!store) {
      if (command) stores_.note(*command);
      return command;
    }
    stores_.provide(board_, *store, seen);
  }
  return std::nullopt;
}

}  // namespace outrider
