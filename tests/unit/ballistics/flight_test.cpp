#include "outrider/ballistics/flight.hpp"

#include <gtest/gtest.h>

#include "outrider/core/rng.hpp"
#include "support/fine_flight.hpp"
#include "support/random_cases.hpp"

namespace outrider {
namespace {

using testing::cases;
using testing::OwnGun;

TEST(Gun, MuzzleIsTheTurnedTip) {
  const GunModel gun;
  for (double p = gun.pitch_low_rad; p <= gun.pitch_high_rad; p += 0.01) {
    const Vec2 tip = muzzle(gun, p);
    // The tip is a point of the barrel's frame: turning it keeps its distance and adds to its angle.
    const Vec2 arm = tip - Vec2{0.0, 0.11};
    EXPECT_NEAR(norm(arm), std::hypot(0.255, 0.042), 1e-12);
    EXPECT_NEAR(heading_of(arm), std::atan2(0.042, 0.255) + p, 1e-12);
    EXPECT_NEAR(tip.x, 0.255 * std::cos(p) - 0.042 * std::sin(p), 1e-12);
    EXPECT_NEAR(tip.y, 0.11 + 0.255 * std::sin(p) + 0.042 * std::cos(p), 1e-12);
  }
}

TEST(Gun, NoBallInTheBarrelIsFartherOrHigherThanItsBounds) {
  Rng rng(11);
  for (int i = 0; i < cases(50); ++i) {
    GunModel gun;
    gun.tip_forward_m = rng.uniform(0.0, 0.5);
    gun.tip_up_m = rng.uniform(-0.2, 0.2);
    gun.pitch_low_rad = rng.uniform(-1.5, 0.5);
    gun.pitch_high_rad = rng.uniform(gun.pitch_low_rad, 1.5);
    double top = 0.0;
    for (int k = 0; k <= 1000; ++k) {
      const Vec2 tip = muzzle(gun, gun.pitch_low_rad + 1e-3 * k * (gun.pitch_high_rad - gun.pitch_low_rad));
      top = std::max({top, tip.y, gun.pivot_height_m});
      EXPECT_LE(std::abs(tip.x), barrel_reach(gun) + 1e-12);
    }
    EXPECT_NEAR(barrel_top(gun), top + gun.ball_radius_m, 1e-6);
    EXPECT_GE(barrel_top(gun), top + gun.ball_radius_m - 1e-12);
  }
}

TEST(Gun, AimingMovesBothAxesAtOnceTheShortWayRound) {
  const GunModel gun;
  EXPECT_DOUBLE_EQ(aim_time(gun, 0.0, 0.0), 0.0);
  EXPECT_DOUBLE_EQ(aim_time(gun, pi / 2, 0.0), 0.5);
  EXPECT_NEAR(aim_time(gun, 1.75 * pi, 0.0), 0.25, 1e-12);
  EXPECT_DOUBLE_EQ(aim_time(gun, 0.0, -pi / 6), 1.0);
  EXPECT_DOUBLE_EQ(aim_time(gun, pi / 2, pi / 6), 1.0);
}

TEST(Gun, DescribesAllItsMembersAtTheirDefaults) {
  GunModel gun;
  EXPECT_EQ(describe(gun).size(), 9U);
  for (const Option& option : describe(gun)) EXPECT_TRUE(assign(option, value_text(option))) << option.name;
}

/// A flight without a position of its own: velocity Verlet in steps of 0.1 ms.
TEST(Flight, FollowsItsEquationOfMotion) {
  Rng rng(11);
  for (int i = 0; i < cases(20); ++i) {
    const GunModel gun;
    const Shot shot{rng.uniform(-pi, pi), rng.uniform(gun.pitch_low_rad, gun.pitch_high_rad),
                    rng.uniform(1.0, 10.0)};
    const double gravity = rng.uniform(1.0, 20.0);
    const Flight flight = launch(gun, {1.0, -2.0}, 0.5, shot, gravity);
    Vec3 p = flight.muzzle;
    Vec3 v = flight.velocity_mps;
    EXPECT_NEAR(norm(v), shot.speed_mps, 1e-12);
    constexpr double dt = 1e-4;
    for (int k = 1; k <= 15000; ++k) {
      p = p + dt * v - Vec3{0, 0, 0.5 * gravity * dt * dt};
      v = v - Vec3{0, 0, gravity * dt};
      if (k % 3000 != 0) continue;
      EXPECT_LT(norm(p - flight.position(k * dt)), 1e-9);
      EXPECT_LT(norm(v - flight.velocity(k * dt)), 1e-9);
    }
  }
}

TEST(SpeedThrough, PassesThePointExactly) {
  Rng rng(12);
  int passed = 0;
  int refused = 0;
  for (int i = 0; i < cases(2000); ++i) {
    const GunModel gun;
    const double gravity = rng.uniform(2.0, 15.0);
    const double pitch = rng.uniform(gun.pitch_low_rad, gun.pitch_high_rad);
    const double range = rng.uniform(0.0, 12.0);
    const double height = rng.uniform(-0.5, 3.0);
    const auto speed = speed_through(gun, pitch, range, height, gravity);
    const auto own = OwnGun{gun, gravity}.speed(pitch, range, height);
    ASSERT_EQ(speed.has_value(), own.has_value());
    if (!speed) {
      ++refused;
      continue;
    }
    ++passed;
    EXPECT_NEAR(*speed, *own, 1e-9 * *own);
    const double yaw = rng.uniform(-pi, pi);
    const Flight flight = launch(gun, {}, 1.5, {yaw, pitch, *speed}, gravity);
    const double t = (range - muzzle(gun, pitch).x) / (*speed * std::cos(pitch));
    EXPECT_LT(norm(flight.position(t) - Vec3{range * std::cos(yaw), range * std::sin(yaw), 1.5 + height}),
              1e-9);
  }
  EXPECT_GT(passed, 200);
  EXPECT_GT(refused, 200);
}

}  // namespace
}  // namespace outrider
