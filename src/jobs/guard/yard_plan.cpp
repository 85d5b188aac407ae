#include "yard_plan.hpp"

#include <utility>

#include "outrider/job/plan_cache.hpp"
#include "outrider/jobs/guard/prepare.hpp"
#include "outrider/jobs/guard/supply_plan.hpp"
#include "regions_log.hpp"

namespace outrider {
namespace {

/// Logs a plan from the cache as if it were made now.
void log_plan(Log& log, const GuardScenario& scenario, const YardPlan& yard) {
  if (scenario.regions) log_firing_regions(log, scenario.problem, yard.firing_map);
  if (scenario.wander.any()) return;
  log_firing_map(log, yard.firing_map);
  log_blocked_flights(log, scenario.problem, yard.firing_map);
  for (const TourDraft& tour : yard.drafts) log_tour(log, scenario.problem, tour);
}

}  // namespace

std::vector<std::string> unplanned_options(const GuardScenario& scenario) {
  if (scenario.arrivals.any()) return {"faults"};
  return {"faults", "seed"};
}

Outcome<GuardPlan> plan_still_yard(const GuardScenario& scenario, const GuardProblem& problem,
                                   const FiringMap& firing_map, const RunWatch& watch, Log& log,
                                   const DraftObserver& note, double time_s) {
  if (auto ok = check_supplies(problem, firing_map); !ok) return pass_on(ok);
  if (scenario.wander.any()) return GuardPlan{};
  log_firing_map(log, firing_map, time_s);
  log_blocked_flights(log, problem, firing_map, time_s);
  DraftObserver observe;
  if (scenario.has_still_targets()) {  // they have one tour, which can be shown
    observe = [&](const TourDraft& tour) {
      log_tour(log, problem, tour, time_s);
      if (note) note(tour);
    };
  }
  auto plan = plan_targets(scenario, problem, firing_map, watch.budget(), observe);
  if (plan && observe) observe(draft_of(problem, *plan));
  return plan;
}

Outcome<std::shared_ptr<const YardPlan>> plan_known_yard(const GuardScenario& scenario,
                                                         const std::string& key, RunSteps& steps,
                                                         const RunWatch& watch, Log& log) {
  if (auto ok = steps.next("surveying from where each target can be hit"); !ok) return pass_on(ok);
  if (auto planned = find_plan<YardPlan>(watch.plans, key); planned) {
    log_plan(log, scenario, *planned);
    if (auto ok = steps.next("planning the tour"); !ok) return pass_on(ok);
    return planned;
  }
  // Who walks about is not shot at by the regions of where it stood first.
  const bool needs_regions = !scenario.wander.any() || scenario.regions;
  auto firing_map = build_firing_map(scenario.problem, scenario.options, watch.budget(),
                                     needs_regions ? RegionSearch::exhaustive : RegionSearch::none);
  if (!firing_map) return pass_on(firing_map);
  if (scenario.regions) log_firing_regions(log, scenario.problem, *firing_map);
  if (auto ok = steps.next("planning the tour"); !ok) return pass_on(ok);
  std::vector<TourDraft> drafts;
  auto plan = plan_still_yard(scenario, scenario.problem, *firing_map, watch, log,
                              [&](const TourDraft& tour) { drafts.push_back(tour); });
  if (!plan) return pass_on(plan);
  return keep_plan(watch.plans, key, YardPlan{std::move(*firing_map), std::move(*plan), std::move(drafts)});
}

}  // namespace outrider
