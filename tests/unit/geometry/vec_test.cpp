#include "outrider/geometry/vec.hpp"

#include <gtest/gtest.h>

#include "outrider/core/rng.hpp"
#include "outrider/core/units.hpp"
#include "outrider/geometry/box.hpp"
#include "outrider/geometry/pose.hpp"

namespace outrider {
namespace {

void expect_near(Vec3 a, Vec3 b) { EXPECT_LT(norm(a - b), 1e-12); }

Vec3 turn_x(double a, Vec3 v) {
  return {v.x, std::cos(a) * v.y - std::sin(a) * v.z, std::sin(a) * v.y + std::cos(a) * v.z};
}
Vec3 turn_y(double a, Vec3 v) {
  return {std::cos(a) * v.x + std::sin(a) * v.z, v.y, -std::sin(a) * v.x + std::cos(a) * v.z};
}
Vec3 turn_z(double a, Vec3 v) {
  return {std::cos(a) * v.x - std::sin(a) * v.y, std::sin(a) * v.x + std::cos(a) * v.y, v.z};
}

TEST(Rotation, RollPitchYawTurnAboutFixedAxesInThatOrder) {
  Rng rng(1);
  for (int i = 0; i < 200; ++i) {
    const double roll = rng.uniform(-pi, pi);
    const double pitch = rng.uniform(-pi, pi);
    const double yaw = rng.uniform(-pi, pi);
    const Vec3 v{rng.normal(), rng.normal(), rng.normal()};
    const Rotation rotation = Rotation::from_rpy(roll, pitch, yaw);
    expect_near(rotation * v, turn_z(yaw, turn_y(pitch, turn_x(roll, v))));
    expect_near(rotation.unrotate(rotation * v), v);
  }
}

TEST(Pose3, ComposesAndInverts) {
  Rng rng(2);
  const auto random_vec = [&] { return Vec3{rng.normal(), rng.normal(), rng.normal()}; };
  const auto random_pose = [&] {
    return Pose3{random_vec(), Rotation::from_rpy(rng.normal(), rng.normal(), rng.normal())};
  };
  for (int i = 0; i < 200; ++i) {
    const Pose3 a = random_pose();
    const Pose3 b = random_pose();
    const Vec3 p = random_vec();
    expect_near((a * b) * p, a * (b * p));
    expect_near(a.to_local(a * p), p);
  }
}

TEST(Vec2, LeftIsPositive) {
  EXPECT_GT(cross(Vec2{1, 0}, Vec2{0, 1}), 0.0);
  EXPECT_EQ(perpendicular({1, 0}), (Vec2{0, 1}));
  EXPECT_DOUBLE_EQ(heading_of({0, 2}), pi / 2);
  for (double heading = -3.0; heading < 3.1; heading += 0.1) {
    EXPECT_NEAR(heading_of(direction(heading)), heading, 1e-12);
  }
}

TEST(Vec3, CrossIsRightHanded) {
  EXPECT_EQ(cross(Vec3{1, 0, 0}, Vec3{0, 1, 0}), (Vec3{0, 0, 1}));
  EXPECT_EQ(cross(Vec3{0, 1, 0}, Vec3{0, 0, 1}), (Vec3{1, 0, 0}));
}

TEST(Box2, GrowsFromNothing) {
  Box2 box;
  EXPECT_TRUE(box.empty());
  box.include({1, 2});
  EXPECT_FALSE(box.empty());
  box.include({-1, 5});
  EXPECT_EQ(box.low, (Vec2{-1, 2}));
  EXPECT_EQ(box.high, (Vec2{1, 5}));
  EXPECT_TRUE(box.contains({1, 5}));
  EXPECT_FALSE(box.contains({1.001, 5}));
  EXPECT_TRUE(box.overlaps({{1, 5}, {2, 6}}));
  EXPECT_FALSE(box.overlaps({{1.001, 5}, {2, 6}}));
  EXPECT_EQ(box.grown(1.0).size(), (Vec2{4, 5}));
}

TEST(Box2, DistanceIsToTheNearestPointOfIt) {
  Rng rng(3);
  const Box2 box{{-1, 2}, {1, 5}};
  for (int i = 0; i < 50; ++i) {
    const Vec2 p{rng.uniform(-4, 4), rng.uniform(-1, 8)};
    double least = box.contains(p) ? 0.0 : 1e9;
    for (int x = -100; x <= 100; ++x) {
      for (int y = 200; y <= 500; ++y) least = std::min(least, distance(p, Vec2{0.01 * x, 0.01 * y}));
    }
    EXPECT_NEAR(box.distance_to(p), least, 0.01);
  }
}

TEST(Pose2, IsFiniteWhereAllOfItIs) {
  EXPECT_TRUE(finite(Pose2{{1, -2}, 3}));
  for (const double odd : {std::nan(""), HUGE_VAL, -HUGE_VAL}) {
    EXPECT_FALSE(finite(Pose2{{odd, 0}, 0}));
    EXPECT_FALSE(finite(Pose2{{0, odd}, 0}));
    EXPECT_FALSE(finite(Pose2{{0, 0}, odd}));
  }
}

TEST(Vec2, RotatedIsByTheHeading) {
  for (double heading = -3.0; heading < 3.1; heading += 0.3) {
    const Vec2 v{2.0, -0.5}, turned = rotated(heading, v);
    EXPECT_NEAR(norm(turned), norm(v), 1e-12);
    EXPECT_NEAR(std::remainder(heading_of(turned) - heading_of(v) - heading, 2.0 * pi), 0.0, 1e-12);
    EXPECT_LT(norm(unrotated(heading, turned) - v), 1e-12);
  }
}

TEST(Box3, KeepsItsShadow) {
  Box3 box;
  box.include({1, 2, 3});
  box.include({0, 4, -3});
  EXPECT_EQ(box.low, (Vec3{0, 2, -3}));
  EXPECT_EQ(box.high, (Vec3{1, 4, 3}));
  EXPECT_EQ(box.ground().low, (Vec2{0, 2}));
  EXPECT_EQ(box.ground().high, (Vec2{1, 4}));
}

}  // namespace
}  // namespace outrider
