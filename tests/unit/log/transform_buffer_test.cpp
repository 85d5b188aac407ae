#include "outrider/log/transform_buffer.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "outrider/log/messages/conversions.hpp"

namespace outrider {
namespace {

using geometry_msgs::TransformStamped;

tf2_msgs::TFMessage message(std::vector<TransformStamped> transforms) { return {std::move(transforms)}; }

void expect_pose(const std::optional<Pose3>& pose, Vec3 position, double heading_rad) {
  ASSERT_TRUE(pose);
  EXPECT_NEAR(pose->position.x, position.x, 1e-12);
  EXPECT_NEAR(pose->position.y, position.y, 1e-12);
  EXPECT_NEAR(pose->position.z, position.z, 1e-12);
  EXPECT_NEAR(std::atan2(pose->rotation.axes[0].y, pose->rotation.axes[0].x), heading_rad, 1e-12);
}

TEST(TransformBuffer, AMovingFrameIsInterpolatedAndNearestOutside) {
  TransformBuffer frames;
  ASSERT_TRUE(
      frames.add(message({transform_of(1.0, {{1.0, 0.0}, 0.0}, "odom", "base")}), Transforms::moving));
  ASSERT_TRUE(
      frames.add(message({transform_of(2.0, {{3.0, 1.0}, 1.0}, "odom", "base")}), Transforms::moving));
  expect_pose(frames.find("odom", "base", 1'500'000'000), {2.0, 0.5, 0.0}, 0.5);
  expect_pose(frames.find("odom", "/base", 1'000'000'000), {1.0, 0.0, 0.0}, 0.0);
  expect_pose(frames.find("odom", "base", 0), {1.0, 0.0, 0.0}, 0.0);
  expect_pose(frames.find("odom", "base", 9'000'000'000), {3.0, 1.0, 0.0}, 1.0);
  EXPECT_EQ(frames.known_until_ns("odom", "base"), 2'000'000'000);
  EXPECT_EQ(frames.known_from_ns("odom", "base"), 1'000'000'000);
}

TEST(TransformBuffer, ThePathLeadsUpAndDown) {
  TransformBuffer frames;
  ASSERT_TRUE(frames.add(message({transform_of(0.0, {{0.0, 0.0}, 0.5 * pi}, "base", "arm"),
                                  transform_of(0.0, {{1.0, 0.0}, 0.0}, "arm", "laser"),
                                  transform_of(0.0, {{0.0, 2.0}, 0.0}, "base", "camera")}),
                         Transforms::fixed));
  expect_pose(frames.find("base", "laser", 5), {0.0, 1.0, 0.0}, 0.5 * pi);
  expect_pose(frames.find("camera", "laser", 5), {0.0, -1.0, 0.0}, 0.5 * pi);
  expect_pose(frames.find("laser", "camera", 5), {1.0, 0.0, 0.0}, -0.5 * pi);
  expect_pose(frames.find("laser", "laser", 5), {0.0, 0.0, 0.0}, 0.0);
  EXPECT_EQ(frames.known_until_ns("base", "laser"), std::numeric_limits<std::int64_t>::max());
  EXPECT_FALSE(frames.find("base", "map", 5));
  EXPECT_FALSE(frames.known_until_ns("base", "map"));
}

TEST(TransformBuffer, ALoopEndsAndANewParentReplacesTheOld) {
  TransformBuffer frames;
  ASSERT_TRUE(frames.add(message({transform_of(0.0, {}, "a", "b"), transform_of(0.0, {}, "b", "a")}),
                         Transforms::fixed));
  EXPECT_FALSE(frames.find("c", "a", 0));
  ASSERT_TRUE(frames.add(message({transform_of(0.0, {{4.0, 0.0}, 0.0}, "c", "a")}), Transforms::fixed));
  expect_pose(frames.find("c", "b", 0), {4.0, 0.0, 0.0}, 0.0);
}

TEST(TransformBuffer, WhatIsOlderThanTheWindowIsForgotten) {
  TransformBuffer frames(1'000'000'000);
  for (int i = 0; i <= 100; ++i) {
    ASSERT_TRUE(frames.add(message({transform_of(0.1 * i, {{0.1 * i, 0.0}, 0.0}, "odom", "base")}),
                           Transforms::moving));
  }
  expect_pose(frames.find("odom", "base", 9'550'000'000), {9.55, 0.0, 0.0}, 0.0);
  expect_pose(frames.find("odom", "base", 0), {9.0, 0.0, 0.0}, 0.0);
}

TEST(TransformBuffer, RefusesWhatIsNoTransform) {
  TransformBuffer frames;
  TransformStamped wrong = transform_of(0.0, {}, "a", "b");
  wrong.transform.rotation = {0.0, 0.0, 0.0, 0.0};
  EXPECT_FALSE(frames.add(message({wrong}), Transforms::fixed));
  wrong = transform_of(0.0, {}, "a", "b");
  wrong.transform.translation.x = std::nan("");
  const auto refused = frames.add(message({wrong}), Transforms::fixed);
  ASSERT_FALSE(refused);
  EXPECT_NE(refused.error().sentence.find("from 'a' to 'b' is not finite"), std::string::npos);
  EXPECT_FALSE(frames.add(message({transform_of(0.0, {}, "a", "a")}), Transforms::fixed));
}

}  // namespace
}  // namespace outrider
