// Guard problems with what missions start from: the firing map, the plan, and the stops for arrivals.
#pragma once

#include <gtest/gtest.h>

#include <utility>

#include "outrider/jobs/guard/plan/stop_table.hpp"
#include "support/guard_yard.hpp"

namespace outrider::testing {

/// Plans from rest, coarser than those of quick().
inline GuardOptions coarse() {
  GuardOptions options = from_rest();
  options.resolution_m = 0.25;
  options.stops = 60;
  options.refinements = 0;
  options.iterations = 50;
  return options;
}

inline FiringMap firing_map_of(const GuardProblem& problem, const GuardOptions& options) {
  auto firing_map = build_firing_map(problem, options);
  EXPECT_TRUE(firing_map.has_value()) << firing_map.error().sentence;
  return std::move(*firing_map);
}

struct PlannedYard {
  GuardProblem problem;
  FiringMap firing_map;
  GuardPlan plan;
};

inline PlannedYard planned_yard(GuardProblem problem, const GuardOptions& options) {
  FiringMap firing_map = firing_map_of(problem, options);
  auto plan = plan_guard(problem, firing_map, options, {});
  EXPECT_TRUE(plan.has_value()) << plan.error().sentence;
  return {std::move(problem), std::move(firing_map), std::move(*plan)};
}

struct ArrivalsYard : PlannedYard {
  ArrivalOptions options;
  StopTable precomputed;
};

/// On the move there are shots in passing, and nobody waits for sure shots.
inline ArrivalsYard arrivals_yard(PlannedYard yard, const ArrivalOptions& options = {},
                                  bool on_the_move = false) {
  yard.plan.on_the_move = on_the_move;
  auto precomputed =
      precompute_stops(yard.problem, yard.firing_map, yard.plan, static_cast<std::size_t>(options.stops), {});
  EXPECT_TRUE(precomputed.has_value()) << precomputed.error().sentence;
  return {std::move(yard), options, std::move(*precomputed)};
}

inline ArrivalsYard random_arrivals_yard(Rng& rng, std::size_t solids, std::size_t targets, bool with_errors,
                                         bool on_the_move = false) {
  GuardProblem problem = random_guard_problem(rng, solids, targets, 2.5);
  if (!with_errors) problem.errors = {0.0, 0.0, {0.0, 0.0}};
  ArrivalOptions options;
  options.stops = 30;
  options.beam = 10;
  return arrivals_yard(planned_yard(std::move(problem), quick()), options, on_the_move);
}

/// The way to the fox leads around two corners; the cat sits in front of the start.
inline GuardProblem corners() {
  GuardProblem problem;
  problem.world.name = "corners";
  problem.world.bounds = {{-4, -4}, {4, 4}};
  problem.world.solids = {floor_at(0), box_at("long", {-0.75, 0, 2}, {6.5, 0.1, 4}),
                          box_at("short", {1.5, 2.45, 2}, {0.1, 3.1, 4})};
  problem.start = {{-2, -3.5}, radians(90)};
  problem.targets = {{"fox", {0.5, 3.3, 0}, {0.4, 0.3, 0.4}, 0.0},
                     {"cat", {-3, -1, 0}, {0.4, 0.3, 0.4}, 0.0}};
  return problem;
}

/// A tank of two shots and a small battery; the well and the dock are beside the start.
inline void limit_stores(GuardProblem& problem, double battery_wh) {
  problem.supplies.tank = 2.0;
  problem.supplies.battery_wh = battery_wh;
  problem.supplies.stations = {{"well", problem.start.position + Vec2{0.5, 0.0}, true, false},
                               {"dock", problem.start.position + Vec2{-0.5, 0.0}, false, true}};
}

}  // namespace outrider::testing
