#include "outrider/jobs/guard/prepare.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "outrider/jobs/guard/capabilities.hpp"
#include "outrider/jobs/guard/catalog.hpp"
#include "outrider/jobs/guard/supply_plan.hpp"
#include "outrider/jobs/guard/survivors.hpp"

namespace outrider {
namespace {

Status check_preparable(const GuardScenario& scenario) {
  if (scenario.scout.unknown)
    return bad_input("the yard has to be explored first; give a robot a yard that is known", "scout.unknown");
  if (scenario.robots > 1)
    return bad_input(
        fmt::format("a mission is that of one robot, and there are {}; set robots to 1, or run the "
                    "scenario to have all of them simulated",
                    scenario.robots),
        "robots");
  if (scenario.pddl.any()) return bad_input("a problem in PDDL is no mission; leave the section out", "pddl");
  return {};
}

/// Sets the policy and the objective: those of the options, or the best ones if nobody comes but some
/// survive.
Status choose_policy(PreparedGuard& guard, const Budget& budget) {
  const ArrivalOptions& options = guard.scenario.arrivals;
  ArrivalPlan& plan = guard.arrivals.emplace(ArrivalPlan{*guard.yard, *guard.stops, {}});
  plan.group = static_cast<std::size_t>(options.group);
  plan.beam = static_cast<std::size_t>(options.beam);
  if (!options.any()) {
    const ArrivalOptions quick = survivor_options(options);
    const Policy best =
        best_policy(guard.scenario.problem, *guard.stops, quick, survivor_missions, budget.stop).policy;
    if (budget.stop.stop_requested()) return fault(FaultCode::cancelled, "it was cancelled while it planned");
    plan.policy = best.replan;
    plan.objective = best.objective;
    plan.beam = static_cast<std::size_t>(quick.beam);
    return {};
  }
  auto policy = find_replan_policy(options.policy);
  if (!policy) return pass_on(policy);
  auto objective = find_objective(options.objective);
  if (!objective) return pass_on(objective);
  plan.policy = std::move(*policy);
  plan.objective = *objective;
  return {};
}

Status prepare_arrivals(PreparedGuard& guard, const Budget& budget) {
  const GuardScenario& scenario = guard.scenario;
  auto intruders = scenario.arrivals.any() ? scenario.intruders : settled_intruders(scenario.problem);
  auto yard = arrival_yard(scenario.problem, guard.firing_map, std::move(intruders));
  if (!yard) return pass_on(yard);
  guard.yard = std::move(*yard);
  auto stops = precompute_stops(scenario.problem, guard.firing_map, guard.plan, scenario.arrivals, budget);
  if (!stops) return pass_on(stops);
  guard.stops = std::move(*stops);
  if (auto ok = choose_policy(guard, budget); !ok) return ok;
  guard.mission.emplace(*guard.arrivals);
  return {};
}

Status prepare_walkers(PreparedGuard& guard, const Budget& budget) {
  const GuardScenario& scenario = guard.scenario;
  auto plan = plan_moving(scenario.problem, guard.firing_map,
                          visit_map(scenario.problem, guard.firing_map, scenario.history, scenario.wander),
                          scenario.options, scenario.wander, budget);
  if (!plan) return pass_on(plan);
  guard.walkers.emplace(std::move(*plan));
  guard.mission.emplace(*guard.walkers);
  return {};
}

Status prepare(PreparedGuard& guard, const Budget& budget) {
  const GuardScenario& scenario = guard.scenario;
  if (auto ok = check_supplies(scenario.problem, guard.firing_map); !ok) return ok;
  if (scenario.wander.any()) return prepare_walkers(guard, budget);
  auto plan = plan_targets(scenario, scenario.problem, guard.firing_map, budget);
  if (!plan) return pass_on(plan);
  guard.plan = std::move(*plan);
  if (!scenario.has_still_targets()) return prepare_arrivals(guard, budget);
  guard.mission.emplace(scenario.problem, guard.firing_map, guard.plan);
  return {};
}

}  // namespace

Outcome<GuardPlan> plan_targets(const GuardScenario& scenario, const GuardProblem& problem,
                                const FiringMap& firing_map, const Budget& budget,
                                const DraftObserver& observe) {
  auto planner = find_guard_planner(scenario.options.planner);
  if (!planner) return pass_on(planner);
  const GuardOptions& options = scenario.options;
  // What the mission or the stations change later is a plan from rest.
  const bool changes = !scenario.has_still_targets();
  GuardOptions drafting = options;
  if (changes || problem.supplies.any()) drafting.shoot_on_the_move = false;
  auto plan = planner->plan(problem, firing_map, drafting, budget, observe);
  if (!plan) return plan;
  if (changes) {
    plan->on_the_move = options.shoot_on_the_move;
    return plan;
  }
  return supply_plan(problem, firing_map, std::move(*plan), options, budget);
}

Outcome<std::unique_ptr<PreparedGuard>> prepare_guard(GuardScenario scenario, const Budget& budget) {
  if (auto ok = check_preparable(scenario); !ok) return pass_on(ok);
  const RegionSearch search = scenario.wander.any() ? RegionSearch::none : RegionSearch::exhaustive;
  auto map = build_firing_map(scenario.problem, scenario.options, budget, search);
  if (!map) return pass_on(map);
  std::unique_ptr<PreparedGuard> guard(new PreparedGuard{std::move(scenario), std::move(*map)});
  if (auto ok = prepare(*guard, budget); !ok) return pass_on(ok);
  return guard;
}

GuardVerdict verdict_of(const GuardMission& mission) {
  const auto& records = mission.tasks.records;
  const auto count = [&](TargetStatus status) {
    return static_cast<std::size_t>(std::ranges::count(records, status, &TargetRecord::status));
  };
  const std::size_t reached = count(TargetStatus::reached), unreachable = count(TargetStatus::unreachable);
  GuardVerdict verdict{reached + unreachable == records.size() ? "done" : "not_done", {}};
  if (reached < records.size())
    verdict.reason =
        fmt::format("{} of {} targets reached, no shot found at {}", reached, records.size(), unreachable);
  if (mission.stores.stranded) verdict.reason += "; " + mission.stores.reason;
  return verdict;
}

}  // namespace outrider
