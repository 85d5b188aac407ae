#include "outrider/ballistics/firing_region.hpp"

#include <gtest/gtest.h>

#include "outrider/ballistics/sight.hpp"
#include "support/costly_cases.hpp"
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
using testing::SmallYard;

constexpr double step_m = 1e-3;    // of the brute force
constexpr double unsure_m = 1e-3;  // of its distances, then

GridFrame small_frame() { return covering({{-2.0, -2.0}, {2.0, 2.0}}, 0.4); }

/// A shot of the brute force: it surely keeps the margin and hits, it surely does not, or neither.
enum class Verdict { flies, stopped, unsure };

Verdict judge(const OwnGun& gun, const ShotRules& rules, const SmallYard& yard, Vec2 from, const Shot& shot) {
  const Solid target = solid_of(yard.target);
  const auto end = gun.shoot(from, shot, yard.solids, &target, -0.5, step_m);
  if (end.hit && end.gap_m > rules.margin_m + unsure_m) return Verdict::flies;
  if (end.gap_m < rules.margin_m - unsure_m || (!end.hit && !end.solid)) return Verdict::stopped;
  return Verdict::unsure;
}

TEST(FiringRegion, IsWhatBruteForceFindsPitchByPitch) {
  Rng rng(41);
  const ShotRules rules;
  const OwnGun gun{rules.gun};
  const GridFrame frame = small_frame();
  const std::vector<std::uint8_t> everywhere(frame.size(), 1);
  std::size_t with = 0;
  std::size_t without = 0;
  std::size_t unsure = 0;
  for (int i = 0; i < cases(16); ++i) {
    const SmallYard yard = random_small_yard(rng, 6 + static_cast<std::size_t>(i) % 5, 1.6);
    const FlightSpace space(yard.solids);
    const auto region = firing_region(rules, space, yard.target, frame, everywhere);
    EXPECT_EQ(region.places, frame.size());
    std::size_t hits = 0;
    for (std::size_t c = 0; c < frame.size(); ++c) {
      const Vec2 place = frame.centre(frame.cell(c));
      const Vec2 sight = xy(yard.target.base) - place;
      const bool has = region.pitch[c] != FiringRegion::no_shot;
      hits += has ? 1 : 0;
      // The standoff, by the distance to the box at the height of its middle.
      const double apart =
          testing::own_distance({place.x, place.y, yard.target.centre().z}, solid_of(yard.target));
      if (apart < rules.standoff_m) {
        EXPECT_FALSE(has);
        continue;
      }
      (has ? with : without) += 1;
      for (int k = 0; k <= 30; ++k) {
        const double pitch = radians(-30.0 + 2.5 * k);
        const auto speed = gun.speed(pitch, norm(sight), yard.target.centre().z);
        if (has && k == region.pitch[c]) {
          ASSERT_TRUE(speed.has_value());
        }
        if (!speed || (has && k > region.pitch[c])) continue;
        const Shot shot{heading_of(sight), pitch, *speed};
        const Verdict verdict = judge(gun, rules, yard, place, shot);
        unsure += verdict == Verdict::unsure ? 1 : 0;
        const double forgives = error_ratio(rules, yard.target, place, shot);
        if (has && k == region.pitch[c]) {
          EXPECT_NE(verdict, Verdict::stopped) << i << " cell " << c << " pitch " << k;
          EXPECT_NEAR(forgives, region.error_ratio[c], 1e-5 * (1.0 + forgives));
        } else if (!has) {
          EXPECT_NE(verdict, Verdict::flies) << i << " cell " << c << " pitch " << k;
        } else if (verdict == Verdict::flies) {  // flatter, so it must forgive too little
          EXPECT_GT(forgives, 0.7 - 1e-6);
          EXPECT_GE(forgives, region.error_ratio[c] - 1e-5);
        }
      }
    }
    EXPECT_EQ(region.hits, hits);
  }
  EXPECT_GT(with, 100U);
  EXPECT_GT(without, 100U);
  EXPECT_LT(unsure, (with + without) / 2);
}

TEST(FiringRegion, IsEmptyWhereNobodyMayStand) {
  const GridFrame frame = small_frame();
  const Target target{"cat", {0, 0, 0}, {0.5, 0.2, 0.4}, 0.0};
  const auto region = firing_region({}, FlightSpace({floor_at(0)}), target, frame,
                                    std::vector<std::uint8_t>(frame.size(), 0));
  EXPECT_EQ(region.hits, 0U);
  EXPECT_EQ(region.places, 0U);
  EXPECT_EQ(region.in_range, 0U);
}

