#include "slam_log.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "outrider/log/messages/conversions.hpp"
#include "outrider/log/topics.hpp"

namespace outrider {
namespace {

TEST(SlamLog, TimesAreThoseOfTheLogOrTenASecond) {
  EXPECT_EQ(run_times({100.0, 100.5, 102.0}), (std::vector<double>{0.0, 0.5, 2.0}));
  for (const auto& useless : {std::vector<double>{0.0, 0.0, 0.0}, {3.0, 2.0, 4.0}, {0.0, NAN, 1.0}}) {
    const auto times = run_times(useless);
    EXPECT_NEAR(times[1], 0.1, 1e-12);
    EXPECT_NEAR(times[2], 0.2, 1e-12);
  }
  EXPECT_TRUE(run_times({}).empty());
  std::vector<double> stumbling;
  for (int i = 0; i < 20; ++i) stumbling.push_back(i == 7 ? 5.5 : i);
  stumbling = run_times(stumbling);
  EXPECT_EQ(stumbling[7], 6.0);
  EXPECT_EQ(stumbling[8], 8.0);
}

/// A drive along x whose belief is 1 cm to the left.
SlamLog driven(Log& log, int steps) {
  SlamScenario scenario;
  scenario.log = "logs/hall.log.gz";
  SlamLog slam(log, scenario, "laser");
  for (int i = 0; i < steps; ++i) {
    const double t = 0.1 * i;
    slam.note(
        {t, {{t, 0.01}, 0.0}, Eigen::Vector3d(0.01, 0.04, 0.0001).asDiagonal(), {{t, 0.0}, 0.0}, i == 7});
  }
  return slam;
}

TEST(SlamLog, EachStepIsABeliefAndAPlaceByOdometry) {
  Log log;
  const SlamLog slam = driven(log, 20);
  EXPECT_EQ(slam.end_s(), 0.1 * 19);
  EXPECT_EQ(log.latest<outrider_msgs::RunInfo>(topic::run)->world, "hall");
  EXPECT_EQ(log.latest<outrider_msgs::RunInfo>(topic::run)->engine, "laser");
  const auto& beliefs = log.messages<geometry_msgs::PoseWithCovarianceStamped>(topic::belief);
  ASSERT_EQ(beliefs.size(), 20U);
  EXPECT_EQ(beliefs[3].message.pose.covariance[7], 0.04);
  EXPECT_EQ(log.messages<nav_msgs::Odometry>(topic::odometry).size(), 20U);
  const auto& corrections = log.messages<geometry_msgs::PoseStamped>(topic::corrections);
  ASSERT_EQ(corrections.size(), 1U);
  EXPECT_EQ(corrections[0].time_ns, beliefs[7].time_ns);
}

TEST(SlamLog, SettledItTellsThePathAndTheBoundsOfEverything) {
  Log log;
  SlamLog slam = driven(log, 501);
  std::vector<Pose2> poses;
  std::vector<Vec2> reference;
  for (int i = 0; i <= 500; ++i) {
    const double t = 0.1 * i;
    poses.push_back({{t, std::sin(t)}, std::cos(t)});
    reference.push_back(poses.back().position + Vec2{0.0, 0.01});
  }
  Box2 landmarks;
  landmarks.include({1.0, 7.0});
  EXPECT_GT(slam.settle(poses, reference, landmarks), 49.9);
  const auto* path = log.latest<nav_msgs::Path>(topic::trajectory);
  ASSERT_TRUE(path != nullptr && path->poses.size() == 501U);
  EXPECT_EQ(pose_of(path->poses[10].pose).position, poses[10].position);
  EXPECT_EQ(nanoseconds_of(path->poses[10].header.stamp), nanoseconds(1.0));
  EXPECT_EQ(log.latest<nav_msgs::Path>(topic::reference)->poses.size(), 501U);
  const auto* info = log.latest<outrider_msgs::RunInfo>(topic::run);
  for (const Vec2 corner : {Vec2{1.0, 7.0}, poses.back().position, reference.front()}) {
    EXPECT_TRUE(corner.x > info->low.x && corner.x < info->high.x && corner.y > info->low.y &&
                corner.y < info->high.y);
  }
}

TEST(SlamLog, APlaceHasTheSigmasOfItsCovariance) {
  outrider_msgs::Landmark landmark;
  Eigen::Matrix2d covariance;
  covariance << 0.01, 0.01, 0.01, 0.04;
  set_place(landmark, {1.0, 2.0}, covariance);
  EXPECT_EQ(vec2_of(landmark.position), (Vec2{1.0, 2.0}));
  EXPECT_NEAR(landmark.sigma_x, 0.1, 1e-12);
  EXPECT_NEAR(landmark.sigma_y, 0.2, 1e-12);
  EXPECT_NEAR(landmark.correlation, 0.5, 1e-12);
  EXPECT_TRUE(std::isnan(landmark.truth.x));
  set_place(landmark, {}, Eigen::Matrix2d::Zero());
  EXPECT_EQ(landmark.correlation, 0.0);
}

}  // namespace
}  // namespace outrider
