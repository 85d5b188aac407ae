#include "outrider/jobs/guard/plan/plan.hpp"

#include <algorithm>

#include "outrider/jobs/guard/plan/bound.hpp"
#include "plan/draft.hpp"
#include "plan/plan_clock.hpp"

namespace outrider {
namespace {

constexpr std::int64_t exact_goals_of_part = 8;  // more take seconds, and many parts are planned

/// The stops of a draft with their shots, still without ways between them.
std::vector<PlannedStop> stops_of(const GuardProblem& problem, const FiringMap& firing_map,
                                  const Draft& draft, const ShotBook& book) {
  std::vector<PlannedStop> stops;
  for (const Visit& visit : draft.tour.visits) {
    const std::size_t cell = draft.cells[visit.stop];
    const bool at_start = visit.stop == 0;
    PlannedStop stop{at_start ? problem.start.position : firing_map.place(cell), {}, {}};
    for (const std::uint32_t goal : visit.goals) {
      const std::size_t target = draft.targets[goal];
      stop.hits.push_back({target, *book.at({cell, target})});
    }
    stops.push_back(std::move(stop));
  }
  return stops;
}

/// Tours are proven for shots from rest.
GuardOptions drafting_options(GuardOptions options) {
  if (options.prove) options.shoot_on_the_move = false;
  return options;
}

/// Drafts a tour that hits the targets, and gives its stops to the plan, with the ways and the cost.
Outcome<Draft> add_tour(const GuardProblem& problem, const FiringMap& firing_map, const DraftTask& task,
                        const GuardOptions& drafting, const Budget& budget, GuardPlan& plan,
                        const DraftObserver& observe) {
  ShotBook book;
  auto draft = draft_tour(problem, firing_map, task, drafting, budget, book, observe);
  if (!draft) return draft;
  for (const std::size_t t : task.targets) {
    if (std::ranges::find(draft->targets, t) != draft->targets.end()) continue;
    plan.unreachable.push_back({t, "its only shots keep the margin by less than the contact tolerance"});
  }
  plan.stops = stops_of(problem, firing_map, *draft, book);
  plan.tour_proven = draft->tour.proven_optimal;
  plan.stops_offered = draft->cells.size() - 1;
  if (auto ok = finish_plan(problem, firing_map, budget, plan); !ok) return pass_on(ok);
  return draft;
}

}  // namespace

TourDraft draft_of(const GuardProblem& problem, const GuardPlan& plan) {
  TourDraft tour{{}, {problem.start.position}, plan.bounded_s(), plan.lower_bound_s};
  for (const PlannedStop& stop : plan.stops) {
    DraftStop& told = tour.stops.emplace_back(DraftStop{stop.position, {}});
    stop.add_targets(told.targets);
    tour.way.insert(tour.way.end(), stop.waypoints.begin(), stop.waypoints.end());
  }
  return tour;
}

Outcome<GuardPlan> plan_guard(const GuardProblem& problem, const FiringMap& firing_map,
                              const GuardOptions& options, const Budget& budget,
                              const DraftObserver& observe) {
  GuardPlan plan = begin_plan(problem, firing_map, options);
  if (plan.unreachable.size() == problem.targets.size()) return plan;

  const GuardOptions drafting = drafting_options(options);
  const auto draft =
      add_tour(problem, firing_map, {targets_with_region(firing_map)}, drafting, budget, plan, observe);
  if (!draft) return pass_on(draft);
  const double anywhere_s = mission_bound(problem, firing_map, draft->targets, drafting, budget);
  if (drafting.shoot_on_the_move) {
    plan = shoot_in_passing(problem, firing_map, plan, budget.stop);
    plan.lower_bound_s = plan.anywhere_lower_bound_s = anywhere_s;
    return plan;
  }
  plan.anywhere_lower_bound_s = anywhere_s;
  plan.expected_s = draft->tour.cost_s;
  plan.lower_bound_s =
      std::max(draft->tour.lower_bound_s, std::min(plan.anywhere_lower_bound_s, plan.cost_s));
  return plan;
}

Outcome<GuardPlan> plan_part(const GuardProblem& problem, const FiringMap& firing_map,
                             const std::vector<std::size_t>& targets, const GuardOptions& options,
                             const Budget& budget) {
  GuardPlan plan;
  if (targets.empty()) return plan;
  GuardOptions drafting = drafting_options(options);
  drafting.gap = 1.0;  // no bound
  const auto draft =
      add_tour(problem, firing_map, {targets, exact_goals_of_part}, drafting, budget, plan, {});
  if (!draft) return pass_on(draft);
  if (drafting.shoot_on_the_move) return shoot_in_passing(problem, firing_map, plan, budget.stop);
  plan.expected_s = draft->tour.cost_s;
  return plan;
}

}  // namespace outrider
