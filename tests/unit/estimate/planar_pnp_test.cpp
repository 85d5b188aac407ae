#include "outrider/estimate/planar_pnp.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "outrider/core/units.hpp"
#include "support/random_cases.hpp"

namespace outrider {
namespace {

constexpr double size_m = 0.166;
using Corners = std::array<Vec2, 4>;

Corners seen(const Camera& camera, const Pose3& camera_T_tag) {
  Corners corners;
  const auto points = tag_corners(size_m);
  for (std::size_t i = 0; i < 4; ++i) corners[i] = *project(camera, camera_T_tag * points[i]);
  return corners;
}

/// Sum of squares, by the camera's own lens; infinite where a corner is behind the camera.
double squares(const Camera& camera, const Pose3& pose, const Corners& corners) {
  double sum = 0.0;
  const auto points = tag_corners(size_m);
  for (std::size_t i = 0; i < 4; ++i) {
    const auto there = project(camera, pose * points[i]);
    if (!there) return std::numeric_limits<double>::infinity();
    sum += squared_norm(*there - corners[i]);
  }
  return sum;
}

/// Moved by a translation and a small rotation vector in the camera's frame.
Pose3 moved(const Pose3& pose, const std::array<double, 6>& by) {
  const Rotation turn = Rotation::from_rpy(by[3], by[4], by[5]);
  return {pose.position + Vec3{by[0], by[1], by[2]}, turn * pose.rotation};
}

/// A pose that shows the tag's face, at least 10 degrees of it.
Pose3 random_pose(Rng& rng, double tilt_rad) {
  for (;;) {
    const double z = rng.uniform(0.3, 2.5);
    const Pose3 pose{{z * rng.uniform(-0.6, 0.6), z * rng.uniform(-0.4, 0.4), z},
                     Rotation::from_rpy(rng.uniform(-tilt_rad, tilt_rad), rng.uniform(-tilt_rad, tilt_rad),
                                        rng.uniform(-pi, pi))};
    if (dot(pose.rotation.axes[2], pose.position) > std::sin(radians(10.0)) * norm(pose.position))
      return pose;
  }
}

double turn_between(const Rotation& a, const Rotation& b) {
  double trace = 0.0;
  for (std::size_t i = 0; i < 3; ++i) trace += dot(a.axes[i], b.axes[i]);
  return std::acos(std::clamp(0.5 * (trace - 1.0), -1.0, 1.0));
}

TEST(PlanarPnp, FindsTheTruthBehindExactCorners) {
  Rng rng(11);
  Camera lens;
  lens.distortion = {0.013206, -0.013362, -0.000168, 0.000592, 0.0};
  for (int i = 0; i < testing::cases(300); ++i) {
    const Camera& camera = i % 2 == 0 ? lens : Camera{};
    const Pose3 truth = random_pose(rng, radians(55.0));
    const auto poses = planar_pnp(camera, size_m, seen(camera, truth));
    ASSERT_FALSE(poses.empty());
    EXPECT_LT(poses[0].error_px, 1e-6);
    EXPECT_LT(norm(poses[0].camera_T_tag.position - truth.position), 1e-6);
    EXPECT_LT(turn_between(poses[0].camera_T_tag.rotation, truth.rotation), 1e-5);
  }
}

TEST(PlanarPnp, EverySolutionIsALocalMinimumAndNoneIsLower) {
  Rng rng(12);
  const Camera camera;
  for (int i = 0; i < testing::cases(60); ++i) {
    const Pose3 truth = random_pose(rng, radians(50.0));
    Corners corners = seen(camera, truth);
    for (Vec2& c : corners) c = c + Vec2{rng.normal(), rng.normal()};
    const auto poses = planar_pnp(camera, size_m, corners);
    ASSERT_FALSE(poses.empty());
    for (const TagPose& pose : poses) {
      const double here = squares(camera, pose.camera_T_tag, corners);
      EXPECT_NEAR(here, 4.0 * pose.error_px * pose.error_px, 1e-9 + 1e-6 * here);
      for (std::size_t k = 0; k < 6; ++k) {
        for (const double sign : {-1.0, 1.0}) {
          std::array<double, 6> by{};
          by[k] = sign * 1e-5;
          EXPECT_GE(squares(camera, moved(pose.camera_T_tag, by), corners), here - 1e-9);
        }
      }
    }
    // A random search with shrinking steps from many starts shares nothing with what it judges.
    double lowest = std::numeric_limits<double>::infinity();
    for (int start = 0; start < 6; ++start) {
      Pose3 best = moved(truth, {0, 0, 0, rng.uniform(-0.8, 0.8), rng.uniform(-0.8, 0.8), 0});
      double cost = squares(camera, best, corners), step = 0.2;
      for (int trial = 0; trial < 1500; ++trial) {
        std::array<double, 6> by;
        for (double& b : by) b = step * rng.normal();
        const Pose3 next = moved(best, by);
        if (!(next.position.z > 0.1)) continue;
        const double there = squares(camera, next, corners);
        step *= there < cost ? 1.5 : 0.97;
        if (there >= cost) continue;
        cost = there;
        best = next;
      }
      lowest = std::min(lowest, cost);
    }
    EXPECT_LE(4.0 * poses[0].error_px * poses[0].error_px, lowest + 1e-9);
  }
}

TEST(PlanarPnp, FarTagsHaveTwoSolutionsTiltedAgainstEachOther) {
  const Camera camera;
  const Rotation tilted = Rotation::from_rpy(0.0, radians(15.0), 0.0);
  const Pose3 truth{{0.0, 0.0, 3.0}, tilted};
  const auto poses = planar_pnp(camera, size_m, seen(camera, truth));
  ASSERT_EQ(poses.size(), 2U);
  EXPECT_LT(turn_between(poses[0].camera_T_tag.rotation, tilted), 1e-5);
  const Rotation mirrored = Rotation::from_rpy(0.0, radians(-15.0), 0.0);
  EXPECT_LT(turn_between(poses[1].camera_T_tag.rotation, mirrored), radians(3.0));
  EXPECT_LT(poses[1].error_px, 0.5) << "which is why noise makes it the better one at times";
}

TEST(PlanarPnp, CovarianceIsThatOfManyTrials) {
  Rng rng(13);
  const Camera camera;
  const Pose3 truth{{0.2, -0.1, 1.0}, Rotation::from_rpy(radians(10.0), radians(35.0), 0.0)};
  const Corners corners = seen(camera, truth);
  constexpr double sigma = 0.3;
  const int trials = testing::cases(4000);
  std::array<double, 3> spread{};
  std::array<double, 6> predicted{};
  for (int i = 0; i < trials; ++i) {
    Corners noisy = corners;
    for (Vec2& c : noisy) c = c + sigma * Vec2{rng.normal(), rng.normal()};
    const auto poses = planar_pnp(camera, size_m, noisy, {sigma, 10.0});
    const Vec3 off = poses[0].camera_T_tag.position - truth.position;
    const double squared[] = {off.x * off.x, off.y * off.y, off.z * off.z};
    for (std::size_t k = 0; k < 3; ++k) spread[k] += squared[k] / trials;
    for (std::size_t k = 0; k < 6; ++k)
      predicted[k] += poses[0].covariance.diagonal()[static_cast<Eigen::Index>(k)] / trials;
  }
  for (std::size_t k = 0; k < 3; ++k) EXPECT_NEAR(spread[k] / predicted[k], 1.0, 0.15) << k;
}

/// A pose that shows the tag's face, at least 15 degrees of it, turned by any rotation.
Pose3 any_pose(Rng& rng, double low_m, double high_m) {
  for (;;) {
    const double z = rng.uniform(low_m, high_m);
    const Vec3 position{z * rng.uniform(-0.3, 0.3), z * rng.uniform(-0.2, 0.2), z};
    const Pose3 pose{position, Rotation::from_rpy(rng.uniform(-pi, pi), std::asin(rng.uniform(-1.0, 1.0)),
                                                  rng.uniform(-pi, pi))};
    if (dot(pose.rotation.axes[2], position) > std::sin(radians(15.0)) * norm(position)) return pose;
  }
}

TEST(PlanarPnp, ProbabilitiesAreHowOftenAPoseIsTheTrueOne) {
  Rng rng(14);
  const Camera camera;
  struct Bin {
    double stated = 0.0;
    int poses = 0, right = 0;
  };
  std::array<Bin, 10> bins;
  const int trials = testing::cases(4000);
  for (int i = 0; i < trials; ++i) {
    const Pose3 truth = any_pose(rng, 0.5, 8.0);
    Corners corners = seen(camera, truth);
    for (Vec2& c : corners) c = c + 0.3 * Vec2{rng.normal(), rng.normal()};
    const auto poses = planar_pnp(camera, size_m, corners, {0.3, 1000.0});
    if (poses.size() != 2) continue;
    const auto off = [&](const TagPose& p) { return turn_between(p.camera_T_tag.rotation, truth.rotation); };
    const std::size_t right = off(poses[0]) <= off(poses[1]) ? 0 : 1;
    for (std::size_t k = 0; k < 2; ++k) {
      const double p = poses[k].probability;
      Bin& bin = bins[std::min<std::size_t>(9, static_cast<std::size_t>(10.0 * p))];
      bin.stated += p;
      ++bin.poses;
      bin.right += k == right ? 1 : 0;
    }
  }
  for (const Bin& bin : bins) {
    ASSERT_GT(bin.poses, 100);
    const double stated = bin.stated / bin.poses, spread = std::sqrt(stated * (1.0 - stated) / bin.poses);
    EXPECT_NEAR(static_cast<double>(bin.right) / bin.poses, stated, 0.05 + 3.0 * spread);
  }
}

TEST(PlanarPnp, RefusesWhatIsNoTagSeenFromItsFront) {
  const Camera camera;
  const Corners good = seen(camera, {{0, 0, 1}, {}});
  EXPECT_TRUE(planar_pnp(camera, size_m, {good[3], good[2], good[1], good[0]}).empty()) << "from behind";
  EXPECT_TRUE(planar_pnp(camera, size_m, {good[0], good[2], good[1], good[3]}).empty()) << "crossed";
  EXPECT_TRUE(planar_pnp(camera, size_m, {good[0], good[0], good[0], good[0]}).empty());
  EXPECT_TRUE(planar_pnp(camera, size_m, {good[0], good[1], 0.5 * (good[0] + good[1]), good[3]}).empty());
}

}  // namespace
}  // namespace outrider
