#include "outrider/geometry/pose.hpp"

#include <gtest/gtest.h>

#include <array>

#include "outrider/core/rng.hpp"
#include "support/random_cases.hpp"

namespace outrider {
namespace {

/// A pose as a homogeneous 3 x 3 matrix.
using Homogeneous = std::array<std::array<double, 3>, 3>;

Homogeneous matrix(const Pose2& p) {
  const double c = std::cos(p.heading_rad), s = std::sin(p.heading_rad);
  return {{{c, -s, p.position.x}, {s, c, p.position.y}, {0.0, 0.0, 1.0}}};
}

Homogeneous product(const Homogeneous& a, const Homogeneous& b) {
  Homogeneous result{};
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) {
      for (std::size_t k = 0; k < 3; ++k) result[i][j] += a[i][k] * b[k][j];
    }
  }
  return result;
}

double difference(const Homogeneous& a, const Homogeneous& b) {
  double most = 0.0;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) most = std::max(most, std::abs(a[i][j] - b[i][j]));
  }
  return most;
}

Pose2 random_pose(Rng& rng) { return {testing::random_point(rng, 3.0), rng.uniform(-3.0 * pi, 3.0 * pi)}; }

TEST(Pose2, ComposesAsHomogeneousMatricesMultiply) {
  Rng rng(1);
  for (int round = 0; round < testing::cases(100); ++round) {
    const Pose2 a_T_b = random_pose(rng), b_T_c = random_pose(rng);
    EXPECT_LT(difference(matrix(compose(a_T_b, b_T_c)), product(matrix(a_T_b), matrix(b_T_c))), 1e-12);
    EXPECT_LT(difference(product(matrix(inverse(a_T_b)), matrix(a_T_b)), matrix({})), 1e-12);
  }
}

TEST(Pose2, RelativePoseUndoesCompose) {
  Rng rng(2);
  for (int round = 0; round < testing::cases(100); ++round) {
    const Pose2 a_T_b = random_pose(rng), b_T_c = random_pose(rng);
    const Pose2 again = relative_pose(a_T_b, compose(a_T_b, b_T_c));
    EXPECT_LT(distance(again.position, b_T_c.position), 1e-12);
    EXPECT_NEAR(again.heading_rad, b_T_c.heading_rad, 1e-12);  // whole turns are kept
    EXPECT_NEAR(wrap_heading(again).heading_rad, wrap_angle(b_T_c.heading_rad), 1e-12);
  }
}

TEST(Pose2, TakesPointsBetweenFrames) {
  Rng rng(3);
  for (int round = 0; round < testing::cases(100); ++round) {
    const Pose2 pose = random_pose(rng);
    const Vec2 p = testing::random_point(rng, 3.0);
    EXPECT_EQ(pose * p, compose(pose, {p, 1.0}).position);
    EXPECT_LT(distance(pose.to_local(pose * p), p), 1e-12);
  }
}

}  // namespace
}  // namespace outrider
