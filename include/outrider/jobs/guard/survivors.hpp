// Survivors: who is hit leaves with a probability, else it goes elsewhere. What will the mission take?
//
// The model: everybody is there from the start; the robot drives, aims and shoots as the tour's model says
// (tour/problem.hpp); each hit is followed by a draw whether the intruder leaves, and if not, of another
// place, uniformly, to which it walks in a straight line. The robot knows at once where it goes.
//
// A policy says when to plan anew, and with which objective. Each candidate is played in the model many times
// with the same draws, and the one with the least mean is taken: the rollout of whole policies (Chang, Givan
// and Chong, Parallel rollout, Discrete Event Dynamic Systems 14, 2004). So in the model, and up to the error
// that is stated, it is no worse than any candidate; it need not be the best of all policies.
#pragma once

#include <cstdint>
#include <string>

#include "outrider/jobs/guard/policy.hpp"
#include "outrider/jobs/guard/precomputed_stops.hpp"

namespace outrider {

struct Policy {
  ReplanPolicy replan;
  ArrivalObjective objective = ArrivalObjective::makespan;
};

/// All that can be taken: the policies that see no future, each with both objectives.
std::vector<Policy> policies();

struct ExpectedTime {
  double mean_s = 0.0;
  double error_s = 0.0;  ///< standard error of the mean
};

/// The time of the last hit, in the model, for a policy: the mean over `missions` of them. Of the options,
/// leave, walk, group and beam count. A pure function of the arguments, for any number of threads. Once
/// `stop` is raised no more missions begin, and the answer is of no use.
ExpectedTime expected_time(const GuardProblem& problem, const PrecomputedStops& precomputed,
                           const ArrivalOptions& options, const Policy& policy, std::size_t missions,
                           const std::stop_token& stop = {});

/// The policy with the least mean, and its expected time by draws of its own: the least of several means is
/// below the mean of what was chosen.
struct BestPolicy {
  Policy policy;
  ExpectedTime time;
};
BestPolicy best_policy(const GuardProblem& problem, const PrecomputedStops& precomputed,
                       const ArrivalOptions& options, std::size_t missions, const std::stop_token& stop = {});

/// Refused: a probability of 0 or too small to end, and nowhere else to go.
Status check_survivors(const GuardProblem& problem, const ArrivalOptions& options);

}  // namespace outrider
