#include "outrider/ballistics/moving_target.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "outrider/ballistics/aim.hpp"
#include "outrider/core/rng.hpp"
#include "support/fine_flight.hpp"
#include "support/random_cases.hpp"
#include "support/random_yard.hpp"

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

ShotRules windy_rules(Rng& rng) {
  ShotRules rules = exact_rules();
  rules.air = {rng.uniform(0.005, 0.1), rng.uniform(0.0, 4.0), rng.uniform(-3.0, 3.0)};
  return rules;
}

/// The flight of a shot in air at a walk, in steps of a tenth of a millimetre by the law of air.hpp.
testing::FineEnd fly_in_steps(const ShotRules& rules, Vec2 from, const Shot& shot,
                              const std::vector<Solid>& solids, const Target& target, const Walk& walk,
                              double fired_s, double radius_m) {
  const testing::FineLaw law{rules.gravity_mps2, rules.air.drag_per_m, rules.air.wind()};
  const Flight start = launch(rules.gun, from, 0.0, shot, rules.gravity_mps2);  // the muzzle alone
  const auto to_target = [&](Vec3 p, double after_s) {
    return to_box(p, target, by_hand(walk, fired_s + after_s));
  };
  const auto no_ground = [](Vec3) { return 1e9; };
  return testing::fly_fine(start.muzzle, start.velocity_mps, law, radius_m, solids, to_target, no_ground,
                           -1.0, 1e-4);
}

/// In air, with solids in the way: the same end at the same time as in fine steps.
TEST(MovingTargetInAir, IsTouchedWhenFineStepsSaySo) {
  Rng rng(75);
  int hits = 0, stopped = 0, blown = 0;
  for (int i = 0; i < cases(60); ++i) {
    const ShotRules rules = windy_rules(rng);
    const Target target = random_target(rng);
    const Walk walk = random_walk(rng, xy(target.base));
    const std::vector<Solid> solids{
        testing::floor_at(0), testing::box_at("wall", {rng.uniform(-2.0, 0.0), -1.0, 0.3}, {0.2, 3.0, 0.6})};
    const double fired = rng.uniform(0.0, 6.0);
    const Vec2 aim = walk.at(fired + 0.5) + rng.uniform(0.0, 0.2) * direction(rng.uniform(0.0, 6.28));
    const double pitch = rng.uniform(0.1, 0.75);
    const auto aimed = aim_through(rules, {{-4, -4}, {}}, pitch, {aim.x, aim.y, target.centre().z});
    const Shot shot = aimed ? aimed->shot : Shot{heading_of(aim - Vec2{-4, -4}), pitch, 9.0};
    const Flight flight = launch(rules, {{-4, -4}, {}}, target, shot);
    const Impact impact = fly_at(flight, 0.01, FlightSpace(solids), target, walk, fired, 0.0);
    const auto fine = [&](double radius_m) {
      return fly_in_steps(rules, {-4, -4}, shot, solids, target, walk, fired, radius_m);
    };
    const auto is_same = [&](const testing::FineEnd& end, double slack_s) {
      return end.hit == impact.hit && std::abs(end.time_s - impact.time_s) < slack_s;
    };
    // A graze may go either way: a ball that is a little larger or smaller does what was said.
    const testing::FineEnd end = fine(0.01);
    EXPECT_TRUE(is_same(end, 1e-4) || is_same(fine(0.0102), 2e-3) || is_same(fine(0.0098), 2e-3))
        << i << ": said " << impact.hit << " after " << impact.time_s << " s, flown " << end.hit << " after "
        << end.time_s << " s";
    hits += impact.hit ? 1 : 0;
    stopped += impact.solid ? 1 : 0;
    const Flight still = launch(rules.gun, {-4, -4}, 0.0, shot, rules.gravity_mps2);
    blown += norm(still.position(impact.time_s) - impact.position) > 0.1 ? 1 : 0;
  }
  EXPECT_GT(hits, 5);
  EXPECT_GT(stopped, 5);
  EXPECT_GT(blown, 10);
}

