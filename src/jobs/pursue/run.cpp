#include "outrider/jobs/pursue/run.hpp"

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <utility>

#include "outrider/pursuit/anytime.hpp"

namespace outrider {
namespace {

/// What the planner is told of the target.
class Belief {
 public:
  Belief(const PursuitProblem& truth, const PursuitRules& rules) : truth_(truth), rules_(rules) {
    if (!rules_.forecast.predict) rules_.forecast = target_forecasts().front();
    believed = truth;
    reveal(0, truth.start);
  }

  [[nodiscard]] bool is_certain() const { return known_ == truth_.target.size(); }

  /// What is known at that second; true when it was not as believed.
  bool reveal(int time_s, Cell robot) {
    const std::size_t all = truth_.target.size();
    const std::size_t before = known_;
    known_ = rules_.known_s >= truth_.last_s() - time_s
                 ? all
                 : static_cast<std::size_t>(time_s) + static_cast<std::size_t>(rules_.known_s) + 1;
    const auto first = static_cast<std::ptrdiff_t>(before), last = static_cast<std::ptrdiff_t>(known_);
    if (before > 0 && std::equal(truth_.target.begin() + first, truth_.target.begin() + last,
                                 believed.target.begin() + first)) {
      return false;
    }
    foresee(rules_.forecast, robot);
    return true;
  }

  /// Gives up the forecast: the target stays where it was seen last.
  void expect_rest() { foresee(target_forecasts().back(), {}); }

  PursuitProblem believed;

 private:
  void foresee(const TargetForecast& forecast, Cell robot) {
    const std::span<const Cell> seen(truth_.target.data(), known_);
    const auto rest = forecast.predict({truth_, seen, robot}, truth_.target.size() - known_);
    believed.target.assign(seen.begin(), seen.end());
    believed.target.insert(believed.target.end(), rest.begin(), rest.end());
  }

  const PursuitProblem& truth_;
  PursuitRules rules_;
  std::size_t known_ = 0;
};

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

class Pursuer {
 public:
  Pursuer(const PursuitProblem& truth, const std::vector<Cell>& robots, const PursuitRules& rules,
          StopWatch& watch, const std::function<void(const PursuitRun&)>& look)
      : truth_(truth), rules_(rules), watch_(watch), look_(look), belief_(truth, rules) {
    run.mission = begin_pursuit(robots);
  }

  Status go() {
    PursuitMission& mission = run.mission;
    while (!is_over(mission, truth_) && !rules_.budget.stop.stop_requested()) {
      if (belief_.reveal(mission.time_s, mission.robots[mission.duty])) {
        settled_ = false;
        lead_s_ = 0;
        sessions_.clear();
      }
      if (settled_) {
        pass_second(mission, truth_);
        show();
        continue;
      }
      const double planning_s = call();
      if (auto ok = first_answer(); !ok) return ok;
      if (lost_) break;
      const bool taken = step(mission, truth_, belief_.believed, proposals(),
                              rules_.clock == PursuitClock::wall ? planning_s : 0.0);
      note();
      show();
      settle(taken, planning_s);
    }
    return {};
  }

  PursuitRun run;

 private:
  /// What looking takes is not charged.
  void show() {
    if (!look_) return;
    look_(run);
    watch_.lap_s();
  }

  void open_sessions() {
    sessions_.clear();
    for (std::size_t i = 0; i < run.mission.robots.size(); ++i) {
      Session session;
      session.robot = i;
      session.problem = question(run.mission, belief_.believed, i, lead_s_);
      if (!rules_.ask) session.search.emplace(session.problem);
      sessions_.push_back(std::move(session));
    }
  }

  [[nodiscard]] bool all_failed() const {
    return std::ranges::all_of(sessions_, [](const Session& s) { return s.fault.has_value(); });
  }

  /// One call of the planner for the team; returns the seconds that it took.
  double call() {
    ++run.calls;
    const double before_s = run.planning_s;
    if (sessions_.empty()) open_sessions();
    for (Session& session : sessions_) work_on(session);
    if (all_failed() && !belief_.is_certain()) {
      belief_.expect_rest();
      open_sessions();
      for (Session& session : sessions_) work_on(session);
    }
    if (run.calls == 1 && belief_.is_certain()) keep_bounds();
    return run.planning_s - before_s;
  }

  void work_on(Session& session) {
    if (session.done) return;
    session.search ? search_in(session) : ask_for(session);
    if (session.fault) session.done = true;
  }

  void ask_for(Session& session) {
    auto plan = rules_.ask(session.problem, rules_.budget);
    run.planning_s += watch_.lap_s();
    session.done = true;
    if (plan) {
      run.expansions += plan->counters.expansions;
      session.lower_bound = plan->lower_bound;
      session.earliest_catch_s = plan->earliest_catch_s;
      session.answer = std::move(*plan);
      note_answer(session);
    } else {
      session.fault = std::move(plan.error());
    }
  }