TEST(PitchLattice, SpansTheGunInEqualSteps) {
  ShotRules rules;
  const auto usual = pitch_lattice(rules);
  ASSERT_EQ(usual.size(), 31U);
  for (std::size_t i = 0; i < usual.size(); ++i) {
    EXPECT_NEAR(usual[i], radians(-30.0 + 2.5 * static_cast<double>(i)), 1e-12);
  }
  for (const double step : {0.05, 0.35, 1.0, 4.0, 45.0, 1000.0}) {
    rules.pitch_step_rad = radians(step);
    const auto pitches = pitch_lattice(rules);
    ASSERT_LE(pitches.size(), 255U);
    EXPECT_NEAR(pitches.front(), rules.gun.pitch_low_rad, 1e-12);
    EXPECT_NEAR(pitches.back(), rules.gun.pitch_high_rad, 1e-12);
  }
  rules.gun.pitch_high_rad = rules.gun.pitch_low_rad;
  EXPECT_EQ(pitch_lattice(rules).size(), 1U);
}

// ---- What cannot be hit -------------------------------------------------------------------------

SmallYard yard_with(std::vector<Solid> around) {
  around.insert(around.begin(), floor_at(0.0));
  return {std::move(around), {"cat", {0, 0, 0}, {0.5, 0.205, 0.372}, 0.4}};
}

std::vector<Solid> four_walls(double half, double height) {
  return {box_at("north", {0, half, 0.5 * height}, {2 * half, 0.05, height}),
          box_at("south", {0, -half, 0.5 * height}, {2 * half, 0.05, height}),
          box_at("east", {half, 0, 0.5 * height}, {0.05, 2 * half, height}),
          box_at("west", {-half, 0, 0.5 * height}, {0.05, 2 * half, height})};
}

Exhausted exhaust_yard(const SmallYard& yard, const GridFrame& frame, const ShotRules& rules = {}) {
  std::vector<std::uint8_t> standable(frame.size(), 0);
  for (std::size_t c = 0; c < frame.size(); ++c) {
    const Vec2 p = frame.centre(frame.cell(c));
    standable[c] = std::max(std::abs(p.x), std::abs(p.y)) > 0.9 ? 1 : 0;  // outside the walls
  }
  return exhaust(rules, FlightSpace(yard.solids), yard.target, frame, standable);
}

TEST(Exhaust, ProvesThatAClosedHutKeepsItsCat) {
  auto hut = four_walls(0.5, 1.0);
  hut.push_back(box_at("roof", {0, 0, 1.0}, {1.05, 1.05, 0.05}));
  const auto closed = exhaust_yard(yard_with(hut), small_frame());
  EXPECT_FALSE(closed.found.has_value());
  EXPECT_GT(closed.flights, 10000U);
  EXPECT_EQ(closed.blocked_by[0] + closed.blocked_by[1] + closed.blocked_by[2] + closed.blocked_by[3] +
                closed.blocked_by[4] + closed.blocked_by[5],
            closed.flights);
}

TEST(Exhaust, FindsTheShotOverLowWallsAndThroughAWindow) {
  const auto low = yard_with(four_walls(0.5, 0.3));
  const auto found = exhaust_yard(low, small_frame());
  ASSERT_TRUE(found.found.has_value());
  const Vec2 place = small_frame().centre(small_frame().cell(*found.found));
  EXPECT_NE(judge(OwnGun{}, {}, low, place, found.shot), Verdict::stopped);

  // A hut with a window at the height of the cat's ears, off its middle.
  auto hut = four_walls(0.5, 1.0);
  hut[3] = box_at("west", {-0.5, -0.35, 0.5}, {0.05, 0.35, 1.0});
  hut.push_back(box_at("west_too", {-0.5, 0.32, 0.5}, {0.05, 0.4, 1.0}));
  hut.push_back(box_at("west_low", {-0.5, 0, 0.125}, {0.05, 1.0, 0.25}));
  hut.push_back(box_at("roof", {0, 0, 1.0}, {1.05, 1.05, 0.05}));
  const auto window = yard_with(hut);
  ShotRules rules;
  rules.aim_step_m = 0.02;
  const auto through = exhaust_yard(window, covering({{-2, -2}, {2, 2}}, 0.1), rules);
  ASSERT_TRUE(through.found.has_value());
  const GridFrame fine = covering({{-2, -2}, {2, 2}}, 0.1);
  EXPECT_NE(judge(OwnGun{}, rules, window, fine.centre(fine.cell(*through.found)), through.shot),
            Verdict::stopped);
}