/// In air one who goes straight is met as well.
TEST(MovingTargetInAir, IsMetByTheShotThatLeads) {
  Rng rng(76);
  int led = 0, missed_without = 0;
  for (int i = 0; i < cases(40); ++i) {
    const ShotRules rules = windy_rules(rng);
    const Target target = random_target(rng);
    const Vec2 velocity = rng.uniform(0.1, 1.5) * direction(rng.uniform(0.0, 6.28));
    const Walk walk{{{0.0, xy(target.base)}, {100.0, xy(target.base) + 100.0 * velocity}}};
    const FlightSpace space({});
    const double yaw = rng.uniform(-3.0, 3.0), pitch = rng.uniform(0.0, 0.7), now = rng.uniform(0.0, 1.0);
    const auto shot = led_shot(rules, space, target, walk, {-3, -3}, yaw, pitch, now);
    if (!shot) continue;
    ++led;
    const Shot& s = shot->planned.shot;
    EXPECT_LE(s.speed_mps, rules.gun.muzzle_speed_mps);
    EXPECT_NEAR(shot->fires_s, now + aim_time(rules.gun, wrap_angle(s.yaw_rad - yaw), s.pitch_rad - pitch),
                1e-9);
    // In fine steps a ball of no size comes to the centre of the box when it is said to, and one of the
    // gun's size touches the box when it is said to.
    const auto gap_at_centre = [&] {
      const testing::FineLaw law{rules.gravity_mps2, rules.air.drag_per_m, rules.air.wind()};
      const Flight start = launch(rules.gun, {-3, -3}, 0.0, s, rules.gravity_mps2);
      const Vec2 there = by_hand(walk, shot->meets_s);
      double nearest = 1e9;
      const auto to_centre = [&](Vec3 p, double after_s) {
        if (std::abs(after_s - (shot->meets_s - shot->fires_s)) < 2e-4) {
          nearest = std::min(nearest, norm(p - Vec3{there.x, there.y, target.centre().z}));
        }
        return 1e9;
      };
      testing::fly_fine(
          start.muzzle, start.velocity_mps, law, 0.0, {}, to_centre, [](Vec3) { return 1e9; }, -1.0, 1e-4);
      return nearest;
    };
    EXPECT_LT(gap_at_centre(), 2e-4) << i;
    const auto end =
        fly_in_steps(rules, {-3, -3}, s, {}, target, walk, shot->fires_s, rules.gun.ball_radius_m);
    EXPECT_TRUE(end.hit) << i;
    EXPECT_NEAR(end.time_s, shot->planned.flight_s, 1e-4) << i;
    EXPECT_LT(norm(end.position - shot->planned.contact), 2e-3) << i;
    // The shot of a world without air misses, where the air does much.
    ShotRules vacuum = rules;
    vacuum.air = {};
    const auto without = led_shot(vacuum, space, target, walk, {-3, -3}, yaw, pitch, now);
    if (!without) continue;
    const auto blown = fly_in_steps(rules, {-3, -3}, without->planned.shot, {}, target, walk,
                                    without->fires_s, rules.gun.ball_radius_m);
    missed_without += blown.hit ? 0 : 1;
  }
  EXPECT_GT(led, cases(20));
  EXPECT_GT(missed_without, 5);
}

/// In air one who rests is shot at as a still one, to the bit.
TEST(MovingTargetInAir, ThatRestsIsAStillOne) {
  Rng rng(77);
  for (int i = 0; i < cases(15); ++i) {
    ShotRules rules = windy_rules(rng);
    rules.errors = {};
    const Target target = random_target(rng);
    const Walk walk{{{0.0, xy(target.base)}, {5.0, xy(target.base)}}};
    const double pitch = rng.uniform(0.0, 0.7);
    const auto led = led_shot(rules, FlightSpace({}), target, walk, {-3, -3}, 0.3, pitch, 1.0);
    const auto best = best_shot(rules, FlightSpace({}), target, {-3, -3}, pitch);
    ASSERT_EQ(led.has_value(), best.has_value());
    if (!best) continue;
    EXPECT_EQ(led->planned.shot.yaw_rad, best->shot.yaw_rad);
    EXPECT_EQ(led->planned.shot.pitch_rad, best->shot.pitch_rad);
    EXPECT_EQ(led->planned.shot.speed_mps, best->shot.speed_mps);
    EXPECT_EQ(led->planned.flight_s, best->flight_s);
  }
}

}  // namespace
}  // namespace outrider
