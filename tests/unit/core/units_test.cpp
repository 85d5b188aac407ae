#include "outrider/core/units.hpp"

#include <gtest/gtest.h>

namespace outrider {
namespace {

TEST(Units, DegreesAndRadiansInvertEachOther) {
  EXPECT_DOUBLE_EQ(radians(180.0), pi);
  EXPECT_DOUBLE_EQ(degrees(pi / 4), 45.0);
  for (double d = -720.0; d <= 720.0; d += 7.3) EXPECT_NEAR(degrees(radians(d)), d, 1e-12);
}

TEST(Units, AWrappedAngleIsTheSameDirectionInItsRange) {
  for (double angle = -50.0; angle <= 50.0; angle += 0.037) {
    const double wrapped = wrap_angle(angle);
    EXPECT_GT(wrapped, -pi);
    EXPECT_LE(wrapped, pi);
    EXPECT_NEAR(std::cos(wrapped), std::cos(angle), 1e-12);
    EXPECT_NEAR(std::sin(wrapped), std::sin(angle), 1e-12);
  }
  EXPECT_EQ(wrap_angle(-pi), pi);
  EXPECT_EQ(wrap_angle(pi), pi);
  EXPECT_EQ(wrap_angle(0.0), 0.0);
}

}  // namespace
}  // namespace outrider
