#include "placed_trace.hpp"

#include <algorithm>

namespace outrider {

PlacedTrace::PlacedTrace(Trace* trace) : trace_(trace) {
  if (trace == nullptr) return;
  first_expansion_ = trace->expansions.size();
  first_opening_ = trace->openings.size();
}

std::vector<std::uint32_t> PlacedTrace::renumber() const {
  std::vector<std::uint32_t*> recorded;
  for (std::size_t i = first_expansion_; i < trace_->expansions.size(); ++i) {
    recorded.push_back(&trace_->expansions[i].state);
    recorded.push_back(&trace_->expansions[i].parent);
  }
  for (std::size_t i = first_opening_; i < trace_->openings.size(); ++i)
    recorded.push_back(&trace_->openings[i].state);
  std::vector<std::uint32_t> states;
  for (const std::uint32_t* state : recorded) states.push_back(*state);
  std::ranges::sort(states);
  states.erase(std::unique(states.begin(), states.end()), states.end());
  const auto base = static_cast<std::uint32_t>(trace_->places.size());
  for (std::uint32_t* state : recorded) {
    const auto number = std::ranges::lower_bound(states, *state) - states.begin();
    *state = base + static_cast<std::uint32_t>(number);
  }
  return states;
}

}  // namespace outrider
