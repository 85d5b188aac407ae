// The laws that every row of the catalogue of path planners keeps, in both models of the grid.
#include <gtest/gtest.h>

#include <filesystem>
#include <set>
#include <tuple>

#include "outrider/path/catalog.hpp"
#include "outrider/path/check.hpp"
#include "support/grid_oracle.hpp"
#include "support/random_grid.hpp"

namespace outrider {
namespace {

constexpr double tiny = 1e-9;

Problem problem_on(const Grid<std::uint8_t>& blocked, GridModel model, Cell start, Cell goal) {
  auto ground = GridMap::of(blocked, model);
  EXPECT_TRUE(ground.has_value());
  auto shared = std::make_shared<const GridMap>(std::move(*ground));
  return {shared, shared->point(start), shared->point(goal)};
}

class PathContract : public testing::TestWithParam<std::tuple<std::size_t, GridModel>> {
 protected:
  const PathPlanner& row() const { return path_planners()[std::get<0>(GetParam())]; }
  GridModel model() const { return std::get<1>(GetParam()); }
  /// In one workspace for all queries, but for rows that would do a part of the work only.
  Outcome<Plan> plan(const Problem& problem, const Budget& budget = {}) {
    Workspace fresh;
    return row().configure().plan(problem, budget, row().incremental ? fresh : workspace_);
  }
  FaultCode code(const Problem& problem, const Budget& budget = {}) {
    auto answer = plan(problem, budget);
    EXPECT_FALSE(answer.has_value());
    if (answer) return FaultCode::bad_input;
    EXPECT_GT(answer.error().sentence.size(), 20U);
    return answer.error().code;
  }
  bool any_direction() const { return row().guarantee.among == PathClass::any_direction; }
  /// Returns true if the planner minimises the quantity that the oracle knows.
  bool shortest() const {
    const Measure measure = row().guarantee.measure;  // without costs, the terrain is the length
    const bool length = measure == Measure::length || measure == Measure::terrain;
    return length && std::isfinite(row().guarantee.most_ratio);
  }

