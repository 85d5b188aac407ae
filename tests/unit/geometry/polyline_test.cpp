#include "outrider/geometry/polyline.hpp"

#include <gtest/gtest.h>

namespace outrider {
namespace {

TEST(Polyline, IsAsLongAsItsLegs) {
  EXPECT_EQ(length_of(std::vector<Vec2>{}), 0.0);
  EXPECT_EQ(length_of({Vec2{3, 4}}), 0.0);
  EXPECT_EQ(length_of({Vec2{0, 0}, {3, 4}, {3, 4}, {3, 2}}), 7.0);
}

}  // namespace
}  // namespace outrider
