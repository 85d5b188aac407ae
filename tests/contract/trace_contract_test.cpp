// Every row of the catalogue tells a Trace its whole queue, or nothing because it looks its answer up.
#include <gtest/gtest.h>

#include <algorithm>
#include <map>

#include "outrider/path/catalog.hpp"
#include "support/random_grid.hpp"

namespace outrider {
namespace {

constexpr double tiny = 1e-9;

struct Traced {
  Outcome<Plan> plan;
  Trace trace;
};

Traced traced(const PathPlanner& row, const Problem& problem) {
  Traced answer{bad_input(""), {}};
  Workspace workspace;
  workspace.trace = &answer.trace;
  answer.plan = row.configure().plan(problem, {}, workspace);
  return answer;
}

/// Returns where the searches of one answer begin: at the expansions whose parent is the state itself.
std::vector<std::size_t> beginnings(const Trace& trace) {
  std::vector<std::size_t> places;
  for (std::size_t i = 0; i < trace.expansions.size(); ++i) {
    if (trace.expansions[i].parent == trace.expansions[i].state && trace.expansions[i].g == 0.0)
      places.push_back(i);
  }
  return places;
}

/// Nothing leaves a queue that was not put there before, and nobody's parent comes after it.
void expect_a_search(const Trace& trace) {
  std::map<std::uint32_t, std::uint32_t> met;
  for (const Opening& opening : trace.openings) {
    const auto [first, is_new] = met.try_emplace(opening.state, opening.after);
    EXPECT_TRUE(is_new || opening.after > first->second) << "told again in the same search";
  }
  std::map<std::uint32_t, double> closed;
  for (std::size_t i = 0; i < trace.expansions.size(); ++i) {
    const Expansion& expansion = trace.expansions[i];
    const auto opened = met.find(expansion.state);
    ASSERT_NE(opened, met.end()) << "state " << expansion.state << " was never put into the queue";
    EXPECT_LE(opened->second, i);
    if (expansion.parent != expansion.state) {
      const auto parent = closed.find(expansion.parent);
      ASSERT_NE(parent, closed.end());
      EXPECT_LE(parent->second, expansion.g + tiny);
    }
    closed[expansion.state] = expansion.g;
  }
}

TEST(TraceContract, PlannersOnGridsTellTheirQueue) {
  Rng rng = Rng(5).child("trace");
  for (int i = 0; i < 60; ++i) {
    const auto grid = random_grid(rng, 20);
    for (const PathPlanner& row : path_planners()) {
      for (const GridModel model : row.models) {
        SCOPED_TRACE(std::string(row.name) + " on " + std::string(to_string(model)) + " of grid " +
                     std::to_string(i));
        auto ground = GridMap::of(grid, model);
        ASSERT_TRUE(ground.has_value());
        const auto shared = std::make_shared<const GridMap>(std::move(*ground));
        const Cell far{grid.frame.width - 1, grid.frame.height - 1};
        const auto [plan, trace] = traced(row, {shared, shared->point({0, 0}), shared->point(far)});
        EXPECT_EQ(trace.places.empty(), !row.steers || trace.openings.empty());
        if (row.tells == TraceKind::lookup) {
          EXPECT_LE(trace.expansions.size(), 1U);
          EXPECT_TRUE(trace.openings.empty());
          continue;
        }
        ASSERT_EQ(row.tells, TraceKind::search);
        expect_a_search(trace);
        if (!plan) continue;
        EXPECT_EQ(trace.expansions.size(), plan->counters.expansions);
        if (row.steers) {
          const TracePlace last = trace.places[trace.expansions.back().state];
          EXPECT_EQ((Vec2{last.x, last.y}), shared->point(far));
          EXPECT_LE(plan->cost,
                    trace.expansions.back().g * grid.frame.resolution_m + tiny);  // it is shortened
        } else if (row.name == "polyanya") {  // it ends at the vertex that sees the goal
          EXPECT_NEAR(trace.expansions.back().f * grid.frame.resolution_m, plan->cost, tiny);
        } else {
          const Cell last = row.name == "d_star_lite" ? plan->vertices.front() : plan->vertices.back();
          EXPECT_EQ(trace.expansions.back().state, shared->index(last));
        }
      }
    }
  }
}

TEST(TraceContract, PlannersOnPolygonsTellWhereTheirStatesAre) {
  const std::vector<Vec2> room{{-5, -4}, {5, -4}, {5, 4}, {-5, 4}};
  const std::vector<std::vector<Vec2>> obstacles{{{-2, -1}, {-1, -1}, {-1, 3}, {-2, 3}},
                                                 {{1, -3}, {2, -3}, {2, 1}, {1, 1}},
                                                 {{-0.5, -2.5}, {0.5, -2.5}, {0, -1.5}}};
  auto of = PolygonGround::of(room, obstacles, 0.2);
  ASSERT_TRUE(of.has_value());
  const auto ground = std::make_shared<const PolygonGround>(std::move(*of));
  const Problem problem{nullptr, {-4, 0}, {4, 0}, ground};
  for (const PathPlanner& row : path_planners()) {
    if (!row.polygons) continue;
    SCOPED_TRACE(row.name);
    const auto [plan, trace] = traced(row, problem);
    ASSERT_TRUE(plan.has_value());
    EXPECT_EQ(*plan, *row.configure().plan(problem, {}, *std::make_unique<Workspace>()));
    expect_a_search(trace);
    EXPECT_EQ(trace.expansions.size(), plan->counters.expansions);
    for (const Expansion& e : trace.expansions) ASSERT_LT(std::max(e.state, e.parent), trace.places.size());
    for (const Opening& opening : trace.openings) ASSERT_LT(opening.state, trace.places.size());
    for (const TracePlace& p : trace.places) {
      EXPECT_TRUE(ground->point_free({p.x, p.y})) << "(" << p.x << ", " << p.y << ")";
    }
    EXPECT_FALSE(beginnings(trace).empty());
  }
}

/// The searches of the visibility graph begin at the start and end at the goal.
TEST(TraceContract, AWayFromTheGoalLeadsBackToTheStart) {
  const std::vector<Vec2> room{{0, 0}, {8, 0}, {8, 6}, {0, 6}};
  auto of =
      PolygonGround::of(room, {{{3, 0}, {4, 0}, {4, 4}, {3, 4}}, {{5, 2}, {6, 2}, {6, 6}, {5, 6}}}, 0.3);
  ASSERT_TRUE(of.has_value());
  const Problem problem{nullptr, {1, 1}, {7, 5}, std::make_shared<const PolygonGround>(std::move(*of))};
  for (const char* name :
       {"visibility_graph", "visibility_graph_reduced", "visibility_graph_implicit", "least_time"}) {
    const auto [plan, trace] = traced(*find_path_planner(name), problem);
    ASSERT_TRUE(plan.has_value());
    std::map<std::uint32_t, std::uint32_t> parents;
    for (const Expansion& e : trace.expansions) parents[e.state] = e.parent;
    std::uint32_t state = trace.expansions.back().state;
    EXPECT_EQ(trace.places[state], (TracePlace{7, 5})) << name;
    EXPECT_NEAR(trace.expansions.back().g, plan->lower_bound, 1e-6) << name;
    std::size_t legs = 0;
    for (; parents.at(state) != state; state = parents.at(state)) ++legs;
    EXPECT_EQ(trace.places[state], (TracePlace{1, 1})) << name;
    EXPECT_GE(legs, 3U) << name;
  }
}

TEST(TraceContract, OnlyThatWhichLooksUpTellsNothing) {
  for (const PathPlanner& row : path_planners()) {
    EXPECT_EQ(row.tells == TraceKind::lookup,
              row.name == "hub_labels" || row.name == "octile_labels" || row.name == "terrain_labels")
        << row.name;
  }
}

}  // namespace
}  // namespace outrider
