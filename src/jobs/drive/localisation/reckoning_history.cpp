#include "outrider/jobs/drive/localisation/reckoning_history.hpp"

namespace outrider {
namespace {

constexpr double same_moment_s = 1e-9;  ///< times closer than this are one

}  // namespace

void ReckoningHistory::add(const Reckoning& state, double keep_s) {
  states.push_back(state);
  while (states.size() > 1 && states[1].time_s < state.time_s - keep_s) states.pop_front();
  while (!commands.empty() && commands.front().at_s < states.front().time_s - same_moment_s)
    commands.pop_front();
}

void ReckoningHistory::clear() {
  states.clear();
  commands.clear();
}

/// A state is added before the command of its time is sent. One that is added again after a late image may
/// hold commands that were sent later.
std::optional<Reckoning> ReckoningHistory::rewind(double time_s, std::vector<double>& removed_s) {
  if (states.empty() || states.front().time_s > time_s + same_moment_s) return std::nullopt;
  while (states.back().time_s > time_s + same_moment_s) {
    removed_s.insert(removed_s.begin(), states.back().time_s);
    states.pop_back();
  }
  Reckoning state = states.back();
  std::erase_if(state.sent,
                [&](const auto& command) { return command.at_s >= state.time_s - same_moment_s; });
  for (const Reckoning::Sent& command : commands) {
    if (command.at_s >= state.time_s - same_moment_s) state.sent.push_back(command);
  }
  return state;
}

}  // namespace outrider
