// A whole pursuit: plan, go, see more of the target, plan again, until the catch or the target's last second.
//
// On the virtual clock planning is free. On the wall clock each planning call costs what it takes
// (pursuit_mission.hpp); the robot goes on along the best way known meanwhile. The anytime search works in
// calls of `call_s`; a call that brings no proof is continued from a place further along the way, twice as
// far ahead each time. Other planners are asked once, from far enough ahead that their answer is not late.
//
// With `known_s` seconds of the future known, the rest is believed to be as the forecast says; when a
// second that is revealed differs from what was believed, there is a new forecast and a new plan. A target
// believed to be out of reach for good is believed to stay instead. The length of the trajectory is known.
//
// Thread rule: no shared state. The library reads no clock: time comes from the StopWatch.
#pragma once

#include <functional>
#include <limits>
#include <optional>
#include <vector>

#include "outrider/core/budget.hpp"
#include "outrider/jobs/pursue/mission.hpp"
#include "outrider/jobs/pursue/target_forecast.hpp"

namespace outrider {

enum class PursuitClock { free_planning, wall };

/// The port to a clock.
class StopWatch {
 public:
  virtual ~StopWatch() = default;
  /// Seconds since the last call, or since it was made.
  virtual double lap_s() = 0;

 protected:
  StopWatch() = default;
  StopWatch(const StopWatch&) = default;
  StopWatch& operator=(const StopWatch&) = default;
};

using PursuitAsk = std::function<Outcome<PursuitPlan>(const PursuitProblem&, const Budget&)>;

struct PursuitRules {
  PursuitClock clock = PursuitClock::free_planning;
  int known_s = std::numeric_limits<int>::max();  ///< seconds of the target's future that are known
  TargetForecast forecast;                        ///< of the rest; the first of the catalogue unless set
  PursuitAsk ask;                                 ///< a planner; empty: the anytime search
  double call_s = 1.5;                            ///< of a call of the anytime search on the wall clock
  Budget budget;                                  ///< of each call, beside `call_s`
};

/// What was known at one moment of planning.
struct PursuitMoment {
  int time_s = 0;                     ///< of the mission
  double planning_s = 0.0;            ///< spent on planning until then
  std::uint64_t expansions = 0;       ///< by all calls until then; repeats exactly
  std::optional<std::uint64_t> cost;  ///< of the whole mission by the best catch known
  std::uint64_t lower_bound = 0;      ///< proven for the whole mission; 0 where the future is not known
};

struct PursuitRun {
  PursuitMission mission;
  std::vector<PursuitMoment> moments;
  std::uint64_t lower_bound = 0;   ///< proven for the whole mission; 0 where the future is not known
  int earliest_catch_s = -1;       ///< the first second in which a catch is possible; -1: not known
  double first_feasible_s = -1.0;  ///< of planning, until the first catch was known; -1: never
  double planning_s = 0.0;         ///< in all
  int calls = 0;                   ///< of the planner
  std::uint64_t expansions = 0;    ///< over all calls
};

/// Runs the mission. Faults: those of check(problem) for any robot; no_path when it is proven at the start
/// that no robot can ever catch the target; those of the planner in its first call. A mission that ends
/// without a catch is no fault. `look` is shown the run so far, whenever a second has passed or planning
/// knows more; nothing of it changes what happens.
Outcome<PursuitRun> pursue(const PursuitProblem& truth, const std::vector<Cell>& robots,
                           const PursuitRules& rules, StopWatch& watch,
                           const std::function<void(const PursuitRun&)>& look = {});

/// Cells for a team: the first as given, each next one the free cell farthest in king's moves, as if there
/// were no walls, from all before it; the lowest row and then column among equals. O(cells count).
std::vector<Cell> place_team(const PursuitProblem& problem, std::size_t count);

}  // namespace outrider
