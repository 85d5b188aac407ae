// Aims, firing regions and best shots where the air slows the ball and the wind carries it.
#include <gtest/gtest.h>

#include <algorithm>

#include "outrider/ballistics/aim.hpp"
#include "outrider/ballistics/firing_region.hpp"
#include "outrider/ballistics/sight.hpp"
#include "support/costly_cases.hpp"
#include "support/random_cases.hpp"
#include "support/random_yard.hpp"

namespace outrider {
namespace {

using testing::box_at;
using testing::cases;
using testing::floor_at;
using testing::random_small_yard;

ShotRules windy(Rng& rng) {
  ShotRules rules;
  rules.air = {rng.uniform(0.005, 0.1), rng.uniform(0.0, 5.0), rng.uniform(-pi, pi)};
  return rules;
}

Platform random_platform(Rng& rng, double speed) {
  return {testing::random_point(rng, 2.0), speed * direction(rng.uniform(-pi, pi))};
}

Shot random_shot(Rng& rng, const GunModel& gun) {
  return {rng.uniform(-pi, pi), rng.uniform(gun.pitch_low_rad, gun.pitch_high_rad), rng.uniform(3.0, 10.0)};
}

TEST(Arrival, IsOnTheTrackAndItsChangesAreDifferences) {
  Rng rng(311);
  for (int i = 0; i < cases(200); ++i) {
    ShotRules rules = windy(rng);
    if (i % 4 == 0) rules.air = {};
    const Platform from = random_platform(rng, rng.uniform(0.0, 3.0));
    const Shot shot = random_shot(rng, rules.gun);
    const double t = rng.uniform(0.1, 1.5);
    const Arrival at = arrival(rules, from, shot, t);
    const Target deep{"deep", {0, 0, -30}, {1, 1, 1}};
    const Flight flight = launch(rules, from, deep, shot);
    EXPECT_LT(norm(at.position - flight.position(t)), 1e-5);
    EXPECT_LT(norm(at.velocity_mps - flight.velocity(t)), 1e-4);
    const auto change = [&](double yaw, double pitch, double speed) {
      const auto there = [&](double sign) {
        return arrival(
                   rules, from,
                   {shot.yaw_rad + sign * yaw, shot.pitch_rad + sign * pitch, shot.speed_mps + sign * speed},
                   t)
            .position;
      };
      return 0.5e5 * (there(1.0) - there(-1.0));
    };
    EXPECT_LT(norm(at.by_yaw - change(1e-5, 0, 0)), 1e-6);
    EXPECT_LT(norm(at.by_pitch - change(0, 1e-5, 0)), 1e-6);
    EXPECT_LT(norm(at.by_speed - change(0, 0, 1e-5)), 1e-6);
  }
}

TEST(AimThrough, FindsTheShotThatPassesAPointWhereverAShotDoes) {
  Rng rng(312);
  int found = 0;
  for (int i = 0; i < cases(1000); ++i) {
    ShotRules rules = windy(rng);
    if (i % 4 == 0) rules.air = {};
    const Platform from = random_platform(rng, i % 2 == 0 ? rng.uniform(0.0, 1.5) : 0.0);
    const Shot shot = random_shot(rng, rules.gun);
    const double t = rng.uniform(0.2, 1.2);
    const Vec3 point = arrival(rules, from, shot, t).position;  // some shot passes it
    if (distance(xy(point), from.position) < 1.0) continue;
    const auto aimed = aim_through(rules, from, shot.pitch_rad, point);
    ASSERT_TRUE(aimed.has_value()) << i;
    ++found;
    const Target deep{"deep", {0, 0, -30}, {1, 1, 1}};
    const Flight flight = launch(rules, from, deep, aimed->shot);
    EXPECT_LT(norm(flight.position(aimed->flight_s) - point), 2e-5);
    const auto again = aim_through(rules, from, shot.pitch_rad, point + Vec3{0.05, -0.05, 0.02}, &*aimed);
    if (again) {
      EXPECT_NEAR(wrap_angle(again->shot.yaw_rad - aimed->shot.yaw_rad), 0.0, 0.2);
    }
  }
  EXPECT_GT(found, cases(700));
}

TEST(AimThrough, WithoutAirFromRestIsTheParabola) {
  Rng rng(313);
  const ShotRules rules;
  int aims = 0;
  for (int i = 0; i < cases(500); ++i) {
    const Vec2 place = testing::random_point(rng, 8.0);
    const Vec3 point{0.0, 0.0, rng.uniform(0.0, 1.5)};
    const double pitch = rng.uniform(rules.gun.pitch_low_rad, rules.gun.pitch_high_rad);
    const auto speed = speed_through(rules.gun, pitch, norm(place), point.z, rules.gravity_mps2);
    const auto aimed = aim_through(rules, {place, {}}, pitch, point);
    if (speed && *speed < 0.999 * rules.gun.muzzle_speed_mps) {
      ASSERT_TRUE(aimed.has_value());
      ++aims;
      EXPECT_NEAR(aimed->shot.speed_mps, *speed, 1e-4);
      EXPECT_NEAR(wrap_angle(aimed->shot.yaw_rad - heading_of(-place)), 0.0, 1e-6);
      const Target centred{"fox", {0.0, 0.0, point.z - 0.15}, {0.4, 0.2, 0.3}, 0.3};
      EXPECT_NEAR(error_ratio(rules, centred, *aimed), error_ratio(rules, centred, place, aimed->shot), 1e-4);
    }
    if (!speed) {
      EXPECT_FALSE(aimed.has_value());
    }
  }
  EXPECT_GT(aims, 50);
}

/// Returns true if a shot that passes the centre at that pitch hits with `margin` to spare, flown exactly;
/// aimed afresh, in still air by halving the speed.
bool hits(const ShotRules& rules, const FlightSpace& space, const Target& target, Vec2 place, double pitch,
          double margin) {
  Shot shot{heading_of(xy(target.base) - place), pitch, rules.gun.muzzle_speed_mps};
  if (rules.air.wind_mps == 0.0) {
    const double range = distance(place, xy(target.base));
    const auto passes_over = [&](double speed) {
      shot.speed_mps = speed;
      const Flight flight = launch(rules, {place, {}}, target, shot);
      double low = 0.0;
      double high = flight.in_air->end_s();
      for (int i = 0; i < 50; ++i) {
        const double t = 0.5 * (low + high);
        (distance(xy(flight.position(t)), place) < range ? low : high) = t;
      }
      return flight.position(low).z >= target.centre().z;
    };
    if (!passes_over(rules.gun.muzzle_speed_mps) || passes_over(0.1)) return false;
    double low = 0.1;
    double high = rules.gun.muzzle_speed_mps;
    for (int i = 0; i < 50; ++i) {
      const double middle = 0.5 * (low + high);
      (passes_over(middle) ? high : low) = middle;
    }
    shot.speed_mps = high;
  } else {
    const Vec3 centre = target.centre();
    const auto aimed = aim_through(rules, {place, {}}, pitch, centre);
    if (!aimed) return false;
    shot = aimed->shot;
  }
  const Flight flight = launch(rules, {place, {}}, target, shot);
  const auto touch =
      contact_time(flight, rules.gun.ball_radius_m, solid_of(target), 0.0, flight.in_air->end_s());
  return touch && !space.first_contact(flight, rules.gun.ball_radius_m + margin, *touch);
}

/// Every cell and pitch of small yards. Within 2 mm of the margin either answer is right.
TEST(RegionInAir, IsWhatBruteForceFinds) {
  Rng rng(314);
  int hit = 0;
  int blocked = 0;
  for (int i = 0; i < std::max(2, testing::costly_cases(6)); ++i) {
    ShotRules rules = windy(rng);
    if (i % 2 == 0) rules.air.wind_mps = 0.0;
    rules.pitch_step_rad = radians(7.5);
    const auto yard = random_small_yard(rng, 6, 2.0);
    const FlightSpace space(yard.solids);
    GridFrame frame;
    frame.origin = {-7.0, -7.0};
    frame.resolution_m = 1.0;
    frame.width = frame.height = 14;
    const std::vector<std::uint8_t> standable(frame.size(), 1);
    const FiringRegion region = firing_region(rules, space, yard.target, frame, standable);
    const auto pitches = pitch_lattice(rules);
    for (std::size_t cell = 0; cell < frame.size(); ++cell) {
      const Vec2 place = frame.centre(frame.cell(cell));
      if (!clear_of(rules, yard.target, place)) continue;
      bool surely = false;
      bool perhaps = false;
      for (const double pitch : pitches) {
        surely = surely || hits(rules, space, yard.target, place, pitch, rules.margin_m + 0.002);
        perhaps = perhaps || surely || hits(rules, space, yard.target, place, pitch, rules.margin_m - 0.002);
      }
      const bool found = region.pitch[cell] != FiringRegion::no_shot;
      EXPECT_TRUE(found || !surely) << i << " " << cell;
      EXPECT_TRUE(!found || perhaps) << i << " " << cell;
      if (found) {
        EXPECT_TRUE(
            hits(rules, space, yard.target, place, pitches[region.pitch[cell]], rules.margin_m - 0.002));
      }
      hit += found ? 1 : 0;
      blocked += found ? 0 : 1;
    }
  }
  if (!testing::in_full()) return;
  EXPECT_GT(hit, 150);
  EXPECT_GT(blocked, 150);
}

TEST(ExhaustInAir, FindsAWayInWhereThereIsOne) {
  Rng rng(315);
  ShotRules rules = windy(rng);
  rules.pitch_step_rad = radians(7.5);
  rules.aim_step_m = 0.1;
  const Target fox{"fox", {0, 0, 0}, {0.4, 0.3, 0.3}, 0.0};
  const std::vector<Solid> walls{floor_at(0.0), box_at("west", {-0.5, 0, 0.5}, {0.05, 1.1, 1.0}),
                                 box_at("south", {0, -0.5, 0.5}, {1.1, 0.05, 1.0}),
                                 box_at("north", {0, 0.5, 0.5}, {1.1, 0.05, 1.0}),
                                 box_at("roof", {0, 0, 1.0}, {1.1, 1.1, 0.05})};
  GridFrame frame;
  frame.origin = {-4.0, -4.0};
  frame.resolution_m = 0.5;
  frame.width = frame.height = 16;
  std::vector<std::uint8_t> standable(frame.size(), 1);
  const auto open = exhaust(rules, FlightSpace(walls), fox, frame, standable);
  ASSERT_TRUE(open.found.has_value());
  EXPECT_GT(frame.centre(frame.cell(*open.found)).x, 0.0);  // the side without a wall
  const Flight flight = launch(rules, {frame.centre(frame.cell(*open.found)), {}}, fox, open.shot);
  EXPECT_TRUE(fly(flight, rules.gun.ball_radius_m, FlightSpace(walls), fox, 0.0).hit);

  std::vector<Solid> shut = walls;
  shut.push_back(box_at("east", {0.5, 0, 0.5}, {0.05, 1.1, 1.0}));
  const auto none = exhaust(rules, FlightSpace(shut), fox, frame, standable);
  EXPECT_FALSE(none.found.has_value());
  EXPECT_GT(none.places, 50U);
  std::uint64_t stopped = 0;
  for (const std::uint64_t flights : none.blocked_by) stopped += flights;
  EXPECT_EQ(stopped, none.flights);
}

TEST(LongestRangeInAir, BoundsEveryShotAtThePitchesTried) {
  Rng rng(316);
  for (int i = 0; i < cases(20); ++i) {
    const ShotRules rules = windy(rng);
    const Target fox{"fox", {0, 0, rng.uniform(0.0, 1.0)}, {0.4, 0.3, 0.3}, 0.0};
    const double longest = longest_range(rules, fox);
    double far = 0.0;
    for (int k = 0; k < 300; ++k) {
      Shot shot = random_shot(rng, rules.gun);
      shot.speed_mps = rules.gun.muzzle_speed_mps;
      const Flight flight = launch(rules, {}, fox, shot);
      const double reach = norm(xy(flight.position(fall_time(flight, fox.base.z))));
      EXPECT_LE(reach, longest);
      far = std::max(far, reach);
    }
    EXPECT_GT(far, 0.85 * longest - 0.5);
  }
}

TEST(BestShotInAir, ThatSurvivesHitsUnderRandomErrors) {
  Rng rng(317);
  int survived = 0;
  for (int i = 0; i < cases(25); ++i) {
    const ShotRules rules = windy(rng);
    const auto yard = random_small_yard(rng, 5, 2.5);
    const FlightSpace space(yard.solids);
    const Vec2 place = xy(yard.target.base) + testing::random_offset(rng, 1.5, 6.0);
    const auto best = best_shot(rules, space, yard.target, place, 0.0);
    if (!best) continue;
    const auto flown = [&](const Shot& shot) {
      return fly(launch(rules, {place, {}}, yard.target, shot), rules.gun.ball_radius_m, space, yard.target,
                 0.0);
    };
    const Impact impact = flown(best->shot);
    EXPECT_TRUE(impact.hit);
    EXPECT_NEAR(impact.time_s, best->flight_s, 1e-9);
    EXPECT_GE(best->clearance_m, rules.margin_m - 1e-4);
    if (!best->survives) continue;
    ++survived;
    int hits = 0;
    for (int k = 0; k < 200; ++k) {
      const auto part = [&] { return rng.uniform(-1.0, 1.0); };
      hits += flown({best->shot.yaw_rad + part() * rules.errors.gun_rad,
                     best->shot.pitch_rad + part() * rules.errors.gun_rad,
                     best->shot.speed_mps * (1.0 + part() * rules.errors.speed_ratio)})
                      .hit
                  ? 1
                  : 0;
    }
    EXPECT_GE(hits, 198);
  }
  EXPECT_GT(survived, 5);
}

}  // namespace
}  // namespace outrider
