// Arrivals: intruders that enter a yard one after another.
//
// An intruder is known from the moment it enters at an entrance. It walks in a straight line to the place of
// one of the targets and stays there. It can be hit only in its place, not while it walks. After a hit it
// leaves with a given probability. Otherwise it survives and walks in a straight line to the place of another
// target, where it can be hit again.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "outrider/core/rng.hpp"
#include "outrider/jobs/guard/yard/firing_map.hpp"
#include "outrider/sim/intruders.hpp"
#include "outrider/tour/sequence.hpp"

namespace outrider {

inline constexpr std::size_t most_intruders = 1000;  ///< of a mission

/// A named place where intruders enter.
struct Entrance {
  std::string name;
  Vec2 position;
};

/// Options of arriving intruders and of the planning for them.
struct ArrivalOptions {
  std::int64_t count = 0;                 ///< maximum number of intruders; 0: limited by `until_s` only
  double until_s = 0.0;                   ///< no intruder enters later; 0: no limit
  double rate_hz = 0.1;                   ///< rate of the Poisson process
  std::string entrances;                  ///< name=x,y, separated by blanks
  std::string list;                       ///< path of a schedule (inputs.hpp) instead of the process
  double walk_mps = 1.0;                  ///< walking speed; 0: intruders reach their place at once
  double leave = 1.0;                     ///< probability that an intruder leaves after a hit
  std::string policy = "each_arrival";    ///< a name of the catalogue of policies (policy.hpp)
  std::int64_t group = 3;                 ///< number of intruders, for policies that plan for groups
  std::string objective = "time_inside";  ///< or "makespan"
  std::int64_t stops = 100;               ///< maximum number of stops given to the planner
  std::int64_t beam = 100;                ///< partial plans kept for each number of hits

  /// Returns true if intruders arrive; false if all targets are inside from the start.
  [[nodiscard]] bool any() const { return count > 0 || until_s > 0.0 || !list.empty(); }

  /// Returns true if a target that is hit may go on to another place instead of leaving.
  [[nodiscard]] bool may_survive() const { return leave < 1.0; }
};

std::vector<Option> describe(ArrivalOptions& options);

/// Returns the objective of that name. Fault: bad_input, with the two valid names.
Outcome<ArrivalObjective> find_objective(const std::string& name);

/// Checks the options. Faults: a probability of leaving that is 0 or so small that a mission would not end,
/// and fewer than two places.
Status check_survivors(const GuardProblem& problem, const ArrivalOptions& options);

/// Returns the time at which an intruder that enters at `enters_s` reaches its place.
double settling_time(const GuardProblem& problem, const ArrivalOptions& options, const Intruder& intruder);

/// Draws intruders from a Poisson process, in the order of entering. Entrances and places are uniform. The
/// result is a pure function of the arguments: intervals, entrances and places each have their own random
/// stream. Faults: no entrance, no target, or more than 1000 intruders. O(intruders).
Outcome<std::vector<Intruder>> draw_arrivals(const GuardProblem& problem,
                                             const std::vector<Entrance>& entrances,
                                             const ArrivalOptions& options, std::uint64_t seed);

/// Sorts intruders by the time of entering (stable) and names them after their places.
void put_in_order(const GuardProblem& problem, std::vector<Intruder>& intruders);

/// A guard problem with one target for each intruder, in their order, followed by the original targets, which
/// are the places.
struct ArrivalYard {
  GuardProblem problem;
  FiringMap firing_map;
  std::vector<Intruder> intruders;

  [[nodiscard]] std::size_t places() const { return problem.targets.size() - intruders.size(); }
  /// Returns the index of the target for an intruder at a place.
  [[nodiscard]] std::size_t at_place(std::size_t place) const { return intruders.size() + place; }
};

/// Returns one intruder for each target; all are in their places from the start.
std::vector<Intruder> settled_intruders(const GuardProblem& problem);

/// Makes the yard for these intruders. It reuses the firing regions of the places, so expects targets that do
/// not block: obstacles would change with the intruders inside. O(intruders * cells).
ArrivalYard arrival_yard(const GuardProblem& problem, const FiringMap& firing_map,
                         std::vector<Intruder> intruders);

}  // namespace outrider