TEST(Exhaust, ProvesThatAHighShelfIsOutOfReach) {
  auto yard = yard_with({});
  yard.target.base.z = 6.0;
  const auto tried = exhaust_yard(yard, small_frame());
  EXPECT_FALSE(tried.found.has_value());
  EXPECT_EQ(tried.flights, 0U);
  EXPECT_EQ(tried.places, 0U);
}

TEST(Exhaust, AUShapedWallIsHitFromItsOpenSideOnly) {
  auto walls = four_walls(0.5, 3.0);
  walls.pop_back();  // open to the west
  const auto yard = yard_with(walls);
  const auto found = exhaust_yard(yard, small_frame());
  ASSERT_TRUE(found.found.has_value());
  EXPECT_LT(small_frame().centre(small_frame().cell(*found.found)).x, -0.5);
  auto closed_too = yard;
  closed_too.solids.push_back(box_at("door", {-0.5, 0, 1.5}, {0.05, 1.0, 3.0}));
  EXPECT_FALSE(exhaust_yard(closed_too, small_frame()).found.has_value());
}

/// Beside a long target, nearer than its half diagonal, the muzzle is past its near side when it points at
/// the centre, but not when it points at the ends.
TEST(Exhaust, TriesPlacesBesideALongTarget) {
  const Target row{"row", {0, 0, 0}, {3.0, 0.1, 0.3}, 0.0};
  const GridFrame frame = covering({{-0.1, 0.22}, {0.1, 0.42}}, 0.2);
  ASSERT_EQ(frame.size(), 1U);
  const FlightSpace space({floor_at(0)});
  EXPECT_TRUE(exhaust({}, space, row, frame, {1}).found.has_value());
  EXPECT_TRUE(best_shot({}, space, row, frame.centre({0, 0}), 0.0).has_value());
}

/// The same lattice, flight by flight.
Exhausted exhaust_slowly(const ShotRules& rules, const FlightSpace& space, const Target& target,
                         const GridFrame& frame, const std::vector<std::uint8_t>& standable) {
  const auto all = blockers(space, rules.gun.ball_radius_m + rules.margin_m);
  std::vector<const Blocker*> every;
  for (const Blocker& blocker : all) every.push_back(&blocker);
  Exhausted tried;
  Sight sight(rules, target);
  for (std::size_t cell = 0; cell < frame.size(); ++cell) {
    const Vec2 place = frame.centre(frame.cell(cell));
    if (standable[cell] == 0 || !clear_of(rules, target, place)) continue;
    const std::uint64_t before = tried.flights;
    for (const Vec2 aim : aim_points(target, place, rules.aim_step_m)) {
      for (const double up : offsets(-0.5 * target.size.z, 0.5 * target.size.z, rules.aim_step_m)) {
        for (const double pitch : pitch_lattice(rules)) {
          const Elevation at = elevation(rules, pitch);
          sight.look(place, aim, every);
          const auto arc = sight.arc(at, target.centre().z + up);
          if (!arc) continue;
          ++tried.flights;
          if (sight.stopped_by(*arc) != nullptr) continue;
          tried.found = cell;
          tried.shot = sight.shot(*arc);
          return tried;
        }
      }
    }
    tried.places += tried.flights > before ? 1 : 0;
  }
  return tried;
}

