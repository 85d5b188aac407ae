#include "research/guard/temporal_mission.hpp"

#include <algorithm>

#include "outrider/tour/solve.hpp"

namespace outrider {
namespace {

/// The tour of the table without supplies that end.
Status solve_plain(const SupplyProblem& supplies, const GuardOptions& options, const Budget& budget,
                   TemporalMission& mission) {
  TourOptions tour_options;
  tour_options.iterations = options.iterations;
  auto tour = solve(supplies.table, tour_options, budget);
  if (!tour) return pass_on(tour);
  for (Visit& visit : tour->visits) mission.steps.push_back({visit.stop, std::move(visit.goals), {}});
  mission.cost_s = tour->cost_s;
  mission.lower_bound_s = tour->lower_bound_s;
  mission.proven = tour->proven_optimal;
  return {};
}

/// Takes goals out of the table, its targets and the steps; `dropped` is ascending.
void drop(const std::vector<std::uint32_t>& dropped, SupplyProblem& supplies, TemporalMission& mission) {
  const auto is_dropped = [&](std::uint32_t goal) { return std::ranges::binary_search(dropped, goal); };
  const auto renumbered = [&](std::uint32_t goal) {
    return goal - static_cast<std::uint32_t>(std::ranges::lower_bound(dropped, goal) - dropped.begin());
  };
  for (auto& services : supplies.table.services) {
    std::erase_if(services, [&](const Service& service) { return is_dropped(service.goal); });
    for (Service& service : services) service.goal = renumbered(service.goal);
  }
  for (SupplyStep& step : mission.steps) {
    for (std::uint32_t& goal : step.goals) goal = renumbered(goal);
  }
  for (auto goal = dropped.rbegin(); goal != dropped.rend(); ++goal) {
    mission.targets.erase(mission.targets.begin() + static_cast<std::ptrdiff_t>(*goal));
  }
  supplies.table.goals = mission.targets.size();
}

Status solve_with_ends(SupplyProblem& supplies, const Budget& budget, TemporalMission& mission) {
  auto tour = solve_supplied(supplies, {}, budget);
  if (!tour) return pass_on(tour);
  mission.steps = std::move(tour->steps);
  mission.cost_s = tour->cost_s;
  mission.proven = tour->proven_optimal;
  if (mission.proven) mission.lower_bound_s = mission.cost_s;
  drop(tour->dropped, supplies, mission);
  return {};
}

}  // namespace

Outcome<TemporalMission> temporal_mission(const GuardProblem& problem, const FiringMap& firing_map,
                                          const GuardPlan& plan, const GuardOptions& options,
                                          std::size_t stops, const Budget& budget) {
  auto table = supply_table(problem, firing_map, plan, stops, budget);
  if (!table) return pass_on(table);
  TemporalMission mission;
  mission.targets = std::move(table->targets);
  mission.places = std::move(table->places);
  mission.calls = std::move(table->calls);
  SupplyProblem supplies = std::move(table->problem);
  if (!mission.targets.empty()) {
    auto ok = problem.supplies.any() ? solve_with_ends(supplies, budget, mission)
                                     : solve_plain(supplies, options, budget, mission);
    if (!ok) return pass_on(ok);
  }
  if (mission.targets.empty()) {
    return fault(FaultCode::no_shot, "no target can be hit, so there is nothing to decide");
  }
  for (std::size_t t = 0; t < problem.targets.size(); ++t) {
    if (!std::ranges::binary_search(mission.targets, t)) mission.left_out.push_back(t);
  }
  auto temporal = temporal_problem(std::move(supplies));
  if (!temporal) return pass_on(temporal);
  mission.problem = std::move(*temporal);
  return mission;
}

}  // namespace outrider
