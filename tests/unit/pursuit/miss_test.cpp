#include "outrider/pursuit/miss.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "support/pursuit_oracle.hpp"
#include "support/random_cases.hpp"

namespace outrider {
namespace {

using testing::drawn_pursuit;

TEST(Miss, NothingWhereThereIsACatch) {
  EXPECT_FALSE(why_no_catch(drawn_pursuit({"111"}, {0, 0}, {{1, 0}, {1, 0}})));
}

TEST(Miss, TheTargetIsGone) {
  const auto miss = why_no_catch(drawn_pursuit({"111"}, {1, 0}, {{1, 0}}));
  ASSERT_TRUE(miss);
  EXPECT_EQ(miss->reason, MissReason::too_few_seconds);
  EXPECT_EQ(miss->sentence,
            "the target cannot be caught: it is gone after second 0, and only seconds from 1 on count");
}

TEST(Miss, TheTargetIsAlwaysOnWalls) {
  const auto miss = why_no_catch(drawn_pursuit({"11#1", "1111"}, {0, 0}, {{1, 0}, {2, 1}, {2, 1}}));
  ASSERT_TRUE(miss);
  EXPECT_EQ(miss->reason, MissReason::always_on_walls);
  EXPECT_EQ(
      miss->sentence,
      "the target cannot be caught: it is on walls in all of its 2 seconds that count; the robot comes no "
      "nearer than 1 cell to it, at second 1");
}

TEST(Miss, WallsPartThem) {
  const auto miss = why_no_catch(drawn_pursuit({"1##11", "1##11"}, {0, 0}, {{4, 0}, {4, 0}, {3, 0}}));
  ASSERT_TRUE(miss);
  EXPECT_EQ(miss->reason, MissReason::cut_off);
  EXPECT_EQ(miss->short_by_cells, 3);
  EXPECT_EQ(miss->short_at_s, 2);
}

TEST(Miss, TheRobotIsTooLate) {
  const auto miss = why_no_catch(drawn_pursuit({"11111111"}, {0, 0}, {{5, 0}, {5, 0}, {6, 0}, {7, 0}}));
  ASSERT_TRUE(miss);
  EXPECT_EQ(miss->reason, MissReason::too_late);
  EXPECT_EQ(miss->late_by_s, 4);
  EXPECT_EQ(miss->late_at, (Cell{5, 0}));
  EXPECT_EQ(miss->late_for_s, 1);
  EXPECT_EQ(miss->short_by_cells, 4);
  EXPECT_EQ(miss->short_at_s, 1);
  EXPECT_EQ(
      miss->sentence,
      "the target cannot be caught: the robot is at least 4 s late, in cell (6, 1) where the target is at "
      "second 1; the robot comes no nearer than 4 cells to it, at second 1");
}

/// Cells within which the robot comes at best, by walking through the seconds.
int slow_nearest(const PursuitProblem& problem) {
  Grid<char> here(problem.costs->frame);
  here[problem.start] = 1;
  int nearest = std::numeric_limits<int>::max();
  for (int s = problem.start_s + 1; s <= problem.last_s(); ++s) {
    Grid<char> next = here;
    for (std::size_t i = 0; i < here.cells.size(); ++i) {
      const Cell from = here.frame.cell(i);
      for (int k = 0; k < 9 && here.cells[i] != 0; ++k) {
        const Cell to{from.x + k % 3 - 1, from.y + k / 3 - 1};
        if (here.contains(to) && !problem.wall(to)) next[to] = 1;
      }
    }
    here = next;
    const Cell target = problem.target[static_cast<std::size_t>(s)];
    for (std::size_t i = 0; i < here.cells.size(); ++i) {
      const Cell c = here.frame.cell(i);
      if (here.cells[i] != 0)
        nearest = std::min(nearest, std::max(std::abs(c.x - target.x), std::abs(c.y - target.y)));
    }
  }
  return nearest;
}

TEST(Miss, NearestInCellsEqualsWalkingThroughTheSeconds) {
  Rng rng(61);
  int misses = 0;
  for (int k = 0; k < testing::cases(3000); ++k) {
    const PursuitProblem problem = testing::random_pursuit(rng, 9, 8);
    const std::optional<Miss> miss = why_no_catch(problem);
    ASSERT_EQ(miss.has_value(), !testing::slow_catch(problem).has_value()) << "case " << k;
    if (!miss || miss->reason == MissReason::too_few_seconds) continue;
    ++misses;
    EXPECT_EQ(miss->short_by_cells, slow_nearest(problem)) << "case " << k;
  }
  EXPECT_GT(misses, 100);
}

}  // namespace
}  // namespace outrider
