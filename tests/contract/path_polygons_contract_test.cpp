// The laws that every row of the catalogue which takes polygons keeps on them; path_contract_test.cpp has
// those on grids.
#include <gtest/gtest.h>

#include <cmath>

#include "outrider/path/catalog.hpp"
#include "outrider/path/check.hpp"
#include "support/random_cases.hpp"
#include "unit/path/tangent_oracle.hpp"

namespace outrider {
namespace {

using testing::PolygonWorld;

std::shared_ptr<const PolygonGround> ground_of(const PolygonWorld& world) {
  auto ground = PolygonGround::of(world.boundary, world.obstacles, world.radius_m);
  EXPECT_TRUE(ground.has_value()) << ground.error().sentence;
  return std::make_shared<const PolygonGround>(std::move(*ground));
}

/// A wall with a slit of that width.
PolygonWorld slit(double width, double radius) {
  PolygonWorld world;
  world.boundary = {{-5, -5}, {5, -5}, {5, 5}, {-5, 5}};
  world.obstacles = {{{-0.5, -5}, {0.5, -5}, {0.5, 0}, {-0.5, 0}},
                     {{-0.5, width}, {0.5, width}, {0.5, 5}, {-0.5, 5}}};
  world.radius_m = radius;
  return world;
}

class PolygonContract : public ::testing::TestWithParam<std::size_t> {
 protected:
  /// Sampling planners take a few points, so that the test ends soon.
  static ConfiguredPlanner configured() {
    ConfiguredPlanner planner = path_planners()[GetParam()].configure();
    for (const Option& option : planner.options) {
      if (option.name != "iterations") continue;
      EXPECT_TRUE(assign(option, "500").has_value());
    }
    return planner;
  }
  Outcome<Plan> plan(const Problem& problem, const Budget& budget = {}) {
    return configured().plan(problem, budget, workspace_);
  }
  FaultCode code(const Problem& problem, const Budget& budget = {}) {
    const auto answer = plan(problem, budget);
    EXPECT_FALSE(answer.has_value());
    return answer ? FaultCode::no_shot : answer.error().code;
  }
  Workspace workspace_;
  std::shared_ptr<const PolygonGround> ground_ = ground_of(slit(1.0, 0.2));
};

std::vector<std::size_t> rows_on_polygons() {
  std::vector<std::size_t> rows;
  for (std::size_t i = 0; i < path_planners().size(); ++i) {
    if (path_planners()[i].polygons) rows.push_back(i);
  }
  return rows;
}
std::string name_of(const ::testing::TestParamInfo<std::size_t>& row) {
  return std::string(path_planners()[row.param].name);
}
INSTANTIATE_TEST_SUITE_P(Rows, PolygonContract, ::testing::ValuesIn(rows_on_polygons()), name_of);

TEST_P(PolygonContract, StartIsGoal) {
  const Problem problem{nullptr, {-3, 1}, {-3, 1}, ground_};
  const auto answer = plan(problem);
  ASSERT_TRUE(answer.has_value());
  EXPECT_EQ(answer->waypoints, std::vector<Vec2>{problem.start});
  EXPECT_EQ(answer->cost, 0.0);
  EXPECT_TRUE(check(*answer, problem).has_value());
}

TEST_P(PolygonContract, BlockedOutsideOrAnotherGround) {
  const Vec2 open{3, 1};
  EXPECT_EQ(code({nullptr, {0, -2}, open, ground_}), FaultCode::start_blocked);
  EXPECT_EQ(code({nullptr, open, {0, -2}, ground_}), FaultCode::goal_blocked);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const Vec2 out : {Vec2{6, 0}, Vec2{0, -1e300}, Vec2{nan, 0}}) {
    EXPECT_EQ(code({nullptr, out, open, ground_}), FaultCode::outside_map);
    EXPECT_EQ(code({nullptr, open, out, ground_}), FaultCode::outside_map);
  }
  const auto near = plan({nullptr, {-0.6, -2}, open, ground_});
  ASSERT_FALSE(near.has_value());
  EXPECT_EQ(near.error().code, FaultCode::start_blocked);
  EXPECT_NE(near.error().sentence.find("is 0.1 m from"), std::string::npos) << near.error().sentence;
  EXPECT_EQ(code({nullptr, open, open}), FaultCode::bad_input);
}

TEST_P(PolygonContract, BudgetCancellationAndRepeats) {
  const Problem problem{nullptr, {-3, 3}, {3, -3}, ground_};
  const auto answer = plan(problem);
  ASSERT_TRUE(answer.has_value()) << answer.error().sentence;
  Budget budget;
  budget.expansions = answer->counters.expansions;
  EXPECT_EQ(*plan(problem, budget), *answer);
  --budget.expansions;
  EXPECT_EQ(code(problem, budget), FaultCode::budget_exhausted);
  budget.expansions = 0;
  EXPECT_EQ(code(problem, budget), FaultCode::budget_exhausted);
  std::stop_source source;
  source.request_stop();
  Budget stopped;
  stopped.stop = source.get_token();
  EXPECT_EQ(code(problem, stopped), FaultCode::cancelled);
  Workspace fresh;
  Trace trace;
  fresh.trace = &trace;
  EXPECT_EQ(*configured().plan(problem, {}, fresh), *answer);
  if (path_planners()[GetParam()].tells == TraceKind::search) {
    EXPECT_EQ(trace.expansions.size(), answer->counters.expansions);
  }
  const bool complete = path_planners()[GetParam()].guarantee_on(true).complete;
  EXPECT_EQ(code({nullptr, {-3, 3}, {3, -3}, ground_of(slit(0.1, 0.2))}),
            complete ? FaultCode::no_path : FaultCode::budget_exhausted);
  EXPECT_EQ(*plan(problem), *answer);  // after another ground
}

/// A question about a small world, with the least length by brute force: negative where an end is blocked,
/// infinite where nothing joins them.
struct Question {
  PolygonWorld world;
  Problem problem;
  double least_m = 0.0;
};

const std::vector<Question>& questions() {
  static const std::vector<Question> all = [] {
    Rng rng = Rng(61).child("polygon laws");
    std::vector<Question> made;
    for (int i = 0; i < testing::cases(80); ++i) {
      Question q;
      q.world = rng.below(2) == 0 ? testing::lattice_world(rng, 3, 0.25) : testing::scattered_world(rng, 2);
      q.problem = {nullptr, testing::random_place(rng, q.world), testing::random_place(rng, q.world),
                   ground_of(q.world)};
      if (q.problem.start == q.problem.goal) continue;
      q.least_m = testing::TangentOracle{q.world}.shortest(q.problem.start, q.problem.goal);
      made.push_back(std::move(q));
    }
    return made;
  }();
  return all;
}

/// Returns the price of a path by the weights of time: its length and its turning; the first turn is free.
double priced(const Plan& path, const CostWeights& weights) {
  double turning_rad = 0.0;
  for (std::size_t i = 0; i < path.pieces.size(); ++i) {
    turning_rad += std::abs(path.pieces[i].turn_rad);
    if (i > 0) turning_rad += turn_between(path.pieces[i - 1], path.pieces[i]);
  }
  return weights.per_m * length_of(path) + weights.per_rad * turning_rad;
}

/// An answer that brute force says there is.
void expect_lawful(const PathPlanner& row, const Question& q, const Plan& plan, Workspace& workspace) {
  const auto verdict = check(plan, q.problem);
  ASSERT_TRUE(verdict.has_value()) << to_string(verdict.error());
  const double slack_m = 1e-6 * std::max(1.0, q.least_m);
  EXPECT_GE(length_of(plan), q.least_m - slack_m);
  EXPECT_LE(plan.lower_bound, plan.cost + slack_m);
  const Guarantee& guarantee = row.guarantee_on(true);
  if (guarantee.among == PathClass::widest_curve) {  // whose least is that of the widest paths
    EXPECT_NEAR(plan.lower_bound, plan.cost, slack_m);
    return;
  }
  if (guarantee.measure == Measure::length) {
    EXPECT_LE(plan.lower_bound, q.least_m + slack_m);
  }
  if (!std::isfinite(guarantee.most_ratio)) return;
  if (guarantee.measure == Measure::length) {
    EXPECT_LE(plan.cost, guarantee.most_ratio * q.least_m + slack_m);
  } else {  // no slower than the shortest path may be, and no faster than straight along it
    const auto shortest =
        find_path_planner("visibility_graph_implicit")->configure().plan(q.problem, {}, workspace);
    ASSERT_TRUE(shortest.has_value());
    EXPECT_LE(plan.cost, guarantee.most_ratio * priced(*shortest, plan.weights) + slack_m);
    EXPECT_GE(plan.cost, plan.weights.per_m * (q.least_m - slack_m));
  }
}

TEST_P(PolygonContract, AgreesWithBruteForceOnRandomWorlds) {
  const PathPlanner& row = path_planners()[GetParam()];
  int joined = 0;
  for (std::size_t i = 0; i < questions().size(); ++i) {
    SCOPED_TRACE(i);
    const Question& q = questions()[i];
    const auto answer = plan(q.problem);
    Workspace fresh;
    const auto again = configured().plan(q.problem, {}, fresh);
    ASSERT_EQ(answer.has_value(), again.has_value());
    if (q.least_m < 0.0) {
      ASSERT_FALSE(answer.has_value());
      const FaultCode why = answer.error().code;
      EXPECT_TRUE(why == FaultCode::start_blocked || why == FaultCode::goal_blocked ||
                  why == FaultCode::outside_map)
          << answer.error().sentence;
    } else if (answer) {
      ASSERT_TRUE(std::isfinite(q.least_m)) << "a path where there is none";
      ++joined;
      EXPECT_EQ(*answer, *again);
      expect_lawful(row, q, *answer, workspace_);
    } else if (row.guarantee_on(true).complete) {
      ASSERT_FALSE(std::isfinite(q.least_m)) << answer.error().sentence;
      EXPECT_EQ(answer.error().code, FaultCode::no_path);
    } else {
      EXPECT_EQ(answer.error().code, FaultCode::budget_exhausted);
    }
  }
  EXPECT_GT(joined, 15);
}

TEST(PolygonGrid, PlannersOnGridsRefusePolygonsInASentence) {
  const auto ground = ground_of(slit(1.0, 0.2));
  for (const PathPlanner& row : path_planners()) {
    if (row.polygons) continue;
    Workspace workspace;
    const auto answer = row.configure().plan({nullptr, {-3, 3}, {3, -3}, ground}, {}, workspace);
    ASSERT_FALSE(answer.has_value()) << row.name;
    EXPECT_EQ(answer.error().code, FaultCode::bad_input);
    EXPECT_NE(answer.error().sentence.find("polygons"), std::string::npos);
  }
}

TEST(PathCatalog, EveryRowTakesAGround) {
  for (const PathPlanner& row : path_planners()) {
    EXPECT_TRUE(row.polygons || !row.models.empty()) << row.name;  // so one of the contracts walks it
  }
}

}  // namespace
}  // namespace outrider
