#include "outrider/ballistics/shot.hpp"

#include <gtest/gtest.h>

#include "support/fine_flight.hpp"
#include "support/random_cases.hpp"
#include "support/random_yard.hpp"

namespace outrider {
namespace {

using testing::box_at;
using testing::cases;
using testing::floor_at;
using testing::OwnGun;
using testing::random_small_yard;

TEST(Fly, EndsWhereTheFineFlightEnds) {
  Rng rng(51);
  int hits = 0;
  int stopped = 0;
  for (int i = 0; i < cases(150); ++i) {
    const auto yard = random_small_yard(rng, 7, 1.5);
    const FlightSpace space(yard.solids);
    const ShotRules rules;
    const Vec2 place = 2.2 * direction(rng.uniform(-pi, pi));
    const Vec2 sight = xy(yard.target.base) - place;
    const Shot shot{heading_of(sight) + rng.uniform(-0.1, 0.1), rng.uniform(-0.1, 0.7),
                    rng.uniform(3.0, 7.0)};
    const Flight flight = launch(rules.gun, place, 0.0, shot, 9.8);
    const Impact impact = fly(flight, 0.01, space, yard.target, 0.0);
    const Solid target = solid_of(yard.target);
    const auto fine = OwnGun{}.shoot(place, shot, yard.solids, &target, -1.0);
    if (std::abs(impact.time_s - fine.time_s) * 10.0 > 1e-3) {  // steps may pass a grazing contact
      EXPECT_LT(impact.time_s, fine.time_s);
      continue;
    }
    EXPECT_EQ(impact.hit, fine.hit);
    EXPECT_EQ(impact.solid, fine.solid);
    EXPECT_LT(norm(impact.position - fine.position), 1e-3);
    hits += impact.hit ? 1 : 0;
    stopped += impact.solid ? 1 : 0;
  }
  EXPECT_GT(hits, 10);
  EXPECT_GT(stopped, 50);
}

TEST(Fly, IsLostBelowAWorldWithoutAFloor) {
  const Target target{"cat", {5, 0, 0}, {0.1, 0.1, 0.1}, 0.0};
  const Impact impact = fly({{0, 0, 1}, {1, 0, 0}, 9.8}, 0.01, FlightSpace({}), target, 0.0);
  EXPECT_FALSE(impact.hit);
  EXPECT_FALSE(impact.solid.has_value());
  EXPECT_NEAR(impact.position.z, -1.0, 1e-9);
}

TEST(ClearOf, IsTheDistanceToTheFootprint) {
  Rng rng(52);
  const ShotRules rules;
  for (int i = 0; i < cases(2000); ++i) {
    const Target target{"t", {rng.normal(), rng.normal(), 3.0}, {0.5, 0.2, 0.3}, rng.uniform(-pi, pi)};
    const Vec2 p = xy(target.base) + Vec2{rng.uniform(-1, 1), rng.uniform(-1, 1)};
    const double apart = testing::own_distance({p.x, p.y, 3.1}, solid_of(target));
    if (std::abs(apart - rules.standoff_m) < 1e-9) continue;
    EXPECT_EQ(clear_of(rules, target, p), apart > rules.standoff_m);
  }
}

/// How far off the largest errors put a shot at the centre, as a part of what the box forgives: sampled,
/// each axis alone.
double sampled_spread(const ShotRules& rules, const Target& target, Vec2 place, const Shot& shot) {
  const double range = distance(place, xy(target.base));
  const OwnGun gun{rules.gun, rules.gravity_mps2};
  const auto height = [&](double pitch, double speed) {
    const double s = range - gun.ahead(pitch);
    const double t = s / (speed * std::cos(pitch));
    return gun.above(pitch) + speed * std::sin(pitch) * t - 0.5 * rules.gravity_mps2 * t * t;
  };
  const double z = height(shot.pitch_rad, shot.speed_mps);
  double vertical = 0.0;
  for (const double a : {-1.0, 1.0}) {
    for (const double b : {-1.0, 1.0}) {
      const double off = height(shot.pitch_rad + a * rules.errors.gun_rad,
                                shot.speed_mps * (1.0 + b * rules.errors.speed_ratio));
      vertical = std::max(vertical, std::abs(off - z));
    }
  }
  const double t = (range - gun.ahead(shot.pitch_rad)) / (shot.speed_mps * std::cos(shot.pitch_rad));
  const double slope =
      std::tan(shot.pitch_rad) - rules.gravity_mps2 * t / (shot.speed_mps * std::cos(shot.pitch_rad));
  // The chord through the centre and the outline across, from the corners.
  const Solid box = solid_of(target);
  const Vec2 along = direction(shot.yaw_rad);
  double across = 0.0;
  for (const double x : {-0.5, 0.5}) {
    for (const double y : {-0.5, 0.5}) {
      const Vec3 corner = box.world_T_solid * Vec3{x * target.size.x, y * target.size.y, 0};
      across = std::max(across, cross(along, xy(corner) - xy(target.base)));
    }
  }
  double chord = 0.0;
  while (testing::own_distance(
             {target.base.x + chord * along.x, target.base.y + chord * along.y, target.centre().z}, box) ==
         0.0) {
    chord += 1e-4;
  }
  return std::max(vertical / (0.5 * target.size.z + chord * std::abs(slope) + 0.01),
                  range * rules.errors.gun_rad / (across + 0.01));
}

TEST(Spread, IsTheSampledDeviation) {
  Rng rng(53);
  const ShotRules rules;
  int compared = 0;
  for (int i = 0; i < cases(400); ++i) {
    const Target target = random_small_yard(rng, 0, 1.0).target;
    const Vec2 place = xy(target.base) + testing::random_offset(rng, 0.8, 8.0);
    const Vec2 sight = xy(target.base) - place;
    const double pitch = rng.uniform(rules.gun.pitch_low_rad, rules.gun.pitch_high_rad);
    const auto speed = speed_through(rules.gun, pitch, norm(sight), target.centre().z, 9.8);
    if (!speed) continue;
    ++compared;
    const Shot shot{heading_of(sight), pitch, *speed};
    const double sampled = sampled_spread(rules, target, place, shot);
    EXPECT_NEAR(error_ratio(rules, target, place, shot), sampled, 0.08 * sampled + 1e-3);
  }
  EXPECT_GT(compared, 100);
}

/// Errors drawn within their bounds, a thousand to a shot that says it survives them.
TEST(BestShot, ThatSurvivesHitsUnderNextToAllErrors) {
  Rng rng(54);
  const ShotRules rules;
  int survivors = 0;
  for (int i = 0; i < cases(60); ++i) {
    const auto yard = random_small_yard(rng, 6, 1.8);
    const FlightSpace space(yard.solids);
    const Vec2 place = testing::random_offset(rng, 1.2, 4.0);
    const auto best = best_shot(rules, space, yard.target, place, 0.0);
    if (!best || !best->survives) continue;
    ++survivors;
    int missed = 0;
    for (int k = 0; k < 1000; ++k) {
      const Shot off{best->shot.yaw_rad + rng.uniform(-0.01, 0.01),
                     best->shot.pitch_rad + rng.uniform(-0.01, 0.01),
                     best->shot.speed_mps * rng.uniform(0.99, 1.01)};
      const Flight flight = launch(rules.gun, place, 0.0, off, 9.8);
      missed += fly(flight, 0.01, space, yard.target, 0.0).hit ? 0 : 1;
    }
    EXPECT_LE(missed, 5) << i;  // the corners hit; a few errors between them may not
  }
  EXPECT_GT(survivors, 20);
}

TEST(BestShot, IsFlownExactlyAndKeepsItsPromises) {
  Rng rng(55);
  const ShotRules rules;
  int found = 0;
  for (int i = 0; i < cases(60); ++i) {
    const auto yard = random_small_yard(rng, 7, 1.5);
    const FlightSpace space(yard.solids);
    const Vec2 place = testing::random_offset(rng, 1.0, 2.5);
    const auto best = best_shot(rules, space, yard.target, place, 0.2);
    if (!clear_of(rules, yard.target, place)) {
      EXPECT_FALSE(best.has_value());
    }
    if (!best) continue;
    ++found;
    const Solid target = solid_of(yard.target);
    const auto fine = OwnGun{}.shoot(place, best->shot, yard.solids, &target, -1.0);
    EXPECT_TRUE(fine.hit);
    EXPECT_LT(norm(fine.position - best->contact), 5e-4);
    EXPECT_NEAR(fine.time_s, best->flight_s, 2e-4);
    EXPECT_GE(fine.gap_m, rules.margin_m - 3e-4);
    EXPECT_NEAR(std::min(fine.gap_m, 0.1), std::min(best->clearance_m, 0.1), 4e-4);
    EXPECT_LE(best->shot.speed_mps, rules.gun.muzzle_speed_mps);
    EXPECT_GE(best->shot.pitch_rad, rules.gun.pitch_low_rad - 1e-12);
    EXPECT_LE(best->shot.pitch_rad, rules.gun.pitch_high_rad + 1e-12);
  }
  EXPECT_GT(found, 30);
}

/// In the open every aim flies, so the soonest of those that forgive is known.
TEST(BestShot, TakesThePitchThatIsSoonestFromWhereTheBarrelIs) {
  const ShotRules rules;
  const FlightSpace space({floor_at(0.0)});
  const Target target{"cat", {3.0, 0, 0}, {0.5, 0.205, 0.372}, pi / 2};
  for (const double barrel : {-0.4, 0.0, 0.3, 0.7}) {
    const auto best = best_shot(rules, space, target, {}, barrel);
    ASSERT_TRUE(best.has_value());
    EXPECT_TRUE(best->survives);
    const auto time = [&](const Shot& s, double flight_s) {
      return flight_s + aim_time(rules.gun, 0.0, s.pitch_rad - barrel);
    };
    const OwnGun gun;
    for (int k = 0; k <= 150; ++k) {
      const double pitch = radians(-30.0 + 0.5 * k);
      const auto speed = gun.speed(pitch, 3.0, target.centre().z);
      if (!speed) continue;
      const Shot other{0.0, pitch, *speed};
      if (error_ratio(rules, target, {}, other) > 0.7) continue;
      const Impact impact = fly(launch(rules.gun, {}, 0.0, other, 9.8), 0.01, space, target, 0.0);
      ASSERT_TRUE(impact.hit);
      // The chosen one is judged at its aim point, the contact is a little before.
      EXPECT_LE(time(best->shot, best->flight_s), time(other, impact.time_s) + 0.05) << pitch;
    }
  }
}

TEST(BestShot, SaysWhenThereIsNone) {
  const ShotRules rules;
  const Target target{"cat", {3.0, 0, 0}, {0.5, 0.205, 0.372}, 0.0};
  std::vector<Solid> hut{floor_at(0.0)};
  for (const double y : {-0.5, 0.5}) hut.push_back(box_at("side", {3, y, 0.5}, {1.4, 0.05, 1.0}));
  for (const double x : {2.3, 3.7}) hut.push_back(box_at("end", {x, 0, 0.5}, {0.05, 1.0, 1.0}));
  hut.push_back(box_at("roof", {3, 0, 1.0}, {1.5, 1.1, 0.05}));
  EXPECT_FALSE(best_shot(rules, FlightSpace(hut), target, {}, 0.0).has_value());
  EXPECT_FALSE(best_shot(rules, FlightSpace({floor_at(0)}), target, {-20, 0}, 0.0).has_value());
  EXPECT_FALSE(best_shot(rules, FlightSpace({floor_at(0)}), target, {3.0, 0.0}, 0.0).has_value());
  ShotRules anywhere = rules;
  anywhere.standoff_m = 0.0;
  EXPECT_FALSE(best_shot(anywhere, FlightSpace({floor_at(0)}), target, {3.0, 0.0}, 0.0).has_value());
}

}  // namespace
}  // namespace outrider
