// The catalogue of replanning policies: when to make a new plan while intruders keep coming, and for whom.
// src/jobs/guard/behaviour/policy.cpp is the only list of them; the command line tool, benchmarks and tests
// read it.
//
// expected_time() estimates how long a mission under a policy takes against survivors, intruders that may
// survive a hit. The model: all intruders are inside from the start. The robot drives, aims and shoots as in
// the tour model (tour/problem.hpp). After a hit the intruder leaves with a given probability; otherwise it
// walks in a straight line to another place, drawn uniformly. The robot knows at once where it goes.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "outrider/core/outcome.hpp"
#include "outrider/jobs/guard/plan/stop_table.hpp"

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

/// An estimate of the mission time.
struct ExpectedTime {
  double mean_s = 0.0;
  double error_s = 0.0;  ///< standard error of the mean
};

/// Estimates the time of the last hit under a policy whose plans make the makespan least, as the mean over
/// `missions` simulated missions. Of the options, only leave, walk_mps, group and beam are used. The result
/// is a pure function of the arguments for any number of threads. After a stop request no more missions
/// begin, and the result is meaningless.
ExpectedTime expected_time(const GuardProblem& problem, const PrecomputedStops& precomputed,
                           const ArrivalOptions& options, const ReplanPolicy& policy, std::size_t missions,
                           const std::stop_token& stop = {});

inline constexpr std::size_t survivor_missions = 40;  ///< simulated before a mission

/// Returns the options with which missions against survivors are simulated and planned: a beam of at most 4.
ArrivalOptions survivor_options(ArrivalOptions options);

/// Checks the options. Faults: a probability of leaving that is 0 or so small that a mission would not end,
/// and fewer than two places.
Status check_survivors(const GuardProblem& problem, const ArrivalOptions& options);

}  // namespace outrider
