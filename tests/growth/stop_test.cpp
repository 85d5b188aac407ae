// How much do planners still do after a stop request? It is made at a number of counted blocks, not at a
// time, so each run is the same.
#include <gtest/gtest.h>

#include "outrider/path/catalog.hpp"
#include "subject.hpp"
#include "support/random_grid.hpp"
#include "work.hpp"

namespace outrider::growth {
namespace {

/// A map whose goal stands in a closed room, so that every search visits all of it.
Problem closed_room(int side, GridModel model) {
  Rng rng = stream("stop", side);
  Grid<std::uint8_t> blocked = strewn(rng, side, side, 0.1);
  const int low = side / 2 - 3, high = side / 2 + 3;
  for (int y = low; y <= high; ++y) {
    for (int x = low; x <= high; ++x) blocked[{x, y}] = x == low || x == high || y == low || y == high;
  }
  for (int k = 0; k < 9; ++k) blocked[{k % 3, k / 3}] = 0;
  auto ground = std::make_shared<const GridMap>(*GridMap::of(blocked, model));
  return {ground, ground->point({1, 1}), ground->point({side / 2, side / 2})};
}

TEST(Stop, GridPlannersEndSoonHoweverLargeTheMapIs) {
  constexpr double most_blocks = 2e5;
  for (const int side : {256, 1024}) {
    for (const char* name : {"dijkstra", "a_star", "theta_star"}) {
      const PathPlanner planner = find_path_planner(name).value();
      const Problem problem = closed_room(side, planner.models.front());
      const auto code = [&](const std::stop_token& stop) {
        Budget budget;
        budget.stop = stop;
        Workspace workspace;
        const auto plan = planner.configure().plan(problem, budget, workspace);
        return plan ? FaultCode::bad_input : plan.error().code;
      };
      FaultCode ended{};
      const double whole = work_of([&] { ended = code({}); }).blocks;
      ASSERT_EQ(ended, FaultCode::no_path) << name;
      ASSERT_GT(whole, 10.0 * most_blocks) << name << " is over too soon to show anything";
      for (const double part : {0.0, 0.35, 0.85}) {
        const double at = 1.0 + part * whole;
        const double ran = blocks_when_stopped(at, [&](const std::stop_token& stop) { ended = code(stop); });
        EXPECT_EQ(ended, FaultCode::cancelled) << name << " stopped at " << part;
        EXPECT_LT(ran - at, most_blocks) << name << " stopped at " << part << " of " << whole << " blocks";
      }
    }
  }
}

}  // namespace
}  // namespace outrider::growth
