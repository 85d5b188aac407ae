// PursuitMission: plan, go, see more of the target, plan again, until the catch or the target's last second.
//
// On the virtual clock planning is free. On the wall clock each planning call costs what it takes
// (jobs/pursue/state.hpp); the robot goes on along the best way known meanwhile. The anytime search works in
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
#include "outrider/jobs/pursue/state.hpp"
#include "outrider/jobs/pursue/target_belief.hpp"
#include "outrider/pursuit/anytime.hpp"
#include "outrider/robot/mission.hpp"

namespace outrider {

enum class PursuitClock { free_planning, wall };

/// The port to a clock.
class StopWatch {
 public:
  virtual ~StopWatch() = default;
  /// Seconds since the last call, or since it was made.
  virtual double lap_s() = 0;
  /// What has passed since then is in no lap.
  virtual void restart() = 0;

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
  PursuitState state;
  std::vector<PursuitMoment> moments;
  std::uint64_t lower_bound = 0;   ///< proven for the whole mission; 0 where the future is not known
  int earliest_catch_s = -1;       ///< the first second in which a catch is possible; -1: not known
  double first_feasible_s = -1.0;  ///< of planning, until the first catch was known; -1: never
  double planning_s = 0.0;         ///< in all
  int calls = 0;                   ///< of the planner
  std::uint64_t expansions = 0;    ///< over all calls
};

class PursuitMission {
 public:
  /// The target's path has so many seconds, second 0 included; that of `map` is not looked at. `look` is
  /// shown the run so far whenever planning knows more; what it takes is not charged. References must outlive
  /// the mission.
  PursuitMission(const PursuitProblem& map, std::size_t seconds, const PursuitRules& rules, StopWatch& watch,
                 std::function<void(const PursuitRun&)> look = {});

  /// The next StepToCell, or nothing when it is over: caught, the target gone, or no catch possible any more.
  /// It takes a GridObservation each second.
  std::optional<Command> step(const Observation& seen);

  PursuitRun run;
  std::optional<Fault> fault;  ///< of the planner in its first call, which ends the mission

 private:
  /// The work on one question.
  struct Session {
    std::size_t robot = 0;
    PursuitProblem problem;
    std::optional<AnytimePursuit> search;  ///< none for other planners
    std::optional<PursuitPlan> answer;
    std::optional<Fault> fault;
    bool done = false;  ///< nothing more will come
    std::uint64_t lower_bound = 0;
    int earliest_catch_s = -1;
  };

  void take_in(const GridObservation& grid);
  [[nodiscard]] bool is_over() const;
  bool plan();
  [[nodiscard]] Command go() const;
  void show();
  void open_sessions();
  [[nodiscard]] bool all_failed() const;
  double call();
  void work_on(Session& session);
  void ask_for(Session& session);
  void search_in(Session& session);
  void keep_bounds();
  void note_answer(const Session& session);
  void note();
  bool first_answer();
  void splice_answers();
  void settle();

  const PursuitRules& rules_;
  StopWatch& watch_;
  std::function<void(const PursuitRun&)> look_;
  std::size_t seconds_;
  std::vector<Cell> target_;  ///< as far as it is known
  TargetBelief belief_;
  std::vector<Session> sessions_;
  int lead_s_ = 0;
  bool settled_ = false;     ///< nothing is left to think about
  int thinking_s_ = 0;       ///< seconds that the present call still costs before its answer comes
  bool called_ = false;      ///< the last second of a call is passing
  double planning_s_ = 0.0;  ///< of the newest call
  bool taken_ = false;       ///< its answer was taken up
};

}  // namespace outrider
