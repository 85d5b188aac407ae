#include "outrider/jobs/pursue/mission.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <memory>
#include <utility>

namespace outrider {

PursuitMission::PursuitMission(const PursuitProblem& map, std::size_t seconds, const PursuitRules& rules,
                               StopWatch& watch, std::function<void(const PursuitRun&)> look)
    : rules_(rules),
      watch_(watch),
      look_(std::move(look)),
      seconds_(seconds),
      costs_(map.costs),
      belief_(map, seconds, rules.forecast) {}

std::optional<Command> PursuitMission::step(const Observation& seen) {
  watch_.restart();
  take_in(*seen.grid);
  if (thinking_s_ > 0 && !is_over()) {
    if (--thinking_s_ == 0) splice_answers();
    return go();
  }
  if (called_) {
    called_ = false;
    note();
    settle();
  }
  if (is_over() || !plan()) return std::nullopt;
  return go();
}

/// Takes in the positions of all robots and the newly known cells of the target.
void PursuitMission::take_in(const GridObservation& grid) {
  see_target(grid);
  if (run.state.robots.empty()) {
    run.state = begin_pursuit(grid.robots);
    close(grid);
    return;
  }
  const auto now_s = static_cast<std::size_t>(run.state.time_s) + 1;
  const Cell before = run.state.robots[run.state.duty];
  const Cell sent_to = robot_at(run.state, run.state.duty, 1);
  const bool known = now_s < target_.size();
  pass_second(run.state, *costs_, grid.robots, known ? target_[now_s] : belief_.believed.target[now_s]);
  const Cell here = grid.robots[run.state.duty];
  if (here != sent_to) forget_path();
  close(grid);
  if (here != sent_to && here != before) {  // it was put there, perhaps nearer to the target
    run.lower_bound = 0;
    run.earliest_catch_s = -1;
  }
  if (!grid.caught || *grid.caught == run.state.caught) return;
  run.state.caught = *grid.caught;
  if (*grid.caught) return;
  belief_.doubt();  // the target is not where it was said to be
  forget_path();
}

/// Adds the newly known cells. Where it was not seen for a while, the target is taken to have gone straight.
void PursuitMission::see_target(const GridObservation& grid) {
  const std::size_t from =
      grid.target_from_s ? static_cast<std::size_t>(*grid.target_from_s) : target_.size();
  if (!grid.target.empty() && !target_.empty() && from > target_.size()) {
    const Cell a = target_.back(), b = grid.target.front();
    const auto steps = static_cast<double>(from - (target_.size() - 1));
    for (int k = 1; target_.size() < from; ++k) {
      const double part = k / steps;
      target_.push_back({a.x + static_cast<int>(std::lround(part * (b.x - a.x))),
                         a.y + static_cast<int>(std::lround(part * (b.y - a.y)))});
    }
  }
  target_.insert(target_.end(), grid.target.begin(), grid.target.end());
}

/// Plans around the cells that are closed from now on.
void PursuitMission::close(const GridObservation& grid) {
  if (grid.closed.empty() && grid.opened.empty()) return;
  CostGrid costs = *belief_.believed.costs;
  for (const Cell cell : grid.closed) costs[cell] = belief_.believed.threshold;
  for (const Cell cell : grid.opened) costs[cell] = (*costs_)[cell];
  belief_.believed.costs = std::make_shared<const CostGrid>(std::move(costs));
  forget_path();
}

/// Forgets which cells were closed. Returns false if none was.
bool PursuitMission::reopen() {
  if (belief_.believed.costs == costs_) return false;
  belief_.believed.costs = costs_;
  return true;
}

/// The robot on duty is not where it was sent: what was planned does not begin where it is.
void PursuitMission::forget_path() {
  run.state.ahead.clear();
  sessions_.clear();
  settled_ = called_ = false;
  thinking_s_ = lead_s_ = 0;
}

bool PursuitMission::is_over() const {
  return run.state.caught || static_cast<std::size_t>(run.state.time_s) + 1 >= seconds_;
}

/// Thinks, unless there is nothing to think about. Returns false when it is over.
bool PursuitMission::plan() {
  if (belief_.update(target_, run.state.robots[run.state.duty])) {
    settled_ = false;
    lead_s_ = 0;
    sessions_.clear();
  }
  if (settled_) return true;
  planning_s_ = call();
  if (!first_answer()) return false;
  thinking_s_ = rules_.clock == PursuitClock::wall ? seconds_charged(planning_s_) - 1 : 0;
  if (thinking_s_ == 0) splice_answers();
  return true;
}

Command PursuitMission::go() const {
  const std::size_t duty = run.state.duty;
  return StepToCell{duty, robot_at(run.state, duty, 1), robot_at(run.state, duty, 2)};
}

/// Shows the run. The time for that costs nothing.
void PursuitMission::show() {
  if (!look_) return;
  look_(run);
  watch_.restart();
}

void PursuitMission::open_sessions() {
  sessions_.clear();
  for (std::size_t i = 0; i < run.state.robots.size(); ++i) {
    Session session;
    session.robot = i;
    session.problem = question(run.state, belief_.believed, i, lead_s_);
    if (!rules_.ask) session.search.emplace(session.problem);
    sessions_.push_back(std::move(session));
  }
}

bool PursuitMission::all_failed() const {
  return std::ranges::all_of(sessions_, [](const Session& s) { return s.fault.has_value(); });
}

/// One call of the planner for the team; returns the seconds that it took.
double PursuitMission::call() {
  ++run.calls;
  const double before_s = run.planning_s;
  if (sessions_.empty()) open_sessions();
  for (Session& session : sessions_) work_on(session);
  if (all_failed() && reopen()) {  // what was closed may be open again
    open_sessions();
    for (Session& session : sessions_) work_on(session);
  }
  if (all_failed() && !belief_.is_certain()) {
    belief_.expect_rest();
    open_sessions();
    for (Session& session : sessions_) work_on(session);
  }
  if (run.calls == 1 && belief_.is_certain()) keep_bounds();
  return run.planning_s - before_s;
}

void PursuitMission::work_on(Session& session) {
  if (session.done) return;
  session.search ? search_in(session) : ask_for(session);
  if (session.fault) session.done = true;
}

void PursuitMission::ask_for(Session& session) {
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
void PursuitMission::search_in(Session& session) {
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

/// Keeps the bounds of the first call, which hold for the mission; later calls start elsewhere.
void PursuitMission::keep_bounds() {
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

void PursuitMission::note_answer(const Session& session) {
  if (session.answer && run.first_feasible_s < 0.0) run.first_feasible_s = run.planning_s;
  if (run.calls > 1 || sessions_.size() > 1 || !belief_.is_certain()) return;
  const auto cost = session.answer ? std::optional(session.answer->cost) : std::nullopt;
  run.moments.push_back({run.state.time_s, run.planning_s, run.expansions, cost, session.lower_bound});
  show();
}

void PursuitMission::note() {
  auto cost = cost_ahead(run.state, belief_.believed);
  if (run.state.caught) cost = 0;
  if (cost) *cost += run.state.cost;
  run.moments.push_back({run.state.time_s, run.planning_s, run.expansions, cost, run.lower_bound});
}

/// The faults of the first call are the answer to the whole request. Returns false when it is over.
bool PursuitMission::first_answer() {
  if (!all_failed()) return true;
  if (run.calls == 1 && belief_.is_certain()) {
    fault = std::move(*sessions_.front().fault);
    return false;
  }
  const bool from_here = sessions_.front().problem.start_s == run.state.time_s;
  return !from_here || !belief_.is_certain() || cost_ahead(run.state, belief_.believed);
}

void PursuitMission::splice_answers() {
  called_ = true;
  taken_ = false;
  for (const Session& session : sessions_) {
    if (!session.answer) continue;
    const PursuitProposal proposal{session.robot, *session.answer, session.problem.start_s};
    taken_ = splice(run.state, belief_.believed, proposal) || taken_;
  }
}

/// Lets the search of the only robot go on while the robot follows its best path, up to the second in which
/// an answer of a call as long as the last one arrives. Returns false if the robot goes elsewhere.
bool PursuitMission::keep_on() {
  Session& session = sessions_.front();
  if (sessions_.size() > 1 || !session.search || !session.answer) return false;
  const PursuitState& state = run.state;
  const std::vector<Cell>& path = session.answer->path;
  const auto passed = static_cast<std::size_t>(state.time_s - session.problem.start_s);
  if (passed >= path.size() || path[passed] != state.robots[session.robot]) return false;
  if (!std::equal(path.begin() + static_cast<std::ptrdiff_t>(passed) + 1, path.end(), state.ahead.begin(),
                  state.ahead.end()))
    return false;
  return session.search->keep_to(state.time_s + seconds_charged(planning_s_) - 1);
}

/// Decides whether to plan on, and from how far ahead.
void PursuitMission::settle() {
  const bool done = std::ranges::all_of(sessions_, [](const Session& s) { return s.done; });
  const bool on_the_way = run.state.caught || cost_ahead(run.state, belief_.believed).has_value();
  settled_ = done && (on_the_way || taken_ || (all_failed() && !belief_.is_certain()));
  if (settled_) return;
  const bool passed = sessions_.front().problem.start_s < run.state.time_s;
  if (!done && (!passed || keep_on())) return;  // the same question, further
  sessions_.clear();
  lead_s_ = std::max(2 * lead_s_, seconds_charged(planning_s_));
  lead_s_ = std::min(lead_s_, std::max(0, static_cast<int>(seconds_) - 1 - run.state.time_s));
}

}  // namespace outrider
