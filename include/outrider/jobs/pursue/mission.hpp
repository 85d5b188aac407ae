// PursuitMission: plans, moves, observes the target and plans again, until the catch or the target's last
// second.
//
// On the virtual clock planning is free. On the wall clock each planning call costs the time that it takes
// (jobs/pursue/state.hpp); the robot follows the best known path meanwhile. The anytime search works in calls
// of `call_s`, and keeps what it knows from call to call as long as the robot follows its best path. If an
// answer came too late, or with several robots, it begins again from a place further along the path, twice as
// far ahead each time. Other planners are called once, far enough ahead that their answer is in time.
//
// If only `known_s` seconds of the future are known, the forecast predicts the rest. A second that differs
// from the prediction causes a new forecast and a new plan. A target that the robot can never reach by the
// forecast is predicted to stay where it is. The length of the target's path is always known. If the robot is
// not in the cell to which it was sent, everything is planned anew from where it is. A cell that it could not
// enter is planned around until no catch is possible without it.
//
// Robots that feel whether they have caught the target go by that. Otherwise the target counts as caught
// where its known path says so. If they feel nothing where it should be, its path is no longer certain.
//
// Thread rule: no shared state. The library reads no clock: time comes from the StopWatch.
#pragma once

#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <vector>

#include "outrider/core/budget.hpp"
#include "outrider/jobs/pursue/state.hpp"
#include "outrider/jobs/pursue/target_belief.hpp"
#include "outrider/pursuit/anytime.hpp"
#include "outrider/robot/mission.hpp"
#include "outrider/sim/simulated_team.hpp"

namespace outrider {

/// The time that planning takes in the mission: none, or its wall time.
enum class PursuitClock { free_planning, wall };

/// Interface to a clock.
class StopWatch {
 public:
  virtual ~StopWatch() = default;
  /// Returns the seconds since the last call, or since construction.
  virtual double lap_s() = 0;
  /// Starts a new lap. The time since the last call belongs to no lap.
  virtual void restart() = 0;

 protected:
  StopWatch() = default;
  StopWatch(const StopWatch&) = default;
  StopWatch& operator=(const StopWatch&) = default;
};

/// A planner.
using PursuitAsk = std::function<Outcome<PursuitPlan>(const PursuitProblem&, const Budget&)>;

/// Options of the mission.
struct PursuitRules {
  PursuitClock clock = PursuitClock::free_planning;  ///< time that planning takes in the mission
  int known_s = std::numeric_limits<int>::max();     ///< seconds of the target's future that are known
  TargetForecast forecast;  ///< predicts the rest; the first of the catalogue unless set
  PursuitAsk ask;           ///< the planner; empty: the anytime search
  double call_s = 1.5;      ///< duration of a call of the anytime search on the wall clock
  Budget budget;            ///< limit of each call, in addition to `call_s`
};

/// The state of knowledge at one moment of planning.
struct PursuitMoment {
  int time_s = 0;                     ///< mission time
  double planning_s = 0.0;            ///< planning time until this moment
  std::uint64_t expansions = 0;       ///< of all calls until this moment; repeats exactly
  std::optional<std::uint64_t> cost;  ///< of the whole mission by the best known catch
  std::uint64_t lower_bound = 0;      ///< proven for the whole mission; 0 where the future is not known
};

/// A pursuit and its planning.
struct PursuitRun {
  PursuitState state;                  ///< current state
  std::vector<PursuitMoment> moments;  ///< in the order of time
  std::uint64_t lower_bound = 0;       ///< proven for the whole mission; 0 where the future is not known
  int earliest_catch_s = -1;           ///< first second in which a catch is possible; -1: unknown
  double first_feasible_s = -1.0;      ///< planning time until the first catch was known; -1: never
  double planning_s = 0.0;             ///< total planning time
  int calls = 0;                       ///< number of planner calls
  std::uint64_t expansions = 0;        ///< over all calls
  std::optional<TeamFaultCounts> faults = {};  ///< set if faults were asked for
};

/// The execution.
class PursuitMission {
 public:
  /// Starts a mission. `seconds` is the length of the target's path with second 0; the target of `map` is
  /// ignored. `look` receives the run so far whenever planning knows more; its duration costs nothing.
  /// References must outlive the mission.
  PursuitMission(const PursuitProblem& map, std::size_t seconds, const PursuitRules& rules, StopWatch& watch,
                 std::function<void(const PursuitRun&)> look = {});

  /// Returns the next StepToCell, or nothing when the mission is over: the target is caught or gone, or no
  /// catch is possible any more. Expects a GridObservation each second.
  std::optional<Command> step(const Observation& seen);

  PursuitRun run;
  std::optional<Fault> fault;  ///< fault of the first planner call, which ends the mission

 private:
  /// The planning for one robot from one place.
  struct Session {
    std::size_t robot = 0;
    PursuitProblem problem;
    std::optional<AnytimePursuit> search;  ///< empty for other planners
    std::optional<PursuitPlan> answer;
    std::optional<Fault> fault;
    bool done = false;  ///< the planner has finished
    std::uint64_t lower_bound = 0;
    int earliest_catch_s = -1;
  };

  void take_in(const GridObservation& grid);
  void see_target(const GridObservation& grid);
  void close(const GridObservation& grid);
  bool reopen();
  void forget_path();
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
  bool keep_on();
  void settle();

  const PursuitRules& rules_;
  StopWatch& watch_;
  std::function<void(const PursuitRun&)> look_;
  std::size_t seconds_;
  std::vector<Cell> target_;               ///< known part of the target's path
  std::shared_ptr<const CostGrid> costs_;  ///< of the map
  TargetBelief belief_;
  std::vector<Session> sessions_;
  int lead_s_ = 0;
  bool settled_ = false;     ///< nothing is left to plan
  int thinking_s_ = 0;       ///< seconds until the answer of the current call arrives
  bool called_ = false;      ///< the current second is the last one of a call
  double planning_s_ = 0.0;  ///< planning time of the newest call
  bool taken_ = false;       ///< the answer of the newest call was used
};

}  // namespace outrider
