#include "outrider/ballistics/moving_target.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "outrider/core/rng.hpp"
#include "support/random_cases.hpp"

namespace outrider {
namespace {

using testing::cases;

ShotRules exact_rules() {
  ShotRules rules;
  rules.errors = {0.0, 0.0};
  return rules;
}

Target random_target(Rng& rng) {
  return {"fox",
          {rng.uniform(-3.0, 3.0), rng.uniform(-3.0, 3.0), 0.0},
          {rng.uniform(0.2, 0.6), rng.uniform(0.15, 0.5), rng.uniform(0.2, 0.5)},
          rng.uniform(-3.0, 3.0)};
}

Walk random_walk(Rng& rng, Vec2 from) {
  Walk walk{{{0.0, from}}};
  for (double t = 0.0; t < 12.0;) {
    t += rng.uniform(0.1, 1.5);
    const Vec2 step = rng.below(3) == 0 ? Vec2{} : rng.uniform(0.0, 2.0) * direction(rng.uniform(0.0, 6.28));
    walk.knots.push_back({t, walk.knots.back().position + step});
  }
  return walk;
}

/// Distance from a point to an upright turned box, by hand.
double to_box(Vec3 p, const Target& target, Vec2 place) {
  const double dx = p.x - place.x, dy = p.y - place.y;
  const double c = std::cos(target.yaw_rad), s = std::sin(target.yaw_rad);
  const double along = std::max(0.0, std::abs(c * dx + s * dy) - 0.5 * target.size.x);
  const double across = std::max(0.0, std::abs(-s * dx + c * dy) - 0.5 * target.size.y);
  const double up = std::max({0.0, target.base.z - p.z, p.z - target.base.z - target.size.z});
  return std::sqrt(along * along + across * across + up * up);
}

Vec2 by_hand(const Walk& walk, double t) {
  for (std::size_t i = walk.knots.size() - 1; i > 0; --i) {
    const auto& a = walk.knots[i - 1];
    const auto& b = walk.knots[i];
    if (t >= b.time_s) return b.position;
    if (t >= a.time_s) {
      const double share = (t - a.time_s) / (b.time_s - a.time_s);
      return {(1 - share) * a.position.x + share * b.position.x,
              (1 - share) * a.position.y + share * b.position.y};
    }
  }
  return walk.knots.front().position;
}

/// The first touch of a moving box, by steps of 20 microseconds.
TEST(MovingTarget, IsTouchedWhenFineStepsSaySo) {
  Rng rng(71);
  int hits = 0;
  for (int i = 0; i < cases(150); ++i) {
    const Target target = random_target(rng);
    const Walk walk = random_walk(rng, xy(target.base));
    const double fired = rng.uniform(0.0, 6.0);
    const Vec2 aim = walk.at(fired + 0.5) + rng.uniform(0.0, 0.3) * direction(rng.uniform(0.0, 6.28));
    const Shot shot{heading_of(aim - Vec2{-4, -4}), rng.uniform(0.05, 0.75), rng.uniform(6.0, 10.0)};
    const Flight flight = launch(GunModel{}, {-4, -4}, 0.0, shot, 9.8);
    const Impact impact = fly_at(flight, 0.01, FlightSpace({}), target, walk, fired, 0.0);
    constexpr double step_s = 2e-5;
    double touched = -1.0, nearest = 1e9;
    for (double t = 0.0; t < impact.time_s + 0.01; t += step_s) {
      const double gap = to_box(flight.position(t), target, by_hand(walk, fired + t)) - 0.01;
      nearest = std::min(nearest, gap);
      if (gap > 0.0) continue;
      touched = t;
      break;
    }
    if (impact.hit) {
      ++hits;
      // A graze may pass between two steps.
      EXPECT_LT(nearest, 14.0 * step_s);
      if (touched >= 0.0) {
        EXPECT_NEAR(impact.time_s, touched, 2 * step_s);
      }
    } else {
      EXPECT_LT(touched, 0.0);
    }
  }
  EXPECT_GT(hits, 5);
}

/// One who goes straight is met: the ball passes the centre of the box where it is then.
TEST(MovingTarget, IsMetByTheShotThatLeads) {
  Rng rng(72);
  int led = 0;
  for (int i = 0; i < cases(300); ++i) {
    const Target target = random_target(rng);
    const Vec2 velocity = rng.uniform(0.1, 2.0) * direction(rng.uniform(0.0, 6.28));
    const Walk walk{{{0.0, xy(target.base)}, {100.0, xy(target.base) + 100.0 * velocity}}};
    const ShotRules rules = exact_rules();
    const FlightSpace space({});
    const double yaw = rng.uniform(-3.0, 3.0), pitch = rng.uniform(0.0, 0.7), now = rng.uniform(0.0, 3.0);
    const auto shot = led_shot(rules, space, target, walk, {-4, -4}, yaw, pitch, now);
    if (!shot) continue;
    ++led;
    const Shot& s = shot->planned.shot;
    EXPECT_NEAR(shot->fires_s, now + aim_time(rules.gun, wrap_angle(s.yaw_rad - yaw), s.pitch_rad - pitch),
                1e-9);
    const Flight flight = launch(rules.gun, {-4, -4}, 0.0, s, rules.gravity_mps2);
    const Vec3 ball = flight.position(shot->meets_s - shot->fires_s);
    const Vec2 there = by_hand(walk, shot->meets_s);
    EXPECT_NEAR(ball.x, there.x, 1e-8);
    EXPECT_NEAR(ball.y, there.y, 1e-8);
    EXPECT_NEAR(ball.z, target.centre().z, 1e-8);
    EXPECT_TRUE(fly_at(flight, 0.01, space, target, walk, shot->fires_s, 0.0).hit);
    // Without the lead it is missed, where it has gone on by more than its size.
    const auto still = best_shot(rules, space, moved_to(target, walk.at(now)), {-4, -4}, pitch);
    if (still && norm(velocity) * (shot->meets_s - now) > 2.5) {
      const Flight late = launch(rules.gun, {-4, -4}, 0.0, still->shot, rules.gravity_mps2);
      EXPECT_FALSE(fly_at(late, 0.01, space, target, walk, shot->fires_s, 0.0).hit);
    }
  }
  EXPECT_GT(led, 150);
}

/// At rest it is the still case, to the bit.
TEST(MovingTarget, ThatRestsIsAStillOne) {
  Rng rng(73);
  for (int i = 0; i < cases(100); ++i) {
    const Target target = random_target(rng);
    const Walk walk{{{0.0, xy(target.base)}, {5.0, xy(target.base)}}};
    const ShotRules rules;
    const FlightSpace space({});
    const double pitch = rng.uniform(0.0, 0.7);
    const auto led = led_shot(rules, space, target, walk, {-4, -4}, 0.3, pitch, 1.0);
    const auto best = best_shot(rules, space, target, {-4, -4}, pitch);
    ASSERT_EQ(led.has_value(), best.has_value());
    if (!best) continue;
    EXPECT_EQ(led->planned.shot.yaw_rad, best->shot.yaw_rad);
    EXPECT_EQ(led->planned.shot.pitch_rad, best->shot.pitch_rad);
    EXPECT_EQ(led->planned.shot.speed_mps, best->shot.speed_mps);
    EXPECT_EQ(led->planned.flight_s, best->flight_s);
    const Flight flight = launch(rules.gun, {-4, -4}, 0.0, best->shot, rules.gravity_mps2);
    EXPECT_NEAR(fly_at(flight, 0.01, space, target, walk, led->fires_s, 0.0).time_s,
                fly(flight, 0.01, space, target, 0.0).time_s, 1e-6);
  }
}

}  // namespace
}  // namespace outrider
