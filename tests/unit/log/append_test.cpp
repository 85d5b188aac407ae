#include "outrider/log/append.hpp"

#include <gtest/gtest.h>

#include "outrider/core/units.hpp"
#include "outrider/log/messages/conversions.hpp"
#include "outrider/log/messages/ros_sensor_messages.hpp"
#include "outrider/log/topics.hpp"
#include "support/random_cases.hpp"

namespace outrider {
namespace {

TEST(Append, APoseIsATransformAsWell) {
  Log log;
  const Pose2 pose{{1.0, -2.0}, 0.75};
  log_pose(log, 1.5, {});
  log_pose(log, 2.5, pose);
  ASSERT_EQ(poses_of(log).size(), 2U);
  EXPECT_EQ(poses_of(log)[1].position, pose.position);
  EXPECT_NEAR(poses_of(log)[1].heading_rad, pose.heading_rad, 1e-15);
  const auto& frames = log.messages<tf2_msgs::TFMessage>(topic::transforms);
  ASSERT_EQ(frames.size(), 2U);
  EXPECT_EQ(frames[1].time_s(), 2.5);
  const auto& frame = frames[1].message.transforms.at(0);
  EXPECT_EQ(frame.header.frame_id, "map");
  EXPECT_EQ(frame.child_frame_id, "base_link");
  EXPECT_EQ(nanoseconds_of(frame.header.stamp), 2'500'000'000);
  EXPECT_EQ(frame.transform.translation.y, -2.0);
  EXPECT_NEAR(heading_of(frame.transform.rotation), 0.75, 1e-15);
}

TEST(Append, AHeadingAsItIsLoggedComesBackAsItWas) {
  Rng rng(7);
  for (int i = 0; i < testing::cases(20'000); ++i) {
    const double heading_rad = i == 0 ? pi : i == 1 ? -pi : i == 2 ? 0.0 : rng.uniform(-20.0, 20.0);
    const Pose2 pose{{rng.uniform(-9.0, 9.0), 1.0 / 3.0}, heading_rad};
    const Pose2 logged = logged_pose(pose);
    ASSERT_EQ(logged.position, pose.position);
    ASSERT_NEAR(wrap_angle(logged.heading_rad - heading_rad), 0.0, 1.01 * heading_step_rad);
    ASSERT_EQ(pose_of(pose_of(logged)), logged) << heading_rad;
    ASSERT_EQ(logged_pose(logged), logged);
  }
}

TEST(Append, ABeliefHasTheCovarianceOfThePlane) {
  Log log;
  Eigen::Matrix3d covariance;
  covariance << 1, 2, 3, 2, 5, 6, 3, 6, 9;
  log_belief(log, 1.0, {{1.0, 2.0}, 0.5}, covariance, false);
  log_belief(log, 2.0, {{2.0, 2.0}, 0.5}, covariance, true);
  const auto& beliefs = log.messages<geometry_msgs::PoseWithCovarianceStamped>(topic::belief);
  ASSERT_EQ(beliefs.size(), 2U);
  const auto& c = beliefs[0].message.pose.covariance;
  EXPECT_EQ(c[0], 1.0);
  EXPECT_EQ(c[1], 2.0);
  EXPECT_EQ(c[5], 3.0);
  EXPECT_EQ(c[7], 5.0);
  EXPECT_EQ(c[11], 6.0);
  EXPECT_EQ(c[30], 3.0);
  EXPECT_EQ(c[35], 9.0);
  EXPECT_EQ(c[14], 0.0) << "nothing is known of z";
  const auto& corrections = log.messages<geometry_msgs::PoseStamped>(topic::corrections);
  ASSERT_EQ(corrections.size(), 1U);
  EXPECT_EQ(corrections[0].time_ns, beliefs[1].time_ns);
  EXPECT_EQ(corrections[0].message.pose.position.x, 2.0);
}

TEST(Append, APlanLooksToItsNextPoint) {
  Log log;
  log_plan(log, 1.0, {{0.0, 0.0}, {0.0, 2.0}, {1.0, 2.0}});
  log_plan(log, 3.0, {});
  const auto& plans = log.messages<nav_msgs::Path>(topic::plan);
  ASSERT_EQ(plans.size(), 2U);
  const auto& poses = plans[0].message.poses;
  ASSERT_EQ(poses.size(), 3U);
  EXPECT_EQ(poses[1].pose.position.y, 2.0);
  EXPECT_NEAR(heading_of(poses[0].pose.orientation), 0.5 * pi, heading_step_rad);
  EXPECT_NEAR(heading_of(poses[1].pose.orientation), 0.0, heading_step_rad);
  EXPECT_TRUE(plans[1].message.poses.empty());
}

TEST(Append, TheGunHasTwoJoints) {
  Log log;
  log_gun(log, 1.0, 0.5, 0.25);
  const auto* joints = log.latest<sensor_msgs::JointState>(topic::joints);
  ASSERT_NE(joints, nullptr);
  EXPECT_EQ(joints->name.size(), joints->position.size());
  EXPECT_EQ(joints->position, (std::vector<double>{0.5, 0.25}));
}

TEST(Append, EventsAreFoundByTheirKind) {
  Log log;
  log_event(log, 1.0, "shot", "shoots at the cat");
  log_event(log, 2.0, "hit", "hits the cat");
  log_event(log, 3.0, "shot", "shoots at the fox");
  EXPECT_EQ(events_of(log).size(), 3U);
  const auto shots = events_of(log, "shot");
  ASSERT_EQ(shots.size(), 2U);
  EXPECT_EQ(shots[1].time_s(), 3.0);
  EXPECT_EQ(shots[1].message.msg, "shoots at the fox");
  EXPECT_TRUE(events_of(log, "miss").empty());
}

}  // namespace
}  // namespace outrider
