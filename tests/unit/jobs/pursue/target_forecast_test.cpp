#include "outrider/jobs/pursue/target_forecast.hpp"

#include <gtest/gtest.h>

#include "support/pursuit_oracle.hpp"
#include "support/random_cases.hpp"

namespace outrider {
namespace {

std::vector<Cell> predicted(std::string_view name, const PursuitProblem& map, const std::vector<Cell>& seen,
                            std::size_t seconds, Cell robot = {}) {
  const auto forecast = find_target_forecast(name);
  EXPECT_TRUE(forecast);
  return forecast->predict({map, seen, robot}, seconds);
}

const PursuitProblem hall = testing::drawn_pursuit({"11111", "11111", "111#1"}, {0, 0}, {{0, 0}});

TEST(TargetForecast, StraightOnUntilTheFloorEnds) {
  EXPECT_EQ(predicted("last_velocity", hall, {{0, 1}, {1, 1}}, 5),
            (std::vector<Cell>{{2, 1}, {3, 1}, {4, 1}, {4, 1}, {4, 1}}));
  EXPECT_EQ(predicted("last_velocity", hall, {{0, 0}, {1, 0}}, 3),
            (std::vector<Cell>{{2, 0}, {2, 0}, {2, 0}}));
  // Whoever was seen on a wall is expected there again.
  EXPECT_EQ(predicted("last_velocity", hall, {{3, 0}, {2, 0}, {1, 0}, {2, 0}}, 2).size(), 2U);
  EXPECT_EQ(predicted("last_velocity", hall, {{2, 1}}, 2), (std::vector<Cell>{{2, 1}, {2, 1}}));
}

TEST(TargetForecast, TheVisitMapLeadsBackAlongARound) {
  const std::vector<Cell> twice_around = {{0, 1}, {1, 1}, {1, 2}, {0, 2}, {0, 1},
                                          {1, 1}, {1, 2}, {0, 2}, {0, 1}};
  for (const Cell cell : predicted("visit_map", hall, twice_around, 4)) {
    EXPECT_LE(cell.x, 1);
    EXPECT_GE(cell.y, 1);
  }
}

TEST(TargetForecast, TheEvaderGoesWhereTheRobotIsFarthest) {
  const auto cells = predicted("evade", hall, {{2, 1}}, 3, {0, 1});
  EXPECT_EQ(cells.back().x, 4);
}

TEST(TargetForecast, EveryRowStaysOnTheMapAndOffWallsAndRepeats) {
  Rng rng(5);
  for (int k = 0; k < testing::cases(300); ++k) {
    const PursuitProblem problem = testing::random_pursuit(rng, 8, 12);
    const std::vector<Cell>& seen = problem.target;
    const bool walks_walls = std::ranges::any_of(seen, [&](Cell c) { return problem.wall(c); });
    for (const TargetForecast& forecast : target_forecasts()) {
      const auto cells = forecast.predict({problem, seen, problem.start}, 20);
      ASSERT_EQ(cells.size(), 20U) << forecast.name;
      EXPECT_EQ(cells, forecast.predict({problem, seen, problem.start}, 20));
      for (const Cell cell : cells) {
        ASSERT_TRUE(problem.costs->contains(cell)) << forecast.name;
        EXPECT_TRUE(walks_walls || !problem.wall(cell)) << forecast.name;
      }
    }
  }
}

TEST(TargetForecast, AnUnknownNameIsToldTheNearest) {
  const auto unknown = find_target_forecast("evader");
  ASSERT_FALSE(unknown);
  EXPECT_NE(unknown.error().sentence.find("'evade'"), std::string::npos);
}

}  // namespace
}  // namespace outrider
