#include "outrider/control/speed_profile.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "outrider/core/units.hpp"
#include "outrider/motion/profile.hpp"
#include "support/random_cases.hpp"

namespace outrider {
namespace {

constexpr PathLimits sideways{0.25, 0.5};
constexpr PathLimits ahead{0.25, 0.5, true, 0.8, 2.0, 12.0, 33.3, 5.0};

std::vector<PathPoint> random_path(Rng& rng, double spacing_m) {
  std::vector<Vec2> corners = {{0, 0}};
  std::vector<double> rooms;
  double bearing = 0.0;
  for (int i = 0; i < 3; ++i) {
    corners.push_back(corners.back() + rng.uniform(0.1, 0.4) * direction(bearing));
    bearing += rng.uniform(-1.8, 1.8);
    if (i < 2) rooms.push_back(rng.uniform(0.005, 0.06));
  }
  return rounded_path(corners, rooms, spacing_m);
}

/// Returns the largest ratio of what a step from speed v to speed w needs to what the limits allow.
double exertion(const PathPoint& a, const PathPoint& b, double v, double w, const PathLimits& limits) {
  const double length_m = b.along_m - a.along_m;
  const double bend = 0.5 * (a.curvature + b.curvature);
  const double along = (w * w - v * v) / (2.0 * length_m);
  double most = std::hypot(along, bend * v * v) / limits.acceleration_mps2;
  if (limits.turns_with_path) {
    const double turning = bend * along + (b.curvature - a.curvature) / length_m * v * v;
    most = std::max(most, std::abs(turning) / limits.turn_acceleration_radps2);
  }
  return most;
}

double speed_share(const PathPoint& a, double v, const PathLimits& limits) {
  double most = v / limits.speed_mps;
  if (limits.turns_with_path) {
    most = std::max({most, std::abs(a.curvature) * v / limits.turn_rate_radps,
                     (limits.per_speed + limits.per_turn * std::abs(a.curvature)) * v / limits.wheel_radps});
  }
  return most;
}

TEST(SpeedProfile, KeepsTheLimits) {
  Rng rng(1);
  for (int round = 0; round < testing::cases(50); ++round) {
    for (const PathLimits& limits : {sideways, ahead}) {
      const auto path = random_path(rng, 0.01);
      const SpeedProfile profile = speed_profile(path, limits);
      EXPECT_EQ(profile.speeds_mps.front(), 0.0);
      EXPECT_EQ(profile.speeds_mps.back(), 0.0);
      for (std::size_t i = 1; i < path.size(); ++i) {
        const double v = profile.speeds_mps[i - 1], w = profile.speeds_mps[i];
        EXPECT_LE(speed_share(path[i], w, limits), 1.0 + 1e-9);
        EXPECT_LE(exertion(path[i - 1], path[i], v, w, limits), 1.0 + 1e-6) << round << ' ' << i;
      }
    }
  }
}

/// The least time by dynamic programming over a grid of speeds at each point: a brute force that knows
/// nothing of passes. It can take only speeds of the grid, so it is never faster, and slower by little if the
/// grid is fine.
double least_time_on_grid(const std::vector<PathPoint>& path, const PathLimits& limits, std::size_t speeds) {
  const double infinite = std::numeric_limits<double>::infinity();
  const auto speed = [&](std::size_t k) {
    return limits.speed_mps * static_cast<double>(k) / static_cast<double>(speeds);
  };
  std::vector<double> to_go(speeds + 1, infinite);
  to_go[0] = 0.0;
  for (std::size_t i = path.size() - 1; i-- > 0;) {
    std::vector<double> here(speeds + 1, infinite);
    const double length_m = path[i + 1].along_m - path[i].along_m;
    for (std::size_t v = 0; v <= speeds; ++v) {
      if (speed_share(path[i], speed(v), limits) > 1.0) break;
      for (std::size_t w = 0; w <= speeds; ++w) {
        if (v + w == 0 || std::isinf(to_go[w])) continue;
        if (exertion(path[i], path[i + 1], speed(v), speed(w), limits) > 1.0) continue;
        here[v] = std::min(here[v], to_go[w] + 2.0 * length_m / (speed(v) + speed(w)));
      }
    }
    to_go = std::move(here);
  }
  return to_go[0];
}

TEST(SpeedProfile, IsAsFastAsABruteForceOverSpeeds) {
  Rng rng(2);
  for (int round = 0; round < testing::cases(4); ++round) {
    for (const PathLimits& limits : {sideways, ahead}) {
      const auto path = random_path(rng, 0.02);
      const double time_s = speed_profile(path, limits).times_s.back();
      const double coarse_s = least_time_on_grid(path, limits, 75);
      const double fine_s = least_time_on_grid(path, limits, 300);
      EXPECT_LE(time_s, fine_s + 1e-9) << round;
      EXPECT_LE(fine_s, coarse_s + 1e-9);
      EXPECT_LE(fine_s, 1.03 * time_s) << round << ' ' << limits.turns_with_path;
    }
  }
}

TEST(SpeedProfile, OnAStraightPathIsATrapezoid) {
  for (const double length_m : {0.05, 0.2, 3.0}) {
    const auto path = rounded_path({{0, 0}, {length_m, 0}}, {}, 0.002);
    EXPECT_NEAR(speed_profile(path, sideways).times_s.back(), duration(length_m, {0.25, 0.5}), 1e-2);
  }
}

TEST(SpeedProfile, TheGreatestSpeedOfABend) {
  EXPECT_NEAR(greatest_speed(20.0, 0.0, sideways), std::sqrt(0.5 / 20.0), 1e-9);
  EXPECT_NEAR(greatest_speed(1.0, 0.0, sideways), 0.25, 1e-12);
  EXPECT_NEAR(greatest_speed(8.0, 0.0, ahead), 0.1, 1e-9) << "the turn rate";
  EXPECT_NEAR(greatest_speed(0.0, 200.0, ahead), 0.1, 1e-9) << "the turn acceleration";
  PathLimits wheels = ahead;
  wheels.wheel_radps = 4.0;
  EXPECT_NEAR(greatest_speed(0.0, 0.0, wheels), 4.0 / 33.3, 1e-9);
}

}  // namespace
}  // namespace outrider
