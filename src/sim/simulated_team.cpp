#include "outrider/sim/simulated_team.hpp"

#include <algorithm>
#include <utility>

namespace outrider {

SimulatedTeam::SimulatedTeam(std::vector<Cell> robots, std::vector<Cell> target, int known_s)
    : robots_(std::move(robots)), target_(std::move(target)), known_s_(known_s) {}

Observation SimulatedTeam::sense() {
  const std::size_t known =
      std::min(target_.size(), static_cast<std::size_t>(time_s_) + static_cast<std::size_t>(known_s_) + 1);
  const auto first = target_.begin() + static_cast<std::ptrdiff_t>(std::exchange(told_, known));
  Observation seen;
  seen.time_s = time_s_;
  seen.grid = GridObservation{robots_, {first, target_.begin() + static_cast<std::ptrdiff_t>(known)}};
  return seen;
}

void SimulatedTeam::act(const Command& command) {
  const auto* step = std::get_if<StepToCell>(&command);
  if (step == nullptr) return;
  robots_[step->robot] = step->cell;
  ++time_s_;
}

}  // namespace outrider
