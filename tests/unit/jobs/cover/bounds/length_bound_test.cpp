#include "outrider/jobs/cover/bounds/length_bound.hpp"

#include <gtest/gtest.h>

#include "outrider/core/units.hpp"
#include "outrider/jobs/cover/strokes/plan.hpp"
#include "support/cover_areas.hpp"
#include "support/random_cases.hpp"

namespace outrider {
namespace {

TEST(LengthBound, OfACorridorIsItsTwoSides) {
  CoverProblem corridor;  // the room of the centre is 9.6 by 0.1 m: both sides cover all of it
  corridor.boundary = {{0, 0}, {10, 0}, {10, 0.5}, {0, 0.5}};
  corridor.width_m = 0.4;
  EXPECT_NEAR(least_length_m(*cover_ground(corridor), corridor), 2.0 * (9.6 + 0.1), 1e-3);
}

TEST(LengthBound, OfARoomIsItsSidesAndTheRestByTheWidth) {
  CoverProblem room;
  room.boundary = {{0, 0}, {5, 0}, {5, 5}, {0, 5}};
  room.width_m = 0.4;
  EXPECT_NEAR(least_length_m(*cover_ground(room), room), 4.0 * 4.6 + 4.2 * 4.2 / 0.4, 0.02);
}

/// No plan that covers nearly all is shorter by more than what it leaves out, taken at the width.
TEST(LengthBound, NoPlanIsShorter) {
  Rng rng(31);
  for (int k = 0; k < testing::cases(1); ++k) {
    CoverProblem problem = testing::random_cover_problem(rng);
    problem.uncovered = 0.0;
    const auto ground = cover_ground(problem);
    ASSERT_TRUE(ground) << to_string(ground.error());
    const double least_m = least_length_m(*ground, problem);
    for (const char* name : {"boustrophedon", "spiral"}) {
      const auto plan = find_cover_method(name)->plan(problem, testing::any_order(), {});
      ASSERT_TRUE(plan) << to_string(plan.error());
      EXPECT_GE(plan->sums.length_m, least_m) << k << " " << name;
    }
  }
}

}  // namespace
}  // namespace outrider
