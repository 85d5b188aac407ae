#include "outrider/path/fleet/fleet.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <optional>
#include <set>

#include "outrider/path/fleet/planners.hpp"
#include "support/costly_cases.hpp"
#include "support/random_grid.hpp"

namespace outrider {
namespace {

using Cells = std::vector<Cell>;

FleetProblem fleet_on(const Grid<std::uint8_t>& grid, const Cells& starts, const Cells& goals) {
  FleetProblem problem{std::make_shared<const GridMap>(GridMap::of(grid, GridModel::cells).value()), {}, {}};
  for (const Cell c : starts) problem.starts.push_back(grid.frame.centre(c));
  for (const Cell c : goals) problem.goals.push_back(grid.frame.centre(c));
  return problem;
}

/// Distinct random cells that are free.
std::optional<Cells> some_cells(Rng& rng, const Grid<std::uint8_t>& grid, std::size_t count) {
  Cells free;
  for (std::size_t i = 0; i < grid.cells.size(); ++i) {
    if (grid.cells[i] == 0) free.push_back(grid.frame.cell(i));
  }
  if (free.size() < count) return std::nullopt;
  for (std::size_t i = 0; i < count; ++i) std::swap(free[i], free[i + rng.below(free.size() - i)]);
  free.resize(count);
  return free;
}

/// The least sum of costs by a search over the cells of all robots at once, written from the definition. A
/// robot that has decided to stay at its goal costs nothing any more. Infinite if there is no plan.
double least_sum(const Grid<std::uint8_t>& grid, const Cells& starts, const Cells& goals) {
  const std::size_t robots = starts.size();
  using Joint = std::vector<int>;  // cell of each robot, then whether it stays
  Joint first;
  for (const Cell c : starts) first.push_back(static_cast<int>(grid.frame.index(c)));
  first.resize(2 * robots, 0);
  std::map<Joint, int> best{{first, 0}};
  std::set<std::pair<int, Joint>> open{{0, first}};
  while (!open.empty()) {
    const auto [cost, at] = *open.begin();
    open.erase(open.begin());
    if (std::accumulate(at.begin() + static_cast<std::ptrdiff_t>(robots), at.end(), 0) ==
        static_cast<int>(robots))
      return cost;
    // Each robot stays for good (0), waits (1) or moves (2 to 5): all combinations.
    std::vector<int> choice(robots, 0);
    for (;;) {
      Joint to = at;
      int more = 0;
      bool legal = true;
      for (std::size_t i = 0; i < robots && legal; ++i) {
        const Cell c = grid.frame.cell(static_cast<std::size_t>(at[i]));
        static const Cells moves{{0, 0}, {0, 0}, {1, 0}, {0, 1}, {-1, 0}, {0, -1}};
        const Cell move = moves[static_cast<std::size_t>(choice[i])];
        const Cell next{c.x + move.x, c.y + move.y};
        const bool stays = at[robots + i] != 0;
        legal = stays ? choice[i] == 0 : choice[i] != 0 || next == goals[i];
        legal = legal && grid.contains(next) && grid[next] == 0;
        if (!legal) break;
        to[i] = static_cast<int>(grid.frame.index(next));
        to[robots + i] = choice[i] == 0 ? 1 : 0;
        more += choice[i] == 0 ? 0 : 1;
      }
      for (std::size_t i = 0; i < robots && legal; ++i) {
        for (std::size_t j = 0; j < i && legal; ++j)
          legal = to[i] != to[j] && !(to[i] == at[j] && to[j] == at[i]);
      }
      if (legal) {
        const auto known = best.find(to);
        if (known == best.end() || cost + more < known->second) {
          if (known != best.end()) open.erase({known->second, to});
          best[to] = cost + more;
          open.insert({cost + more, to});
        }
      }
      std::size_t i = 0;
      while (i < robots && ++choice[i] == 6) choice[i++] = 0;
      if (i == robots) break;
    }
  }
  return std::numeric_limits<double>::infinity();
}

/// Every row against the search over all robots at once: which plans there are, and what the best one costs.
TEST(Fleet, AgreesWithASearchOverAllRobotsAtOnce) {
  Rng rng = Rng(51).child("tiny");
  int solved = 0, impossible = 0, dearer = 0, hard = 0;
  for (int i = 0; i < testing::costly_cases(300); ++i) {
    const auto grid =
        strewn(rng, 2 + static_cast<int>(rng.below(3)), 2 + static_cast<int>(rng.below(2)), 0.2);
    const std::size_t robots = 2 + rng.below(2);
    const auto starts = some_cells(rng, grid, robots), goals = some_cells(rng, grid, robots);
    if (!starts || !goals) continue;
    const FleetProblem problem = fleet_on(grid, *starts, *goals);
    const double least = least_sum(grid, *starts, *goals);
    for (const FleetPlanner& row : fleet_planners()) {
      SCOPED_TRACE(::testing::Message() << row.name << ", case " << i);
      Budget budget;
      budget.expansions = std::isinf(least) ? 20'000 : 2'000'000;
      const auto plan = row.configure().plan(problem, budget);
      if (std::isinf(least)) {
        ASSERT_FALSE(plan.has_value());
        if (row.complete) {
          ASSERT_EQ(plan.error().code, FaultCode::no_path);
          ++impossible;
        }
        continue;
      }
      if (!plan) {
        ASSERT_FALSE(row.complete) << to_string(plan.error());
        hard += row.optimal ? 1 : 0;
        ASSERT_EQ(plan.error().code, FaultCode::budget_exhausted);
        continue;
      }
      const auto verdict = check(*plan, problem);
      ASSERT_TRUE(verdict.has_value()) << to_string(verdict.error());
      ASSERT_GE(static_cast<double>(plan->cost), least);
      ASSERT_LE(static_cast<double>(plan->lower_bound), least);
      if (row.optimal) {
        ASSERT_EQ(static_cast<double>(plan->cost), least);
        ASSERT_EQ(plan->lower_bound, plan->cost);
      }
      ++solved;
      dearer += static_cast<double>(plan->cost) > least ? 1 : 0;
    }
  }
  if (!testing::in_full()) return;
  EXPECT_GT(solved, 300);
  EXPECT_GT(impossible, 30);
  EXPECT_GT(dearer, 10);
  EXPECT_LE(hard, 3) << "cbs is given up only where robots have to go far out of their way";
}

/// Larger grids: valid plans of all rows, the optimal one not dearer than the others.
TEST(Fleet, PlansLargerFleets) {
  Rng rng = Rng(52).child("larger");
  for (int i = 0; i < testing::costly_cases(20); ++i) {
    const auto grid = strewn(rng, 16, 16, 0.1);
    const std::size_t robots = 4 + rng.below(5);
    const auto starts = some_cells(rng, grid, robots), goals = some_cells(rng, grid, robots);
    const FleetProblem problem = fleet_on(grid, *starts, *goals);
    std::map<std::string_view, std::uint64_t> costs;
    for (const FleetPlanner& row : fleet_planners()) {
      Budget budget;
      budget.expansions = 2'000'000;
      const auto plan = row.configure().plan(problem, budget);
      if (!plan) continue;  // closed in by blocked cells, or too hard
      ASSERT_TRUE(check(*plan, problem).has_value()) << row.name;
      costs[row.name] = plan->cost;
      EXPECT_EQ(*row.configure().plan(problem, budget), *plan) << "the same again";
    }
    for (const auto& [name, cost] : costs) {
      if (!costs.contains("cbs")) continue;
      EXPECT_LE(costs["cbs"], cost) << name;
    }
  }
}

TEST(Lacam, MovesAHundredRobots) {
  Rng rng = Rng(53).child("hundred");
  const Grid<std::uint8_t> grid(GridFrame{{}, 1.0, 24, 24});
  const auto starts = some_cells(rng, grid, 100), goals = some_cells(rng, grid, 100);
  const FleetProblem problem = fleet_on(grid, *starts, *goals);
  const auto plan = lacam(problem, {}, {});
  ASSERT_TRUE(plan.has_value()) << to_string(plan.error());
  const auto verdict = check(*plan, problem);
  ASSERT_TRUE(verdict.has_value()) << to_string(verdict.error());
  EXPECT_LT(plan->expansions, 1000U);
}

/// Two robots that must pass each other: with a bay they can, without one they cannot, and lacam proves it.
TEST(Fleet, ABayLetsTwoRobotsPass) {
  const Cells starts{{0, 0}, {4, 0}}, goals{{4, 0}, {0, 0}};
  const FleetProblem bay = fleet_on(drawn({"##.##", "....."}), starts, goals);
  const auto best = cbs(bay, {}, {});
  ASSERT_TRUE(best.has_value()) << to_string(best.error());
  EXPECT_EQ(best->cost, 11U) << "one goes into the bay and back, the other waits a step";
  EXPECT_EQ(lacam(bay, {}, {})->lower_bound, 8U);
  const FleetProblem corridor = fleet_on(drawn({"#####", "....."}), starts, goals);
  EXPECT_EQ(lacam(corridor, {}, {}).error().code, FaultCode::no_path);
  EXPECT_EQ(cbs(corridor, {200}, {}).error().code, FaultCode::budget_exhausted);
  EXPECT_EQ(prioritized(corridor, {}, {}).error().code, FaultCode::budget_exhausted);
}

TEST(Fleet, TheJudgeFindsEachFault) {
  const FleetProblem problem = fleet_on(drawn({"....", "....", "...#"}), {{0, 1}, {2, 1}}, {{2, 1}, {0, 1}});
  const FleetPlan good{
      {{{0, 1}, {0, 2}, {1, 2}, {2, 2}, {2, 1}}, {{2, 1}, {1, 1}, {0, 1}, {0, 1}, {0, 1}}}, 6, 4, 0};
  ASSERT_TRUE(check(good, problem).has_value()) << to_string(check(good, problem).error());
  const auto says = [&](FleetPlan bad, const std::string& words) {
    const auto verdict = check(bad, problem);
    ASSERT_FALSE(verdict.has_value()) << words;
    EXPECT_NE(verdict.error().sentence.find(words), std::string::npos) << verdict.error().sentence;
  };
  FleetPlan bad = good;
  bad.paths[0] = {{0, 1}, {1, 1}, {1, 1}, {1, 1}, {2, 1}};
  says(bad, "robots 1 and 2 are in one cell at step 1");
  bad.paths[0] = {{0, 1}, {0, 1}, {1, 1}, {2, 1}, {2, 1}};
  says(bad, "robots 1 and 2 exchange their cells in step 2");
  bad = good;
  bad.paths[0][2] = {2, 2};
  says(bad, "robot 1 moves by 2 cells in step 2");
  bad = good;
  bad.paths[1] = {{2, 1}, {2, 0}, {3, 0}, {2, 0}, {0, 1}};
  says(bad, "robot 2 is in a blocked cell at step 2");
  bad = good;
  bad.cost = 7;
  says(bad, "the cost is 7, but its robots add up to 6");
  bad = good;
  bad.lower_bound = 7;
  says(bad, "lower bound 7 is above");
  bad = good;
  bad.paths[0].back() = {1, 2};
  says(bad, "robot 1 does not end at its goal");
  bad = good;
  bad = good;
  bad.paths[1].pop_back();
  says(bad, "not as long");
  bad.paths.pop_back();
  says(bad, "1 paths came for 2 robots");
}

TEST(Fleet, EveryRowKeepsTheContract) {
  const auto grid = drawn({".....", ".###.", ".#.#.", ".###.", "....."});
  const Cells ends{{0, 0}, {4, 0}, {0, 4}};
  for (const FleetPlanner& row : fleet_planners()) {
    SCOPED_TRACE(row.name);
    EXPECT_EQ(find_fleet_planner(row.name)->name, row.name);
    const auto code = [&](const FleetProblem& problem, const Budget& budget = {}) {
      const auto plan = row.configure().plan(problem, budget);
      EXPECT_FALSE(plan.has_value());
      return plan ? FaultCode::cannot_write : plan.error().code;
    };
    const auto still = row.configure().plan(fleet_on(grid, ends, ends), {});
    ASSERT_TRUE(still.has_value());
    EXPECT_EQ(still->cost, 0U);
    EXPECT_TRUE(check(*still, fleet_on(grid, ends, ends)).has_value());
    const FleetProblem turn = fleet_on(grid, ends, {{4, 0}, {0, 4}, {0, 0}});
    Budget budget;
    EXPECT_TRUE(row.configure().plan(turn, budget).has_value());
    budget.expansions = 0;
    EXPECT_EQ(code(turn, budget), FaultCode::budget_exhausted);
    std::stop_source source;
    source.request_stop();
    Budget stopped;
    stopped.stop = source.get_token();
    EXPECT_EQ(code(turn, stopped), FaultCode::cancelled);
    EXPECT_EQ(code(fleet_on(grid, {{0, 0}, {2, 2}}, {{4, 0}, {0, 4}})), FaultCode::no_path) << "walled in";
    EXPECT_EQ(code(fleet_on(grid, {{1, 1}}, {{0, 0}})), FaultCode::start_blocked);
    EXPECT_EQ(code(fleet_on(grid, {{0, 0}}, {{1, 1}})), FaultCode::goal_blocked);
    EXPECT_EQ(code(fleet_on(grid, {{9, 0}}, {{0, 0}})), FaultCode::outside_map);
    EXPECT_EQ(code(fleet_on(grid, {{0, 0}, {0, 0}}, {{1, 0}, {2, 0}})), FaultCode::bad_input);
    EXPECT_EQ(code(fleet_on(grid, {{0, 0}, {1, 0}}, {{2, 0}, {2, 0}})), FaultCode::bad_input);
    EXPECT_EQ(code(fleet_on(grid, {{0, 0}}, {})), FaultCode::bad_input);
    EXPECT_EQ(code(fleet_on(grid, {}, {})), FaultCode::bad_input);
    EXPECT_EQ(code({nullptr, {{0, 0}}, {{0, 0}}}), FaultCode::bad_input);
    const FleetProblem corners{
        std::make_shared<const GridMap>(GridMap::of(grid, GridModel::corners).value()), {{0, 0}}, {{1, 0}}};
    EXPECT_EQ(code(corners), FaultCode::bad_input);
    for (const Option& option : row.configure().options)
      EXPECT_TRUE(assign(option, value_text(option)).has_value());
  }
  EXPECT_NE(find_fleet_planner("lacan").error().sentence.find("lacam"), std::string::npos);
  EXPECT_EQ(cbs(fleet_on(grid, ends, ends), {0}, {}).error().code, FaultCode::bad_input);
}

}  // namespace
}  // namespace outrider
