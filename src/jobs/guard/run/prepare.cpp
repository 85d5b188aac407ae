#include "outrider/jobs/guard/run/prepare.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "outrider/core/units.hpp"
#include "outrider/job/plan_cache.hpp"
#include "outrider/jobs/guard/catalog.hpp"
#include "outrider/jobs/guard/plan/supply_plan.hpp"
#include "outrider/jobs/guard/team/team_plan.hpp"
#include "outrider/log/append.hpp"
#include "plan/plan_clock.hpp"
#include "run/guard_log.hpp"

namespace outrider {
namespace {

constexpr std::size_t survivor_missions = 40;  // that are simulated to estimate the time of one
constexpr std::size_t most_beam_of_survivors = 4;

/// The options on which a plan does not depend: `faults`, which planners do not know, and `seed`, unless it
/// draws intruders, who are planned for.
std::vector<std::string> unplanned_options(const GuardScenario& scenario) {
  if (scenario.arrivals.any()) return {"faults"};
  return {"faults", "seed"};
}

/// The log of the preparation, and the time of its messages.
struct Notes {
  Log& log;
  double time_s = 0.0;
};

void log_survey(const Notes& notes, const GuardScenario& scenario, const YardPlan& yard) {
  const auto& [log, time_s] = notes;
  const GuardProblem& problem = scenario.problem;
  if (scenario.regions) log_firing_regions(log, problem, yard.firing_map, time_s);
  for (std::size_t r = 1; r < yard.starts.size(); ++r) {
    const auto& [place, heading_rad] = yard.starts[r];
    log_event(
        log, time_s, "start",
        fmt::format("robot {} starts at ({:.2f}, {:.2f}), {:.0f} degrees{}", r + 1, place.x, place.y,
                    degrees(heading_rad), scenario.other_starts.empty() ? ", chosen beside robot 1" : ""));
  }
  if (scenario.wander.any()) return;
  log_firing_map(log, yard.firing_map, time_s);
  log_blocked_flights(log, problem, yard.firing_map, time_s);
}

/// Finds from where each target can be hit, and where the robots of a team start.
Outcome<YardPlan> survey(GuardScenario& scenario, const Budget& budget) {
  GuardProblem& problem = scenario.problem;
  // Firing regions of the first position are wrong once a target walks.
  const bool needs_regions = !scenario.wander.any() || scenario.regions;
  auto firing_map = build_firing_map(problem, scenario.options, budget,
                                     needs_regions ? RegionSearch::exhaustive : RegionSearch::none);
  if (!firing_map) return pass_on(firing_map);
  YardPlan yard{std::move(*firing_map)};
  if (scenario.scout.unknown) problem.supplies.stations = stations_in_reach(problem, yard.firing_map);
  if (scenario.robots == 1) return yard;
  auto starts = starts_of_team(problem, yard.firing_map, static_cast<std::size_t>(scenario.robots),
                               scenario.other_starts);
  if (!starts) return pass_on(starts);
  yard.starts = std::move(*starts);
  return yard;
}

/// Plans for targets that stand still. Plans that change later (missions, stations) use shots from rest, and
/// so do those of a navigator, whose drives are not planned to the moment.
Outcome<GuardPlan> plan_tour(const GuardScenario& scenario, const FiringMap& firing_map, const Budget& budget,
                             const DraftObserver& observe) {
  auto planner = find_guard_planner(scenario.options.planner);
  if (!planner) return pass_on(planner);
  const GuardProblem& problem = scenario.problem;
  const bool changes = !scenario.has_still_targets();
  const bool navigated = !problem.fires_driving;
  GuardOptions drafting = scenario.options;
  if (changes || navigated || problem.supplies.any()) drafting.shoot_on_the_move = false;
  auto plan = planner->plan(problem, firing_map, drafting, budget, observe);
  if (!plan) return plan;
  if (!changes) {
    const GuardOptions& filling = navigated ? drafting : scenario.options;
    plan = supply_plan(problem, firing_map, std::move(*plan), filling, budget);
    if (!plan || !navigated) return plan;
    plan->on_the_move = scenario.options.shoot_on_the_move;
    plan->cost_s = mission_time(problem, firing_map, *plan);
    return plan;
  }
  plan->on_the_move = scenario.options.shoot_on_the_move;
  return plan;
}

Status plan_yard(const GuardScenario& scenario, YardPlan& yard, const Budget& budget, const Notes& notes) {
  const GuardProblem& problem = scenario.problem;
  if (scenario.robots > 1) {
    auto team = plan_team(problem, yard.firing_map, yard.starts, scenario.options, budget);
    if (!team) return pass_on(team);
    yard.team = std::move(*team);
    return {};
  }
  if (auto ok = check_supplies(problem, yard.firing_map); !ok) return ok;
  if (scenario.wander.any()) return {};
  DraftObserver observe;
  if (scenario.has_still_targets()) {  // they have one tour, which can be shown
    observe = [&](const TourDraft& tour) {
      log_tour(notes.log, problem, tour, notes.time_s);
      yard.drafts.push_back(tour);
    };
  }
  auto tour = plan_tour(scenario, yard.firing_map, budget, observe);
  if (!tour) return pass_on(tour);
  if (observe) observe(draft_of(problem, *tour));
  yard.tour = std::move(*tour);
  return {};
}

/// Surveys and plans the yard, or takes both from the cache of the watch.
Outcome<std::shared_ptr<const YardPlan>> planned_yard(GuardScenario& scenario, RunSteps& steps,
                                                      const RunWatch& watch, const Notes& notes) {
  if (auto ok = steps.next("surveying from where each target can be hit"); !ok) return pass_on(ok);
  PlanCache* const plans = scenario.scout.unknown ? nullptr : watch.plans;  // a map is of one run
  const std::string key = plan_key(describe(scenario), unplanned_options(scenario));
  if (auto planned = find_plan<YardPlan>(plans, key); planned) {
    log_survey(notes, scenario, *planned);
    for (const TourDraft& tour : planned->drafts) log_tour(notes.log, scenario.problem, tour, notes.time_s);
    if (auto ok = steps.next("planning the tour"); !ok) return pass_on(ok);
    return planned;
  }
  auto yard = survey(scenario, watch.budget());
  if (!yard) return pass_on(yard);
  log_survey(notes, scenario, *yard);
  if (auto ok = steps.next("planning the tour"); !ok) return pass_on(ok);
  if (auto ok = plan_yard(scenario, *yard, watch.budget(), notes); !ok) return pass_on(ok);
  return keep_plan(plans, key, std::move(*yard));
}

/// Sets the policy and the objective: those of the options, or the makespan if nobody comes but some survive.
/// Then the expected time is estimated.
Status choose_policy(PreparedGuard& guard, const ArrivalYard& yard, const StopTable& stops,
                     const Budget& budget, const Notes& notes) {
  const ArrivalOptions& options = guard.scenario.arrivals;
  auto policy = find_replan_policy(options.policy);
  if (!policy) return pass_on(policy);
  auto objective = find_objective(options.objective);
  if (!objective) return pass_on(objective);
  RollingPlan& plan = guard.arrivals.emplace(RollingPlan{yard, stops, std::move(*policy)});
  plan.group = static_cast<std::size_t>(options.group);
  plan.objective = options.any() ? *objective : ArrivalObjective::makespan;
  plan.beam = static_cast<std::size_t>(options.beam);
  if (options.any()) return {};
  plan.beam = std::min(plan.beam, most_beam_of_survivors);
  guard.expected = expected_time(plan, options, survivor_missions, budget.stop);
  if (budget.stop.stop_requested())
    return fault(FaultCode::cancelled, "it was cancelled while it estimated the time of the mission");
  log_event(notes.log, notes.time_s, "plan",
            fmt::format("expects {:.1f} s, to a standard error of {:.1f} s; plans as {}, for the makespan",
                        guard.expected->mean_s, guard.expected->error_s, plan.policy.name));
  return {};
}

Status prepare_arrivals(PreparedGuard& guard, const Budget& budget, const Notes& notes) {
  const GuardScenario& scenario = guard.scenario;
  auto intruders = scenario.arrivals.any() ? scenario.intruders : settled_intruders(scenario.problem);
  const ArrivalYard& yard =
      guard.yard.emplace(arrival_yard(scenario.problem, guard.plan->firing_map, std::move(intruders)));
  auto stops = precompute_stops(scenario.problem, guard.plan->firing_map, *guard.plan->tour,
                                static_cast<std::size_t>(scenario.arrivals.stops), budget);
  if (!stops) return pass_on(stops);
  const StopTable& table = guard.stops.emplace(std::move(*stops));
  if (auto ok = choose_policy(guard, yard, table, budget, notes); !ok) return ok;
  guard.mission.emplace(*guard.arrivals);
  return {};
}

Status prepare_walkers(PreparedGuard& guard, const Budget& budget) {
  const GuardScenario& scenario = guard.scenario;
  const FiringMap& firing_map = guard.plan->firing_map;
  auto plan = plan_moving(scenario.problem, firing_map,
                          visit_map(scenario.problem, firing_map, scenario.history, scenario.wander),
                          scenario.options, scenario.wander, budget);
  if (!plan) return pass_on(plan);
  guard.walkers.emplace(std::move(*plan));
  guard.mission.emplace(*guard.walkers);
  return {};
}

/// Makes the mission that the yard is planned for, if it is that of one robot.
Status prepare_mission(PreparedGuard& guard, const Budget& budget, const Notes& notes) {
  const GuardScenario& scenario = guard.scenario;
  if (guard.plan->team) return {};
  if (scenario.wander.any()) return prepare_walkers(guard, budget);
  if (!scenario.has_still_targets()) return prepare_arrivals(guard, budget, notes);
  guard.mission.emplace(scenario.problem, guard.plan->firing_map, *guard.plan->tour);
  return {};
}

}  // namespace

Outcome<std::unique_ptr<PreparedGuard>> prepare_guard(GuardScenario scenario, RunSteps& steps,
                                                      const RunWatch& watch, Log& log, double time_s) {
  scenario.problem.fires_driving = scenario.sim != "navigator";
  auto guard = std::make_unique<PreparedGuard>(PreparedGuard{std::move(scenario)});
  const Notes notes{log, time_s};
  auto plan = planned_yard(guard->scenario, steps, watch, notes);
  if (!plan) return pass_on(plan);
  guard->plan = std::move(*plan);
  if (auto ok = prepare_mission(*guard, watch.budget(), notes); !ok) return pass_on(ok);
  return guard;
}

Outcome<std::unique_ptr<PreparedGuard>> prepare_guard(GuardScenario scenario, const RunWatch& watch,
                                                      const std::vector<Capability>& of_caller) {
  auto requested = requested_capabilities(scenario);
  requested.insert(requested.end(), of_caller.begin(), of_caller.end());
  requested.push_back(Capability::own_robot);
  if (auto ok = check_capabilities(requested); !ok) return pass_on(ok);
  scenario.sim.clear();
  RunSteps steps(watch, 2);
  Log log;
  return prepare_guard(std::move(scenario), steps, watch, log);
}

}  // namespace outrider
