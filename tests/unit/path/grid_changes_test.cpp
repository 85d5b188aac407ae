// A ground that is changed, and what was made for it, against both made anew.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "grid/jps/jps_index.hpp"
#include "grid/jps/jps_map.hpp"
#include "hubs/hub_kept.hpp"
#include "outrider/path/catalog.hpp"
#include "outrider/path/check.hpp"
#include "outrider/path/grid/dijkstra.hpp"
#include "outrider/path/hubs/any_angle/hub_labels.hpp"
#include "outrider/path/hubs/octile/octile_labels.hpp"
#include "outrider/path/mesh/polyanya/polyanya.hpp"
#include "support/costly_cases.hpp"
#include "support/grid_oracle.hpp"
#include "support/random_cases.hpp"
#include "support/random_grid.hpp"

namespace outrider {
namespace {

CellChange random_change(Rng& rng, const GridFrame& frame) {
  const auto below = [&rng](int n) { return static_cast<int>(rng.below(static_cast<std::uint64_t>(n))); };
  CellChange change{{below(frame.width), below(frame.height)}, 1, 1, rng.below(2) == 0};
  if (rng.below(3) == 0) {
    change.width = 1 + below(std::min(3, frame.width - change.low.x));
    change.height = 1 + below(std::min(3, frame.height - change.low.y));
  }
  return change;
}

std::vector<CellChange> random_changes(Rng& rng, const GridFrame& frame) {
  std::vector<CellChange> changes(1 + rng.below(3));
  for (CellChange& change : changes) change = random_change(rng, frame);
  return changes;
}

void apply(Grid<std::uint8_t>& grid, const std::vector<CellChange>& changes) {
  for (const auto& [low, width, height, blocked] : changes) {
    for (int y = low.y; y < low.y + height; ++y) {
      for (int x = low.x; x < low.x + width; ++x) grid[{x, y}] = blocked ? 1 : 0;
    }
  }
}

std::shared_ptr<const GridMap> shared(const Outcome<GridMap>& ground) {
  return std::make_shared<const GridMap>(ground.value());
}

class ChangesIn : public ::testing::TestWithParam<GridModel> {};
INSTANTIATE_TEST_SUITE_P(Models, ChangesIn, ::testing::Values(GridModel::cells, GridModel::corners),
                         [](const auto& model) { return std::string(to_string(model.param)); });

TEST_P(ChangesIn, AChangedGroundIsTheSameAsOneMadeAnew) {
  Rng rng = Rng(21).child("ground");
  for (int i = 0; i < testing::cases(300); ++i) {
    auto grid = random_grid(rng, 14);
    auto ground = GridMap::of(grid, GetParam()).value();
    for (int step = 0; step < 8; ++step) {
      const auto changes = random_changes(rng, grid.frame);
      const auto before = grid;
      apply(grid, changes);
      auto changed = ground.with(changes).value();
      const auto anew = GridMap::of(grid, GetParam()).value();
      ASSERT_EQ(changed.marks, anew.marks) << "grid " << i << ", step " << step;
      ASSERT_EQ(changed.moves, anew.moves) << "grid " << i << ", step " << step;
      std::vector<Cell> differing;
      for (std::size_t c = 0; c < grid.cells.size(); ++c) {
        if (grid.cells[c] != before.cells[c]) differing.push_back(grid.frame.cell(c));
      }
      ASSERT_EQ(cells_changed(ground, changed, grid.cells.size()), differing);
      const std::size_t too_few = differing.size() - (differing.empty() ? 0 : 1);
      ASSERT_EQ(cells_changed(ground, changed, too_few).has_value(), differing.empty());
      ground = std::move(changed);
    }
  }
}

/// Status, path, cost and bound, and the work done: all of an answer.
void expect_same(const Outcome<Plan>& followed, const Outcome<Plan>& anew) {
  ASSERT_EQ(followed.has_value(), anew.has_value());
  if (followed) {
    ASSERT_EQ(*followed, *anew);
  } else {
    ASSERT_EQ(followed.error().code, anew.error().code);
    ASSERT_EQ(followed.error().sentence, anew.error().sentence);
  }
}

/// Expects the same status, cost and bound; the path may be another one of the same length.
void expect_as_long(const Outcome<Plan>& followed, const Outcome<Plan>& anew) {
  if (!followed || !anew) return expect_same(followed, anew);
  ASSERT_NEAR(followed->cost, anew->cost, 1e-12 * anew->cost);
  ASSERT_EQ(followed->lower_bound, followed->cost);
}

/// One workspace for each planner over all changes, against a new one after each.
TEST_P(ChangesIn, EveryPlannerAnswersAsItDoesAnew) {
  Rng rng = Rng(22).child("planners");
  std::vector<std::pair<PathPlanner, ConfiguredPlanner>> planners;
  for (const PathPlanner& row : path_planners()) {
    if (!row.polygons && row.takes(GetParam())) planners.emplace_back(row, row.configure());
  }
  for (int i = 0; i < testing::cases(60); ++i) {
    auto grid = random_grid(rng, i % 6 == 0 ? 48 : 16);
    auto ground = shared(GridMap::of(grid, GetParam()));
    std::vector<Workspace> kept(planners.size());
    for (int step = 0; step < 6; ++step) {
      if (step == 3) {  // a map of its own, of another size as a rule
        grid = random_grid(rng, 16);
        ground = shared(GridMap::of(grid, GetParam()));
      }
      const auto changes = random_changes(rng, grid.frame);
      apply(grid, changes);
      ground = shared(ground->with(changes));
      const auto anew = shared(GridMap::of(grid, GetParam()));
      const auto point = [&] {
        return Vec2{rng.uniform(0, grid.frame.width), rng.uniform(0, grid.frame.height)};
      };
      Problem on_changed{ground, point(), point()};
      Problem on_new{anew, on_changed.start, on_changed.goal};
      for (std::size_t p = 0; p < planners.size(); ++p) {
        SCOPED_TRACE(::testing::Message() << planners[p].first.name << " on grid " << i << ", step " << step);
        Workspace fresh;
        const auto plan = planners[p].second.plan(on_changed, {}, kept[p]);
        const auto truth = planners[p].second.plan(on_new, {}, fresh);
        const std::string_view name = planners[p].first.name;
        const bool other_paths = name == "polyanya" || name == "hub_labels" || name == "octile_labels" ||
                                 name == "jps" || name == "jps_plus" || name == "terrain_labels" ||
                                 planners[p].first.incremental;
        other_paths ? expect_as_long(plan, truth) : expect_same(plan, truth);
        ASSERT_TRUE(!plan || check(*plan, on_new));
      }
    }
  }
}

TEST(GridChanges, BitsAndDistancesAreThoseMadeAnew) {
  Rng rng = Rng(23).child("indices");
  for (int i = 0; i < testing::cases(400); ++i) {
    auto grid = random_grid(rng, i % 4 == 0 ? 90 : 20);
    auto ground = GridMap::of(grid, GridModel::cells).value();
    jump::Map map = jump::map_of(ground);
    auto distances = jump::distances_of(ground);
    for (int step = 0; step < 8; ++step) {
      const auto changed = ground.with(random_changes(rng, grid.frame)).value();
      const auto cells = cells_changed(ground, changed, grid.cells.size()).value();
      jump::rewrite(map, changed, cells);
      jump::walk_again(distances, changed, cells);
      ground = changed;
      const jump::Map anew = jump::map_of(ground);
      for (unsigned d = 0; d < 4; ++d) ASSERT_EQ(map.lines[d].bits, anew.lines[d].bits) << "grid " << i;
      ASSERT_EQ(distances, jump::distances_of(ground)) << "grid " << i << ", step " << step;
    }
  }
}

/// The planners that keep an index on a changed ground: in any direction, and along the moves.
class KeptIndex : public ::testing::TestWithParam<GridModel> {
 protected:
  [[nodiscard]] bool any_direction() const { return GetParam() == GridModel::corners; }
  Outcome<Plan> look_up(const Problem& problem, Workspace& workspace) const {
    return any_direction() ? hub_labels(problem, {}, {}, workspace)
                           : octile_labels(problem, {}, {}, workspace);
  }
  /// The search on a new workspace.
  Outcome<Plan> search(const Problem& problem) const {
    Workspace fresh;
    return any_direction() ? polyanya(problem, {}, {}, fresh) : dijkstra(problem, {}, {}, fresh);
  }
};
INSTANTIATE_TEST_SUITE_P(Models, KeptIndex, ::testing::Values(GridModel::cells, GridModel::corners),
                         [](const auto& model) { return std::string(to_string(model.param)); });

/// Queries over all pairs of some vertices after each change: the index is asked where it was never made.
TEST_P(KeptIndex, TellsTheShortestPathOverAllVertices) {
  Rng rng = Rng(24).child("kept index");
  int by_index = 0, by_search = 0, closed = 0;
  for (int i = 0; i < testing::costly_cases(400); ++i) {
    auto grid = random_grid(rng, 14);
    auto ground = shared(GridMap::of(grid, GetParam()));
    Workspace workspace;
    for (int step = 0; step < 6; ++step) {
      for (int k = 0; k < 6; ++k) {
        const Cell start{static_cast<int>(rng.below(15)), static_cast<int>(rng.below(15))};
        const Cell goal{static_cast<int>(rng.below(15)), static_cast<int>(rng.below(15))};
        if (!ground->place(start) || !ground->place(goal)) continue;
        const Problem problem{ground, ground->point(start), ground->point(goal)};
        const auto plan = look_up(problem, workspace);
        const double least = oracle::shortest(grid, GetParam(), start, goal, any_direction());
        ASSERT_EQ(plan.has_value(), std::isfinite(least)) << "grid " << i << ", step " << step;
        closed += plan ? 0 : 1;
        if (!plan) continue;
        ASSERT_NEAR(plan->cost, least, 1e-12 * std::max(1.0, least)) << "grid " << i << ", step " << step;
        ASSERT_TRUE(check(*plan, problem));
        if (plan->vertices.size() > 2) ++(plan->counters.generated == 0 ? by_index : by_search);
      }
      const std::vector<CellChange> changes{random_change(rng, grid.frame)};
      apply(grid, changes);
      ground = shared(ground->with(changes));
    }
  }
  if (!testing::in_full()) return;
  EXPECT_GT(by_index, 300);
  EXPECT_GT(by_search, 30);
  EXPECT_GT(closed, 100);
}

/// Larger grids, where most changes leave most paths alone.
TEST_P(KeptIndex, AgreesWithASearch) {
  Rng rng = Rng(25).child("kept index of rooms");
  int by_index = 0, by_search = 0;
  for (int i = 0; i < testing::costly_cases(40); ++i) {
    auto grid = random_grid(rng, 48);
    auto ground = shared(GridMap::of(grid, GetParam()));
    Workspace workspace;
    for (int step = 0; step < 25; ++step) {
      for (int k = 0; k < 8; ++k) {
        const auto point = [&] {
          return Vec2{rng.uniform(0, grid.frame.width), rng.uniform(0, grid.frame.height)};
        };
        const Problem problem{ground, point(), point()};
        const auto plan = look_up(problem, workspace);
        expect_as_long(plan, search(problem));
        ASSERT_FALSE(HasFatalFailure()) << "grid " << i << ", step " << step;
        ASSERT_TRUE(!plan || check(*plan, problem));
        if (plan && plan->vertices.size() > 2) ++(plan->counters.generated == 0 ? by_index : by_search);
      }
      const auto changes = random_changes(rng, grid.frame);
      apply(grid, changes);
      ground = shared(ground->with(changes));
    }
  }
  if (!testing::in_full()) return;
  EXPECT_GT(by_index, 1000);
  EXPECT_GT(by_search, 200);
}

TEST(GridChanges, BoxesOfFreedCellsAreThoseCellsAndNoOthers) {
  Rng rng = Rng(26).child("boxes");
  for (int i = 0; i < testing::cases(300); ++i) {
    const auto grid = random_grid(rng, 12);
    const auto ground = GridMap::of(grid, GridModel::corners).value();
    std::vector<Cell> changed;
    Grid<int> covered(grid.frame);
    for (std::size_t c = 0; c < grid.cells.size(); ++c) {
      if (rng.below(2) == 0) changed.push_back(grid.frame.cell(c));
      covered.cells[c] = 0;
    }
    for (const auto& [low, high] : hub_labelling::freed_boxes(ground, changed)) {
      for (int y = low.y; y < high.y; ++y) {
        for (int x = low.x; x < high.x; ++x) ++covered[{x, y}];
      }
    }
    for (const Cell c : changed) covered[c] -= ground.blocked(c) ? 0 : 1;
    ASSERT_EQ(std::count(covered.cells.begin(), covered.cells.end(), 0), std::ssize(covered.cells));
  }
  const auto open = GridMap::of(drawn({"....", "...."}), GridModel::corners).value();
  using hub_labelling::CellBox;
  EXPECT_EQ(hub_labelling::freed_boxes(open, {{1, 0}, {2, 0}, {1, 1}, {2, 1}}),
            (std::vector<CellBox>{{{1, 0}, {3, 2}}}));
  const std::vector<CellBox> box{{{3, 4}, {5, 6}}};
  EXPECT_EQ(hub_labelling::least_length_over(box, {0, 0}, {5, 9}), 8.0);
  // From the centre of (0, 0): 2.5 by 3.5 cells to the box; to that of (5, 9): 0.5 by 3.5.
  EXPECT_TRUE(hub_labelling::none_shorter_over(box, {0, 0}, {5, 9}, {4, 3}));
  EXPECT_FALSE(hub_labelling::none_shorter_over(box, {0, 0}, {5, 9}, {5, 3}));
  EXPECT_TRUE(hub_labelling::none_shorter_over({}, {0, 0}, {5, 9}, {50, 3}));
}

TEST(GridChanges, WhatLeavesTheGridIsRefused) {
  const auto ground = GridMap::of(drawn({"...", "..."}), GridModel::cells).value();
  const int most = std::numeric_limits<int>::max();
  for (const CellChange& change : {CellChange{{3, 0}}, CellChange{{0, -1}}, CellChange{{1, 0}, 3, 1},
                                   CellChange{{0, 1}, 1, 2}, CellChange{{2, 1}, most, most}}) {
    const auto changed = ground.with({change});
    ASSERT_FALSE(changed);
    EXPECT_EQ(changed.error().code, FaultCode::bad_input);
    EXPECT_NE(changed.error().sentence.find("leaves the grid"), std::string::npos);
  }
  const auto empty = ground.with({{{0, 0}, 0, 1}});
  ASSERT_FALSE(empty);
  EXPECT_NE(empty.error().sentence.find("at least one cell"), std::string::npos);
}

}  // namespace
}  // namespace outrider
