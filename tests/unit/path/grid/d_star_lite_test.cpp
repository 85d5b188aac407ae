#include "outrider/path/grid/d_star_lite.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "outrider/path/check.hpp"
#include "outrider/path/grid/a_star.hpp"
#include "outrider/path/grid/dijkstra.hpp"
#include "support/costly_cases.hpp"
#include "support/random_grid.hpp"

namespace outrider {
namespace {

using Ground = std::shared_ptr<const GridMap>;

Ground shared_map(const Grid<std::uint8_t>& grid, GridModel model) {
  return std::make_shared<const GridMap>(GridMap::of(grid, model).value());
}

int below(Rng& rng, int n) { return static_cast<int>(rng.below(static_cast<std::uint64_t>(n))); }

/// Closes and opens a few cells.
Ground changed(Rng& rng, const Ground& ground) {
  std::vector<CellChange> changes;
  for (std::uint64_t i = 1 + rng.below(4); i > 0; --i) {
    changes.push_back(
        {{below(rng, ground->frame.width), below(rng, ground->frame.height)}, 1, 1, rng.below(2) == 0});
  }
  return std::make_shared<const GridMap>(ground->with(changes).value());
}

Vec2 some_place(Rng& rng, const GridMap& ground) {
  const int more = ground.model == GridModel::corners ? 1 : 0;
  return ground.point({below(rng, ground.frame.width + more), below(rng, ground.frame.height + more)});
}

struct Incremental {
  const char* name;
  Outcome<Plan> (*plan)(const Problem&, const Budget&, Workspace&);
  bool from_goal;
};

const std::vector<Incremental> both = {
    {"d_star_lite", [](const Problem& p, const Budget& b, Workspace& w) { return d_star_lite(p, {}, b, w); },
     true},
    {"lpa_star", [](const Problem& p, const Budget& b, Workspace& w) { return lpa_star(p, {}, b, w); },
     false}};

class IncrementalOn : public ::testing::TestWithParam<std::tuple<std::size_t, GridModel>> {
 protected:
  [[nodiscard]] const Incremental& row() const { return both[std::get<0>(GetParam())]; }
  [[nodiscard]] GridModel model() const { return std::get<1>(GetParam()); }
};
INSTANTIATE_TEST_SUITE_P(Models, IncrementalOn,
                         ::testing::Combine(::testing::Values(0, 1),
                                            ::testing::Values(GridModel::cells, GridModel::corners)),
                         [](const auto& row) {
                           return std::string(both[std::get<0>(row.param)].name) + "_" +
                                  std::string(to_string(std::get<1>(row.param)));
                         });

void expect_as_new(const Outcome<Plan>& kept, const Problem& problem) {
  Workspace fresh;
  const auto truth = dijkstra(problem, {}, {}, fresh);
  ASSERT_EQ(kept.has_value(), truth.has_value());
  if (!kept) {
    ASSERT_EQ(kept.error().code, truth.error().code);
    return;
  }
  ASSERT_EQ(kept->cost, truth->cost);
  ASSERT_EQ(kept->lower_bound, kept->cost);
  ASSERT_TRUE(check(*kept, problem).has_value());
}

/// Cells close and open, the moving end moves, now and then the fixed one, and a budget ends some searches.
TEST_P(IncrementalOn, AnswersAsASearchAnewOverSequencesOfChanges) {
  Rng rng = Rng(31).child("sequences");
  int joined = 0, closed = 0, ended = 0;
  for (int i = 0; i < testing::costly_cases(300); ++i) {
    Ground ground = shared_map(i % 3 == 0 ? rooms(rng, 40) : random_grid(rng, 18), model());
    Workspace kept;
    Problem problem{ground, some_place(rng, *ground), some_place(rng, *ground)};
    for (int step = 0; step < 30; ++step) {
      if (rng.below(4) != 0) ground = changed(rng, ground);
      problem.grid = ground;
      Vec2& moving = row().from_goal ? problem.start : problem.goal;
      if (rng.below(2) == 0) moving = some_place(rng, *ground);
      if (rng.below(12) == 0) (row().from_goal ? problem.goal : problem.start) = some_place(rng, *ground);
      if (rng.below(4) == 0) {
        Budget little;
        little.expansions = rng.below(12);
        ended += row().plan(problem, little, kept) ? 0 : 1;
      }
      SCOPED_TRACE(::testing::Message() << "grid " << i << ", step " << step);
      const auto plan = row().plan(problem, {}, kept);
      expect_as_new(plan, problem);
      if (HasFatalFailure()) return;
      joined += plan ? 1 : 0;
      closed += !plan && plan.error().code == FaultCode::no_path ? 1 : 0;
    }
  }
  if (!testing::in_full()) return;
  EXPECT_GT(joined, 2000);
  EXPECT_GT(closed, 300);
  EXPECT_GT(ended, 300);
}

/// A new search expands what A* expands, of which it is a copy that is kept.
TEST_P(IncrementalOn, SearchesAnewAsAStarDoes) {
  Rng rng = Rng(32).child("anew");
  for (int i = 0; i < 300; ++i) {
    const Ground ground = shared_map(random_grid(rng, 24), model());
    Problem problem{ground, some_place(rng, *ground), some_place(rng, *ground)};
    Workspace one, other;
    const auto plan = row().plan(problem, {}, one);
    if (row().from_goal) std::swap(problem.start, problem.goal);
    const auto truth = a_star(problem, {}, {}, other);
    ASSERT_EQ(plan.has_value(), truth.has_value());
    if (!plan) continue;
    EXPECT_EQ(plan->cost, truth->cost);
    EXPECT_EQ(plan->counters.expansions, truth->counters.expansions) << "grid " << i;
  }
}

TEST_P(IncrementalOn, ARepeatedQueryExpandsNothing) {
  Rng rng = Rng(33).child("repeat");
  const Ground ground = shared_map(rooms(rng, 60), model());
  Workspace kept;
  for (int i = 0; i < 20; ++i) {
    const Problem problem{ground, some_place(rng, *ground), some_place(rng, *ground)};
    const auto first = row().plan(problem, {}, kept), again = row().plan(problem, {}, kept);
    ASSERT_EQ(first.has_value(), again.has_value());
    if (!first) continue;
    EXPECT_EQ(first->vertices, again->vertices);
    EXPECT_EQ(again->counters, PlanCounters{});
  }
}

TEST_P(IncrementalOn, ContinuesASearchThatItsBudgetEnded) {
  Rng rng = Rng(34).child("parts");
  Grid<std::uint8_t> grid = strewn(rng, 60, 60, 0.1);
  grid[{1, 1}] = grid[{57, 48}] = 0;
  const Ground ground = shared_map(grid, model());
  const Problem problem{ground, ground->point({1, 1}), ground->point({57, 48})};
  Workspace whole, parts;
  const auto all = row().plan(problem, {}, whole);
  ASSERT_TRUE(all.has_value());
  Budget some;
  some.expansions = all->counters.expansions / 3;
  ASSERT_EQ(row().plan(problem, some, parts).error().code, FaultCode::budget_exhausted);
  const auto rest = row().plan(problem, {}, parts);
  ASSERT_TRUE(rest.has_value());
  EXPECT_EQ(rest->vertices, all->vertices);
  EXPECT_EQ(rest->counters.expansions, all->counters.expansions - some.expansions);
}

/// A trace is of a whole search, and the same search is kept after it.
TEST_P(IncrementalOn, ATraceHasTheWholeSearch) {
  Rng rng = Rng(35).child("trace");
  Grid<std::uint8_t> grid = strewn(rng, 40, 40, 0.2);
  grid[{2, 2}] = grid[{37, 37}] = 0;
  const Ground ground = shared_map(grid, model());
  const Problem problem{ground, ground->point({2, 2}), ground->point({37, 37})};
  Workspace kept;
  const auto first = row().plan(problem, {}, kept);
  ASSERT_TRUE(first.has_value());
  Trace trace;
  kept.trace = &trace;
  EXPECT_EQ(row().plan(problem, {}, kept).value(), *first);
  EXPECT_EQ(trace.expansions.size(), first->counters.expansions);
  kept.trace = nullptr;
  EXPECT_EQ(row().plan(problem, {}, kept)->counters, PlanCounters{});
}

/// Drives to the goal over a map that it takes for empty, and corrects where it sees a cell. Returns the sum
/// of the expansions, with the search kept or anew at each step.
std::uint64_t drive(const GridMap& truth, bool keep, int& repairs) {
  Ground known = shared_map(Grid<std::uint8_t>(truth.frame), truth.model);
  Workspace kept;
  Cell at{1, 1};
  const Cell goal{truth.frame.width - 2, truth.frame.height - 2};
  std::uint64_t expansions = 0;
  repairs = 0;
  while (!(at == goal)) {
    std::vector<CellChange> seen;
    for (int y = std::max(0, at.y - 3); y <= std::min(truth.frame.height - 1, at.y + 3); ++y) {
      for (int x = std::max(0, at.x - 3); x <= std::min(truth.frame.width - 1, at.x + 3); ++x) {
        if (truth.blocked({x, y}) && !known->blocked({x, y})) seen.push_back({{x, y}});
      }
    }
    if (!seen.empty()) known = std::make_shared<const GridMap>(known->with(seen).value());
    repairs += seen.empty() ? 0 : 1;
    Workspace fresh;
    const auto plan = d_star_lite({known, known->point(at), known->point(goal)}, {}, {}, keep ? kept : fresh);
    if (!plan) break;
    expansions += plan->counters.expansions;
    const Cell next = plan->vertices[1];
    at = {at.x + std::clamp(next.x - at.x, -1, 1), at.y + std::clamp(next.y - at.y, -1, 1)};
    EXPECT_FALSE(truth.blocked(at));
  }
  return expansions;
}

TEST(DStarLite, ExpandsFarLessThanSearchesAnewOnADrive) {
  Rng rng = Rng(36).child("drive");
  std::uint64_t kept = 0, anew = 0;
  for (int i = 0; i < testing::costly_cases(10); ++i) {
    Grid<std::uint8_t> grid = strewn(rng, 80, 80, 0.2);
    grid[{1, 1}] = grid[{78, 78}] = 0;
    const GridMap truth = GridMap::of(grid, GridModel::cells).value();
    int repairs = 0;
    kept += drive(truth, true, repairs);
    anew += drive(truth, false, repairs);
    EXPECT_GT(repairs, 20);
  }
  EXPECT_LT(5 * kept, anew);
  RecordProperty("kept", std::to_string(kept));
  RecordProperty("anew", std::to_string(anew));
}

TEST(LpaStar, RepairsOnlyWhatAChangeTouches) {
  Rng rng = Rng(37).child("repair");
  std::uint64_t kept = 0, anew = 0;
  Grid<std::uint8_t> grid = strewn(rng, 100, 100, 0.2);
  grid[{2, 2}] = grid[{97, 97}] = 0;
  Ground ground = shared_map(grid, GridModel::cells);
  const Problem asked{ground, ground->point({2, 2}), ground->point({97, 97})};
  Workspace workspace;
  ASSERT_TRUE(lpa_star(asked, {}, {}, workspace).has_value());
  for (int step = 0; step < 100; ++step) {
    ground = changed(rng, ground);
    Workspace fresh;
    const Problem problem{ground, asked.start, asked.goal};
    const auto plan = lpa_star(problem, {}, {}, workspace), truth = lpa_star(problem, {}, {}, fresh);
    ASSERT_EQ(plan.has_value(), truth.has_value());
    if (!plan) continue;
    kept += plan->counters.expansions;
    anew += truth->counters.expansions;
  }
  EXPECT_LT(5 * kept, anew);
  RecordProperty("kept", std::to_string(kept));
  RecordProperty("anew", std::to_string(anew));
}

}  // namespace
}  // namespace outrider
