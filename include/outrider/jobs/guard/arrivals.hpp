// Arrivals: intruders that enter a yard one after another.
//
// An intruder enters at an entrance, walks in a straight line to the place of one of the targets, stays
// there, and is hit there; on its way it cannot be. It is known from the moment it enters. Once hit it
// leaves, with a probability; else it survives: it walks straight to the place of another target, and is hit
// there.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "outrider/core/rng.hpp"
#include "outrider/jobs/guard/firing_map.hpp"
#include "outrider/sim/intruders.hpp"

namespace outrider {

/// A named place where intruders come in.
struct Entrance {
  std::string name;
  Vec2 position;
};

/// What is made least: the sum over the intruders of their time inside, or the time of the last hit.
enum class ArrivalObjective { time_inside, makespan };

struct ArrivalOptions {
  std::int64_t count = 0;  ///< intruders, at most; 0: as many as come until `until_s`
  double until_s = 0.0;    ///< nobody enters later; 0: no such time
  double rate_hz = 0.1;    ///< of the Poisson process
  std::string entrances;   ///< name=x,y, with blanks between
  std::string list;        ///< path of a schedule (io/arrivals.hpp) instead of the process
  double walk_mps = 1.0;   ///< from the entrance to the place; 0: they are there at once
  double leave = 1.0;      ///< probability that one who is hit leaves
  std::string policy = "each_arrival";
  std::int64_t group = 3;
  std::string objective = "time_inside";
  std::int64_t stops = 100;  ///< places handed to the planner
  std::int64_t beam = 100;   ///< partial plans kept for each number of hits

  /// False for the still yard.
  [[nodiscard]] bool any() const { return count > 0 || until_s > 0.0 || !list.empty(); }
};

std::vector<Option> describe(ArrivalOptions& options);

/// Fault: bad_input with the two names.
Outcome<ArrivalObjective> find_objective(const std::string& name);

/// When an intruder that enters at `enters_s` is in its place.
double settling_time(const GuardProblem& problem, const ArrivalOptions& options, const Intruder& intruder);

/// Intruders of a Poisson process in the order of entering; entrances and places are drawn uniformly.
/// The answer is a pure function of the arguments: the gaps, the entrances and the places come from
/// streams of their own. Refused: no entrance, no target, more than 1000 intruders. O(intruders).
Outcome<std::vector<Intruder>> draw_arrivals(const GuardProblem& problem,
                                             const std::vector<Entrance>& entrances,
                                             const ArrivalOptions& options, std::uint64_t seed);

/// Puts intruders in the order of entering (ties as given) and names them after their places.
void put_in_order(const GuardProblem& problem, std::vector<Intruder>& intruders);

/// The yard with one target for each intruder, in their order, and behind them its own targets, the places.
struct ArrivalYard {
  GuardProblem problem;
  FiringMap firing_map;
  std::vector<Intruder> intruders;

  [[nodiscard]] std::size_t places() const { return problem.targets.size() - intruders.size(); }
  /// The index of the target for somebody at a place.
  [[nodiscard]] std::size_t at_place(std::size_t place) const { return intruders.size() + place; }
};

/// One intruder at each target, from the start.
std::vector<Intruder> settled_intruders(const GuardProblem& problem);

/// Refused when targets block: who is inside changes, and with it what stands in the way. The regions
/// are those of the places: nothing is surveyed again. O(intruders x cells).
Outcome<ArrivalYard> arrival_yard(const GuardProblem& problem, const FiringMap& firing_map,
                                  std::vector<Intruder> intruders);

}  // namespace outrider
