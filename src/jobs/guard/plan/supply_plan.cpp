#include "outrider/jobs/guard/plan/supply_plan.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "outrider/jobs/guard/plan/bound.hpp"
#include "outrider/jobs/guard/plan/passing_plan.hpp"
#include "plan/plan_clock.hpp"

namespace outrider {
namespace {

constexpr std::size_t other_stops = 60;

/// Returns true if a robot that does nothing else can serve the goal.
bool is_possible_alone(SupplyProblem problem, std::uint32_t goal, const Budget& budget) {
  problem.table.goals = 1;
  for (auto& services : problem.table.services) {
    std::erase_if(services, [&](const Service& service) { return service.goal != goal; });
    for (Service& service : services) service.goal = 0;
  }
  const auto tour = solve_supplied(problem, {.iterations = 0}, budget);
  return tour && tour->dropped.empty();
}

std::string why_unsupplied(const Supplies& supplies, const SupplyProblem& problem, std::uint32_t goal,
                           const Budget& budget) {
  const auto fills = [&](Store store) {
    return std::ranges::count(problem.stations, store, &TourStation::store) > 0;
  };
  if (!is_possible_alone(problem, goal, budget)) {
    return fmt::format(
        "a battery of {:g} Wh, {:.0f} % of it in reserve, does not suffice to get to a place with a "
        "shot at it{}",
        supplies.battery_wh, 100.0 * supplies.reserve, fills(Store::charge) ? " and back to a charger" : "");
  }
  const bool dry = supplies.ends(Store::water) && !fills(Store::water);
  const bool flat = supplies.ends(Store::charge) && !fills(Store::charge);
  if (dry && !flat)
    return fmt::format("a tank of {:g} is empty before, and no station gives water", supplies.tank);
  if (flat && !dry) {
    return fmt::format("a battery of {:g} Wh is empty before, and no station gives charge",
                       supplies.battery_wh);
  }
  return dry ? "the supplies end before, and no station fills them up"
             : "no order was found in which the supplies suffice";
}

/// Stops with the shots solved again, for the pitch at which the shot before leaves the barrel.
std::vector<PlannedStop> stops_of(const GuardProblem& problem, const FiringMap& firing_map,
                                  const SupplyTable& table, const SupplyTour& tour, const GuardPlan& plan) {
  std::vector<PlannedStop> stops;
  double pitch = 0.0;
  for (const SupplyStep& step : tour.steps) {
    PlannedStop stop;
    stop.position = table.places[step.stop];
    if (step.station) {
      stop.call = table.calls[*step.station];
      pitch = 0.0;
    }
    for (const std::uint32_t goal : step.goals) {
      const std::size_t target = table.targets[goal];
      auto shot = best_shot(firing_map.rules, firing_map.space(target), problem.targets[target],
                            stop.position, pitch);
      if (!shot) {  // the one that the plan had from there
        for (const PlannedStop& before : plan.stops) {
          for (const PlannedHit& hit : before.hits) {
            if (hit.target == target) shot = hit.shot;
          }
        }
      }
      stop.hits.push_back({target, *shot});
      pitch = shot->gun.pitch_rad;
    }
    stops.push_back(std::move(stop));
  }
  return stops;
}

/// The plan with shots in passing. Its bound is that of missions with unlimited supplies.
GuardPlan on_the_move(const GuardProblem& problem, const FiringMap& firing_map, const GuardPlan& plan,
                      const GuardOptions& options, const Budget& budget) {
  GuardPlan result = shoot_in_passing(problem, firing_map, plan, budget.stop);
  if (!plan.unsupplied.empty()) return result;
  std::vector<std::size_t> targets;
  for (const PlannedStop& stop : plan.stops) {
    for (const PlannedHit& hit : stop.hits) targets.push_back(hit.target);
  }
  result.lower_bound_s = result.anywhere_lower_bound_s =
      mission_bound(problem, firing_map, targets, options, budget);
  return result;
}

}  // namespace

Outcome<GuardPlan> supply_plan(const GuardProblem& problem, const FiringMap& firing_map, GuardPlan plan,
                               const GuardOptions& options, const Budget& budget) {
  if (!problem.supplies.any()) return plan;
  auto table = supply_table(problem, firing_map, plan, other_stops, budget);
  if (!table) return pass_on(table);
  if (table->targets.empty()) return plan;
  auto tour = solve_supplied(table->problem, {}, budget);
  if (!tour) return pass_on(tour);
  plan.stops = stops_of(problem, firing_map, *table, *tour, plan);
  for (const std::uint32_t goal : tour->dropped) {
    plan.unsupplied.push_back(
        {table->targets[goal], why_unsupplied(problem.supplies, table->problem, goal, budget)});
  }
  plan.tour_proven = tour->proven_optimal;
  if (!plan.unsupplied.empty())
    plan.lower_bound_s = plan.anywhere_lower_bound_s = 0.0;  // for hitting them all
  if (auto ok = finish_plan(problem, firing_map, budget, plan); !ok) return pass_on(ok);
  plan.expected_s.reset();
  plan.lower_bound_s = std::min(plan.lower_bound_s, plan.cost_s);
  return options.shoot_on_the_move ? on_the_move(problem, firing_map, plan, options, budget) : plan;
}

std::vector<SupplyLevel> planned_levels(const GuardProblem& problem, const FiringMap& firing_map,
                                        const GuardPlan& plan) {
  std::vector<SupplyLevel> after;
  PlanClock clock(problem, firing_map, plan);
  while (!clock.done()) {
    clock.make_stop();
    after.push_back(clock.level());
  }
  return after;
}

bool suffices(const Supplies& supplies, const SupplyLevel& level) {
  constexpr double rounding = 1e-9;
  const double spare = supplies.ends(Store::charge) ? supplies.reserve * supplies.full(Store::charge) : 0.0;
  return level.water >= -rounding && level.charge >= spare - rounding;
}

}  // namespace outrider
