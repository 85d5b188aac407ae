// The catalogue of replanning policies: when to make a new plan while intruders keep coming, and for whom.
// src/jobs/guard/behaviour/policy.cpp is the only list of them; the command line tool, benchmarks and tests
// read it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "outrider/core/outcome.hpp"

namespace outrider {

/// The input of a policy, between two commands.
struct ReplanState {
  std::size_t inside = 0;   ///< intruders inside that can be hit and are not hit yet
  std::size_t entered = 0;  ///< how many of them entered since the last plan
  bool idle = true;         ///< the last plan is completed
  std::size_t group = 3;    ///< ArrivalOptions::group
};

/// A replanning policy.
struct ReplanPolicy {
  std::string_view name;
  std::string_view sentence;  ///< one sentence that says what the policy does
  std::string_view source;    ///< source of the method
  /// Returns for how many intruders to plan now; those that have been inside longest come first. 0 keeps the
  /// present plan. Must not return 0 if the robot is idle and an intruder is inside.
  std::function<std::size_t(const ReplanState&)> take;
  bool interrupts = false;  ///< a drive ends at its next waypoint when an intruder enters
  bool foresees = false;    ///< knows all intruders from the start; only a reference for comparison
};

/// Returns all policies.
const std::vector<ReplanPolicy>& replan_policies();

/// Returns the policy of that name. Fault: bad_input, with the nearest known name.
Outcome<ReplanPolicy> find_replan_policy(std::string_view name);

}  // namespace outrider
