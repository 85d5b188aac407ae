#include "laser/odometry_bias.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "outrider/core/rng.hpp"
#include "outrider/core/units.hpp"

namespace outrider {
namespace {

constexpr double way_factor = 1.015, turn_factor = 0.98, bend_rad_per_m = 0.06;

/// Returns the true motion of such wheels when they count that motion.
Pose2 truly(const Pose2& counted) {
  const double turn_rad = turn_factor * counted.heading_rad + bend_rad_per_m * counted.position.x;
  const double middle = 0.5 * (turn_rad - counted.heading_rad);
  return {way_factor * (norm(counted.position) *
                        direction(middle + std::atan2(counted.position.y, counted.position.x))),
          turn_rad};
}

/// Short arcs, ahead and in both directions.
Pose2 counted_arc(Rng& rng) {
  const double turn_rad = rng.uniform(-0.3, 0.3);
  return {rng.uniform(0.0, 0.05) * direction(0.5 * turn_rad), turn_rad};
}

/// Drives `steps` arcs and tells the filter how each tenth pose was seen, with errors as stated.
OdometryBias taught(int steps, std::uint64_t seed) {
  constexpr double sigma_m = 0.002, sigma_rad = 0.002;
  Rng rng(seed);
  OdometryBias bias;
  Pose2 pose;
  for (int i = 0; i < steps; ++i) {
    const Pose2 arc = counted_arc(rng);
    bias.count(arc);
    pose = compose(pose, truly(arc));
    if (i % 10 != 9) continue;
    const Pose2 seen{pose.position + Vec2{rng.uniform(-sigma_m, sigma_m), rng.uniform(-sigma_m, sigma_m)},
                     pose.heading_rad + rng.uniform(-sigma_rad, sigma_rad)};
    bias.learn(seen,
               Eigen::Vector3d(sigma_m * sigma_m, sigma_m * sigma_m, sigma_rad * sigma_rad).asDiagonal(),
               1e-6, 1e-6);
  }
  return bias;
}

/// Returns the error of the believed end of a blind drive of that many arcs.
Pose2 blind_error(const OdometryBias& bias, int steps, std::uint64_t seed) {
  Rng rng(seed);
  Pose2 truth, believed;
  for (int i = 0; i < steps; ++i) {
    const Pose2 arc = counted_arc(rng);
    truth = compose(truth, truly(arc));
    believed = compose(believed, bias.corrected(arc));
  }
  return {believed.position - truth.position, believed.heading_rad - truth.heading_rad};
}

TEST(OdometryBias, KnowsNothingAtFirst) {
  const Pose2 motion{{0.3, 0.02}, 0.1};
  EXPECT_EQ(OdometryBias().corrected(motion), motion);
}

TEST(OdometryBias, TakesMostOfTheDriftFromABlindDrive) {
  for (const std::uint64_t seed : {1U, 2U, 3U}) {
    const Pose2 untaught = blind_error(OdometryBias(), 200, 10 + seed);
    const Pose2 known = blind_error(taught(4000, seed), 200, 10 + seed);
    EXPECT_GT(std::abs(untaught.heading_rad), 0.2);
    EXPECT_LT(std::abs(known.heading_rad), 0.1 * std::abs(untaught.heading_rad)) << seed;
    EXPECT_LT(norm(known.position), 0.1 * norm(untaught.position)) << seed;
  }
}

TEST(OdometryBias, LearnsNothingFromTheBlindOrTheUnbelievable) {
  OdometryBias blind;
  Rng rng(4);
  for (int i = 0; i < 100; ++i) blind.count(counted_arc(rng));
  blind.learn({{9.0, 9.0}, 1.0}, 1e-6 * Eigen::Matrix3d::Identity(), 1e-6, 1e-6);  // the first look is no way
  const Pose2 motion{{0.3, 0.02}, 0.1};
  EXPECT_EQ(blind.corrected(motion), motion);

  blind.count({{0.5, 0.0}, 0.0});
  blind.learn({{0.0, 0.0}, -2.0}, 1e-6 * Eigen::Matrix3d::Identity(), 1e-6, 1e-6);  // carried away
  EXPECT_EQ(blind.corrected(motion), motion);

  blind.count({{0.5, 0.0}, 0.0});
  blind.forget();
  blind.learn({{0.6, 0.0}, -2.0}, 1e-6 * Eigen::Matrix3d::Identity(), 1e-6, 1e-6);
  EXPECT_EQ(blind.corrected(motion), motion);
}

}  // namespace
}  // namespace outrider