  /// Until the call's time is up or the search is over.
  void search_in(Session& session) {
    AnytimePursuit& search = *session.search;
    const bool timed = rules_.clock == PursuitClock::wall;
    const double end_s = timed ? run.planning_s + rules_.call_s / static_cast<double>(sessions_.size())
                               : std::numeric_limits<double>::infinity();
    std::uint64_t expanded = search.counters().expansions;
    for (bool better = true; better && !search.proven() && run.planning_s < end_s;) {
      Budget budget = rules_.budget;
      if (timed) {
        const std::chrono::duration<double> left(end_s - run.planning_s);
        budget.wall_time = std::chrono::duration_cast<std::chrono::nanoseconds>(left);
      }
      const auto worked = search.improve(budget);
      run.planning_s += watch_.lap_s();
      const std::uint64_t before = std::exchange(expanded, search.counters().expansions);
      run.expansions += expanded - before;
      if (!worked) {
        session.fault = worked.error();
        break;
      }
      better = search.best() && (!session.answer || search.best()->cost < session.answer->cost);
      session.answer = search.best();
      session.lower_bound = search.lower_bound();
      session.earliest_catch_s = search.earliest_catch_s().value_or(-1);
      note_answer(session);
    }
    session.done = search.proven();
  }

  /// What the first call proves holds for the mission; later ones start elsewhere.
  void keep_bounds() {
    run.lower_bound = std::numeric_limits<std::uint64_t>::max();
    for (const Session& session : sessions_) {
      if (session.fault) continue;
      run.lower_bound = std::min(run.lower_bound, session.lower_bound);
      if (session.earliest_catch_s < 0) continue;
      run.earliest_catch_s = run.earliest_catch_s < 0
                                 ? session.earliest_catch_s
                                 : std::min(run.earliest_catch_s, session.earliest_catch_s);
    }
    if (all_failed()) run.lower_bound = 0;
  }

  void note_answer(const Session& session) {
    if (session.answer && run.first_feasible_s < 0.0) run.first_feasible_s = run.planning_s;
    if (run.calls > 1 || sessions_.size() > 1 || !belief_.is_certain()) return;
    const auto cost = session.answer ? std::optional(session.answer->cost) : std::nullopt;
    run.moments.push_back({run.mission.time_s, run.planning_s, run.expansions, cost, session.lower_bound});
    show();
  }

  void note() {
    auto cost = cost_ahead(run.mission, belief_.believed);
    if (run.mission.caught) cost = 0;
    if (cost) *cost += run.mission.cost;
    run.moments.push_back({run.mission.time_s, run.planning_s, run.expansions, cost, run.lower_bound});
  }

  /// The faults of the first call are the answer to the whole request.
  Status first_answer() {
    if (!all_failed()) return {};
    if (run.calls == 1 && belief_.is_certain()) {
      return tl::unexpected<Fault>(std::move(*sessions_.front().fault));
    }
    const bool from_here = sessions_.front().problem.start_s == run.mission.time_s;
    lost_ = from_here && belief_.is_certain() && !cost_ahead(run.mission, truth_);
    return {};
  }

  [[nodiscard]] std::vector<PursuitProposal> proposals() const {
    std::vector<PursuitProposal> all;
    for (const Session& session : sessions_) {
      if (session.answer) all.push_back({session.robot, *session.answer, session.problem.start_s});
    }
    return all;
  }

  /// Whether to go on thinking, and from how far ahead.
  void settle(bool taken, double planning_s) {
    const bool done = std::ranges::all_of(sessions_, [](const Session& s) { return s.done; });
    const bool on_the_way = run.mission.caught || cost_ahead(run.mission, belief_.believed).has_value();
    settled_ = done && (on_the_way || taken || (all_failed() && !belief_.is_certain()));
    if (settled_) return;
    const bool passed = sessions_.front().problem.start_s < run.mission.time_s;
    if (!done && !passed) return;  // the same question, further
    sessions_.clear();
    lead_s_ = std::max(2 * lead_s_, seconds_charged(planning_s));
    lead_s_ = std::min(lead_s_, std::max(0, truth_.last_s() - run.mission.time_s));
  }

  const PursuitProblem& truth_;
  const PursuitRules& rules_;
  StopWatch& watch_;
  const std::function<void(const PursuitRun&)>& look_;
  Belief belief_;
  std::vector<Session> sessions_;
  int lead_s_ = 0;
  bool settled_ = false;
  bool lost_ = false;
};

}  // namespace

Outcome<PursuitRun> pursue(const PursuitProblem& truth, const std::vector<Cell>& robots,
                           const PursuitRules& rules, StopWatch& watch,
                           const std::function<void(const PursuitRun&)>& look) {
  for (const Cell robot : robots) {
    PursuitProblem problem = truth;
    problem.start = robot;
    if (auto ok = check(problem); !ok) return pass_on(ok);
  }
  Pursuer pursuer(truth, robots, rules, watch, look);
  watch.lap_s();
  if (auto ok = pursuer.go(); !ok) return pass_on(ok);
  return std::move(pursuer.run);
}

std::vector<Cell> place_team(const PursuitProblem& problem, std::size_t count) {
  const CostGrid& costs = *problem.costs;
  std::vector<Cell> team{problem.start};
  std::vector<int> nearest(costs.cells.size(), std::numeric_limits<int>::max());
  while (team.size() < count) {
    std::size_t best = costs.frame.index(team.back());
    nearest[best] = 0;
    for (std::size_t i = 0; i < nearest.size(); ++i) {
      const Cell cell = costs.frame.cell(i);
      const int away = std::max(std::abs(cell.x - team.back().x), std::abs(cell.y - team.back().y));
      nearest[i] = std::min(nearest[i], away);
      if (costs.cells[i] < problem.threshold && nearest[i] > nearest[best]) best = i;
    }
    team.push_back(costs.frame.cell(best));
  }
  return team;
}

}  // namespace outrider
