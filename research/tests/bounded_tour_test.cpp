#include "research/guard/bounded_tour.hpp"

#include <gtest/gtest.h>

#include "support/straight_missions.hpp"

namespace outrider {
namespace {

TEST(BoundWithHeadings, IsNeverAboveAMissionOfStraightDrives) {
  EXPECT_GT(testing::tightness_on_the_move(bound_with_headings), 0.6);
}

}  // namespace
}  // namespace outrider
