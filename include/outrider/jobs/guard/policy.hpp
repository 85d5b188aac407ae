// The catalogue of policies: when to plan anew while intruders keep coming, and for whom.
// src/guard/policy.cpp is the only list; command line, bench and tests walk it.
#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "outrider/core/outcome.hpp"

namespace outrider {

/// What is known between two commands.
struct ReplanState {
  std::size_t inside = 0;   ///< who can be hit and is not hit yet
  std::size_t entered = 0;  ///< of these, since the last plan
  bool idle = true;         ///< the last plan is done
  std::size_t group = 3;    ///< the option
};

struct ReplanPolicy {
  std::string_view name;
  std::string_view sentence;
  std::string_view source;
  /// How many to plan for, those who have been inside longest first; 0: keep to the plan. Not 0 when idle
  /// and somebody is inside.
  std::function<std::size_t(const ReplanState&)> take;
  bool interrupts = false;  ///< a drive ends at its next waypoint when somebody enters
  bool foresees = false;    ///< knows everybody from the start: no policy, but what one is measured by
};

const std::vector<ReplanPolicy>& replan_policies();

/// Fault: bad_input with the nearest known name.
Outcome<ReplanPolicy> find_replan_policy(std::string_view name);

}  // namespace outrider