TEST(Exhaust, DecidesManyFlightsAtOnceAsOneByOne) {
  Rng rng(43);
  ShotRules rules;
  rules.pitch_step_rad = radians(5.0);
  rules.aim_step_m = 0.08;
  const GridFrame frame = covering({{-1.8, -1.8}, {1.8, 1.8}}, 0.45);
  std::size_t found = 0;
  std::size_t proven = 0;
  for (int i = 0; i < cases(60); ++i) {
    SmallYard yard = random_small_yard(rng, 8, 1.2);
    if (i % 3 != 0) {  // walls around it, some of them high enough
      for (const Solid& wall : four_walls(0.5, rng.uniform(0.4, 2.5))) yard.solids.push_back(wall);
      yard.target.base = {0.1 * rng.uniform(), 0.1 * rng.uniform(), 0.0};
    }
    const FlightSpace space(yard.solids);
    std::vector<std::uint8_t> outside(frame.size(), 0);
    for (std::size_t c = 0; c < frame.size(); ++c) {
      const Vec2 p = frame.centre(frame.cell(c));
      outside[c] = std::max(std::abs(p.x), std::abs(p.y)) > 0.9 ? 1 : 0;
    }
    const Exhausted fast = exhaust(rules, space, yard.target, frame, outside);
    const Exhausted slow = exhaust_slowly(rules, space, yard.target, frame, outside);
    ASSERT_EQ(fast.found, slow.found) << i;
    (slow.found ? found : proven) += 1;
    if (slow.found) {
      EXPECT_EQ(fast.shot.yaw_rad, slow.shot.yaw_rad) << i;
      EXPECT_EQ(fast.shot.pitch_rad, slow.shot.pitch_rad) << i;
      EXPECT_EQ(fast.shot.speed_mps, slow.shot.speed_mps) << i;
      continue;
    }
    EXPECT_EQ(fast.flights, slow.flights) << i;
    EXPECT_EQ(fast.places, slow.places) << i;
    std::uint64_t stopped = 0;
    for (const std::uint64_t flights : fast.blocked_by) stopped += flights;
    EXPECT_EQ(stopped, fast.flights) << i;
  }
  EXPECT_GT(found, 10U);
  EXPECT_GT(proven, 10U);
}

/// Small random yards: what is called unreachable is refuted aim by aim and pitch by pitch; what is found
/// flies; and best_shot finds a shot wherever exhaust does.
TEST(Exhaust, AgreesWithBruteForceOnRandomYards) {
  Rng rng(42);
  ShotRules rules;
  rules.margin_m = 0.05;
  rules.pitch_step_rad = radians(7.5);
  rules.aim_step_m = 0.15;
  const OwnGun gun{rules.gun};
  const GridFrame frame = covering({{-1.5, -1.5}, {1.5, 1.5}}, 0.75);
  std::size_t found = 0;
  std::size_t proven = 0;
  for (int i = 0; i < testing::costly_cases(60); ++i) {
    SmallYard yard = random_small_yard(rng, 8, 0.9);
    if (i % 2 == 0) {  // walls around it, some of them high enough
      for (const Solid& wall : four_walls(0.5, rng.uniform(0.5, 2.0))) yard.solids.push_back(wall);
      yard.target.base = {0.1 * rng.uniform(), 0.1 * rng.uniform(), 0.0};
    }
    const FlightSpace space(yard.solids);
    std::vector<std::uint8_t> outside(frame.size(), 0);
    for (std::size_t c = 0; c < frame.size(); ++c) {
      const Vec2 p = frame.centre(frame.cell(c));
      outside[c] = std::max(std::abs(p.x), std::abs(p.y)) > 0.9 ? 1 : 0;
    }
    const auto tried = exhaust(rules, space, yard.target, frame, outside);
    if (tried.found) {
      ++found;
      const Vec2 place = frame.centre(frame.cell(*tried.found));
      EXPECT_NE(judge(gun, rules, yard, place, tried.shot), Verdict::stopped) << i;
      const auto best = best_shot(rules, space, yard.target, place, 0.0);
      ASSERT_TRUE(best.has_value()) << i;
      EXPECT_NE(judge(gun, rules, yard, place, best->shot), Verdict::stopped) << i;
      continue;
    }
    ++proven;
    for (std::size_t c = 0; c < frame.size(); ++c) {
      const Vec2 place = frame.centre(frame.cell(c));
      if (outside[c] == 0 || !clear_of(rules, yard.target, place)) continue;
      for (const Vec2 aim : aim_points(yard.target, place, rules.aim_step_m)) {
        for (const double z : {0.0, 0.5, 1.0}) {
          for (int k = 0; k <= 10; ++k) {
            const double pitch = radians(-30.0 + 7.5 * k);
            const auto speed =
                gun.speed(pitch, norm(aim - place), yard.target.base.z + z * yard.target.size.z);
            if (!speed) continue;
            EXPECT_NE(judge(gun, rules, yard, place, {heading_of(aim - place), pitch, *speed}),
                      Verdict::flies)
                << i << " cell " << c;
          }
        }
      }
    }
  }
  if (!testing::in_full()) return;
  EXPECT_GT(found, 15U);
  EXPECT_GT(proven, 5U);
}

}  // namespace
}  // namespace outrider