  Workspace workspace_;
};

std::string name_of(const testing::TestParamInfo<std::tuple<std::size_t, GridModel>>& info) {
  return std::string(path_planners()[std::get<0>(info.param)].name) + "_" +
         std::string(to_string(std::get<1>(info.param)));
}

/// Each row with each model that it takes.
std::vector<std::tuple<std::size_t, GridModel>> rows_and_models() {
  std::vector<std::tuple<std::size_t, GridModel>> all;
  for (std::size_t i = 0; i < path_planners().size(); ++i) {
    for (const GridModel model : path_planners()[i].models) all.emplace_back(i, model);
  }
  return all;
}

INSTANTIATE_TEST_SUITE_P(Rows, PathContract, testing::ValuesIn(rows_and_models()), name_of);

TEST_P(PathContract, StartIsGoal) {
  const Problem problem = problem_on(drawn({"...", "...", "..."}), model(), {1, 1}, {1, 1});
  const auto answer = plan(problem);
  ASSERT_TRUE(answer.has_value());
  EXPECT_EQ(answer->waypoints, std::vector<Vec2>{problem.start});
  EXPECT_EQ(answer->cost, 0.0);
  EXPECT_EQ(answer->lower_bound, 0.0);
  EXPECT_TRUE(check(*answer, problem).has_value());
}

TEST_P(PathContract, BlockedOrOutside) {
  const auto grid = drawn({"......", ".##...", ".##...", "......"});
  Problem problem = problem_on(grid, model(), {0, 0}, {5, 3});
  const Vec2 open = problem.goal;
  const Vec2 wall{2.0, 2.0};  // a corner among four blocked cells
  problem.start = wall;
  EXPECT_EQ(code(problem), FaultCode::start_blocked);
  std::swap(problem.start, problem.goal);
  problem.start = open;
  EXPECT_EQ(code(problem), FaultCode::goal_blocked);
  const double huge = 1e300, nan = std::numeric_limits<double>::quiet_NaN();
  for (const Vec2 out :
       {Vec2{-1.0, 1.0}, Vec2{1.0, 7.0}, Vec2{huge, 1.0}, Vec2{1.0, -huge}, Vec2{nan, 1.0}}) {
    EXPECT_EQ(code({problem.grid, out, open}), FaultCode::outside_map);
    EXPECT_EQ(code({problem.grid, open, out}), FaultCode::outside_map);
  }
  EXPECT_EQ(code({nullptr, open, open}), FaultCode::bad_input);
}

TEST_P(PathContract, EnclosedStartOrGoal) {
  const auto grid = drawn({"......", ".###..", ".#.#..", ".###..", "......"});
  const Cell inside{2, 2}, outside{5, 0};
  EXPECT_EQ(code(problem_on(grid, model(), inside, outside)), FaultCode::no_path);
  EXPECT_EQ(code(problem_on(grid, model(), outside, inside)), FaultCode::no_path);
}

TEST_P(PathContract, NothingSqueezesBetweenDiagonalNeighbours) {
  const auto grid = drawn({"..#..", "..#..", "##...", ".....", "....."});
  const auto answer = plan(problem_on(grid, model(), {0, 4}, {4, 0}));
  ASSERT_FALSE(answer.has_value());
  EXPECT_EQ(answer.error().code, FaultCode::no_path);
}

TEST_P(PathContract, CorridorOneCellWideAndDeadEndStart) {
  const auto grid = drawn({
      "#########",
      "#.......#",
      "#######.#",
      "#.......#",
      "#.#######",
      "#.......#",
      "#########",
  });
  const Problem problem = problem_on(grid, model(), {1, 5}, {7, 1});
  const auto answer = plan(problem);
  ASSERT_TRUE(answer.has_value()) << answer.error().sentence;
  EXPECT_TRUE(check(*answer, problem).has_value());
  const double least = oracle::shortest(grid, model(), {1, 5}, {7, 1}, any_direction());
  if (row().steers) {  // the oracle knows legs, not arcs
    EXPECT_LE(length_of(*answer), 1.3 * least);
    return;
  }
  EXPECT_GE(answer->cost, least - tiny);
  EXPECT_LE(length_of(*answer), 1.1 * least);
}

TEST_P(PathContract, BudgetEnds) {
  const Problem problem = problem_on(drawn({"....", ".##.", ".#..", "...."}), model(), {0, 0}, {3, 3});
  Budget budget;
  budget.expansions = 0;
  EXPECT_EQ(code(problem, budget), FaultCode::budget_exhausted);
  const auto answer = plan(problem);
  ASSERT_TRUE(answer.has_value());
  budget.expansions = answer->counters.expansions - 1;
  EXPECT_EQ(code(problem, budget), FaultCode::budget_exhausted);
  budget.expansions = answer->counters.expansions;
  const auto within = plan(problem, budget);
  ASSERT_TRUE(within.has_value());
  EXPECT_EQ(*within, *answer);
  budget.wall_time = std::chrono::nanoseconds(0);
  EXPECT_EQ(code(problem, budget), FaultCode::budget_exhausted);
}

TEST_P(PathContract, Cancelled) {
  const Problem problem = problem_on(drawn({"....", "....", "...."}), model(), {0, 0}, {3, 2});
  std::stop_source source;
  Budget budget;
  budget.stop = source.get_token();
  EXPECT_TRUE(plan(problem, budget).has_value());
  source.request_stop();
  EXPECT_EQ(code(problem, budget), FaultCode::cancelled);
}

TEST_P(PathContract, RepeatsExactlyWhateverTheWorkspaceHeld) {
  Rng rng = Rng(7).child("repeat");
  const ConfiguredPlanner planner = row().configure();
  for (int i = 0; i < 100; ++i) {
    const auto grid = random_grid(rng, 24);
    const Cell start{static_cast<int>(rng.below(static_cast<std::uint64_t>(grid.frame.width))),
                     static_cast<int>(rng.below(static_cast<std::uint64_t>(grid.frame.height)))};
    const Problem problem = problem_on(grid, model(), start, {grid.frame.width - 1, grid.frame.height - 1});
    Workspace fresh;
    Trace trace;
    const auto first = planner.plan(problem, {}, fresh);
    auto again = planner.plan(problem, {}, workspace_);
    workspace_.trace = &trace;
    const auto traced = planner.plan(problem, {}, workspace_);
    workspace_.trace = nullptr;
    ASSERT_EQ(first.has_value(), again.has_value());
    ASSERT_EQ(first.has_value(), traced.has_value());
    if (!first) {
      EXPECT_EQ(first.error().sentence, again.error().sentence);
      continue;
    }
    if (row().incremental) {  // it says in its counters how much it did again
      EXPECT_LE(again->counters.expansions, first->counters.expansions);
      again->counters = first->counters;
    }
    EXPECT_EQ(*first, *again);
    EXPECT_EQ(*first, *traced);
    EXPECT_EQ(trace.expansions.size(), first->counters.expansions);
  }
}

/// Existence, legality, cost and bounds against the oracle.
TEST_P(PathContract, AgreesWithTheOracleOnRandomGrids) {
  Rng rng = Rng(11).child("oracle");
  const int most_side = any_direction() ? 7 : 12;
  int joined = 0;
  for (int i = 0; i < 5000; ++i) {
    const auto grid = random_grid(rng, most_side);
    const auto vertex = [&] {
      const int more = model() == GridModel::corners ? 1 : 0;
      return Cell{static_cast<int>(rng.below(static_cast<std::uint64_t>(grid.frame.width + more))),
                  static_cast<int>(rng.below(static_cast<std::uint64_t>(grid.frame.height + more)))};
    };
    const Cell start = vertex(), goal = vertex();
    const Problem problem = problem_on(grid, model(), start, goal);
    const auto answer = plan(problem);
    if (!oracle::place(grid, model(), start) || !oracle::place(grid, model(), goal)) {
      ASSERT_FALSE(answer.has_value());
      const bool at_start = !oracle::place(grid, model(), start);
      ASSERT_EQ(answer.error().code, at_start ? FaultCode::start_blocked : FaultCode::goal_blocked);
      continue;
    }
    const double least = oracle::shortest(grid, model(), start, goal, any_direction());
    if (!row().guarantee.complete && !answer && std::isfinite(least)) {
      ASSERT_EQ(answer.error().code, FaultCode::budget_exhausted) << "grid " << i;
      continue;
    }
    ASSERT_EQ(answer.has_value(), std::isfinite(least)) << "grid " << i;
    if (!answer) {
      ASSERT_EQ(answer.error().code, FaultCode::no_path);
      continue;
    }
    ++joined;
    const auto verdict = check(*answer, problem);
    ASSERT_TRUE(verdict.has_value()) << "grid " << i << ": " << to_string(verdict.error());
    if (row().steers) continue;  // the oracle knows legs, not arcs
    for (std::size_t k = 1; k < answer->vertices.size(); ++k) {
      ASSERT_TRUE(oracle::legal(grid, model(), answer->vertices[k - 1], answer->vertices[k])) << "grid " << i;
    }
    ASSERT_GE(answer->cost, least - tiny) << "grid " << i;
    if (shortest()) {
      ASSERT_LE(answer->cost, row().guarantee.most_ratio * least + tiny) << "grid " << i;
    }
    if (row().guarantee.measure == Measure::length) {
      ASSERT_LE(answer->lower_bound, least + tiny) << "grid " << i;
    }
  }
  EXPECT_GT(joined, 600);
}

/// The vertex v seen after the grid was turned by a quarter (and mirrored first when asked).
struct Turned {
  Grid<std::uint8_t> grid;
  Cell start, goal;
};
Turned turned(const Turned& from, bool mirror, GridModel model) {
  const int w = from.grid.frame.width, h = from.grid.frame.height;
  GridFrame frame = from.grid.frame;
  if (!mirror) std::swap(frame.width, frame.height);
  Turned to{Grid<std::uint8_t>(frame), {}, {}};
  const auto image = [&](Cell c, int last) {
    return mirror ? Cell{w - last - c.x, c.y} : Cell{h - last - c.y, c.x};
  };
  for (int y = 0; y < h; ++y) {
    for (int x = 0; x < w; ++x) to.grid[image({x, y}, 1)] = from.grid[{x, y}];
  }
  const int last = model == GridModel::cells ? 1 : 0;
  to.start = image(from.start, last);
  to.goal = image(from.goal, last);
  return to;
}

TEST_P(PathContract, MirroredAndTurnedGridsAreAnsweredAlike) {
  if (!row().guarantee.complete) GTEST_SKIP() << "it may miss a path that it finds on a turned grid";
  const bool optimal = shortest() && row().guarantee.most_ratio == 1.0;
  Rng rng = Rng(13).child("symmetry");
  for (int i = 0; i < 300; ++i) {
    Turned view{random_grid(rng, 16), {0, 0}, {}};
    view.goal = {view.grid.frame.width - 1, view.grid.frame.height - 1};
    view.grid[view.start] = view.grid[view.goal] = 0;
    const auto first = plan(problem_on(view.grid, model(), view.start, view.goal));
    for (int k = 0; k < 8; ++k) {
      view = turned(view, k == 4, model());
      const auto other = plan(problem_on(view.grid, model(), view.start, view.goal));
      ASSERT_EQ(first.has_value(), other.has_value());
      if (first && optimal) {
        ASSERT_NEAR(first->cost, other->cost, tiny);
      }
    }
    std::swap(view.start, view.goal);
    const auto back = plan(problem_on(view.grid, model(), view.start, view.goal));
    ASSERT_EQ(first.has_value(), back.has_value());
    if (first && optimal) {
      ASSERT_NEAR(first->cost, back->cost, tiny);
    }
  }
}

TEST_P(PathContract, OptionsDescribeThemselves) {
  const ConfiguredPlanner planner = row().configure();
  for (const Option& option : planner.options) {
    EXPECT_TRUE(assign(option, value_text(option)).has_value()) << option.name;
    EXPECT_FALSE(option.sentence.empty());
  }
}

TEST(PathCatalog, ModelsThatARowDoesNotTakeAreRefused) {
  for (const PathPlanner& planner : path_planners()) {
    for (const GridModel model : {GridModel::cells, GridModel::corners}) {
      if (planner.takes(model)) continue;
      Workspace workspace;
      const auto answer =
          planner.configure().plan(problem_on(drawn({"...", "..."}), model, {0, 0}, {2, 1}), {}, workspace);
      ASSERT_FALSE(answer.has_value()) << planner.name;
      EXPECT_EQ(answer.error().code, FaultCode::bad_input);
      EXPECT_NE(answer.error().sentence.find(to_string(model)), std::string::npos) << planner.name;
    }
  }
}

TEST(PathCatalog, RowsAreNamedDescribedAndDocumented) {
  std::set<std::string_view> names;
  for (const PathPlanner& planner : path_planners()) {
    EXPECT_TRUE(names.insert(planner.name).second) << planner.name;
    EXPECT_FALSE(planner.sentence.empty());
    EXPECT_FALSE(planner.paper.empty());
    EXPECT_FALSE(planner.guarantee.sentence.empty());
    EXPECT_GE(planner.guarantee.most_ratio, 1.0);
    const auto page =
        std::filesystem::path(OUTRIDER_SOURCE_DIR) / "docs/planners" / (std::string(planner.name) + ".md");
    EXPECT_TRUE(std::filesystem::exists(page)) << page;
    EXPECT_EQ(find_path_planner(planner.name)->name, planner.name);
  }
  const auto unknown = find_path_planner("a-star");
  ASSERT_FALSE(unknown.has_value());
  EXPECT_NE(unknown.error().sentence.find("a_star"), std::string::npos);
}

}  // namespace
}  // namespace outrider
