#include "outrider/ballistics/sight.hpp"

#include <gtest/gtest.h>

#include <set>

#include "support/fine_flight.hpp"
#include "support/random_cases.hpp"
#include "support/random_yard.hpp"

namespace outrider {
namespace {

using testing::cases;
using testing::random_small_yard;
using testing::random_solid;

/// True when some point well inside the hull lies between a and b.
bool crosses(Vec2 a, Vec2 b, const std::vector<Vec2>& hull) {
  for (int i = 0; i <= 400; ++i) {
    if (testing::inside(a + i / 400.0 * (b - a), hull, -1e-9)) return true;
  }
  return false;
}

TEST(Sweep, NeverMissesABlocker) {
  Rng rng(31);
  std::size_t looked = 0;
  std::size_t listed = 0;
  for (int i = 0; i < cases(12); ++i) {
    const auto yard = random_small_yard(rng, 10, 2.0);
    const auto all = blockers(FlightSpace(yard.solids), 0.04);
    const Vec2 centre = xy(yard.target.base);
    const double spare = i % 2 == 0 ? 0.0 : 0.3;
    const double reach = rng.uniform(1.0, 4.0);
    const GridFrame frame = covering({{-2.0, -2.0}, {2.0, 2.0}}, 0.25);
    std::vector<std::uint8_t> standable(frame.size());
    for (std::uint8_t& cell : standable) cell = rng.below(4) == 0 ? 0 : 1;
    std::set<std::size_t> visited;
    sweep(all, centre, reach, spare, frame, standable,
          [&](std::size_t cell, const std::vector<const Blocker*>& near) {
            EXPECT_TRUE(visited.insert(cell).second) << "visited twice";
            EXPECT_EQ(standable[cell], 1);
            const Vec2 place = frame.centre(frame.cell(cell));
            // Aim points as far from the centre as the spare allows.
            const Vec2 aim = centre + spare * direction(rng.uniform(-pi, pi));
            for (const Blocker& blocker : all) {
              ++looked;
              const bool is_near = std::find(near.begin(), near.end(), &blocker) != near.end();
              listed += is_near ? 1 : 0;
              if (!is_near) {
                EXPECT_FALSE(blocker.hull.empty() || crosses(place, aim, blocker.hull));
              }
            }
            return true;
          });
    for (std::size_t c = 0; c < frame.size(); ++c) {
      const double away = distance(frame.centre(frame.cell(c)), centre);
      if (std::abs(away - reach) < 1e-9) continue;
      EXPECT_EQ(visited.contains(c), standable[c] != 0 && away < reach);
    }
  }
  EXPECT_LT(listed, looked / 2) << "the sweep spares nothing";
}

TEST(Sweep, EndsWhenToldTo) {
  const GridFrame frame = covering({{-2.0, -2.0}, {2.0, 2.0}}, 0.25);
  int visits = 0;
  sweep({}, {}, 9.0, 0.0, frame, std::vector<std::uint8_t>(frame.size(), 1),
        [&](std::size_t, const auto&) { return ++visits < 7; });
  EXPECT_EQ(visits, 7);
}

TEST(Blockers, PolygonsBoundTheGrownSolidFromOutsideAndInside) {
  Rng rng(32);
  for (int i = 0; i < cases(140); ++i) {
    const Solid solid = random_solid(rng, static_cast<std::uint64_t>(i) % 7, 0.3);
    const auto pieces = blockers(FlightSpace({solid}), 0.04);
    for (int k = 0; k < 60; ++k) {
      const Vec3 p{rng.uniform(-1, 1), rng.uniform(-1, 1), rng.uniform(-0.5, 1.5)};
      const double away = testing::own_distance(p, solid);
      bool inside_one = false;
      bool in_core = false;
      bool in_side = false;
      bool over_core = false;
      for (const Blocker& piece : pieces) {
        const bool level = p.z >= piece.low_m - 0.04 && p.z <= piece.high_m + 0.04;
        inside_one = inside_one || (level && testing::inside(xy(p), piece.hull, 1e-9));
        const bool beside = p.z >= piece.low_m && p.z <= piece.high_m;
        in_core = in_core || (beside && testing::inside(xy(p), piece.core));
        in_side = in_side || (beside && testing::inside(xy(p), piece.side));
        over_core = over_core || (level && testing::inside(xy(p), piece.core));
      }
      if (away <= 0.04) {
        EXPECT_TRUE(inside_one) << solid.name;
      }
      if (in_core) {
        EXPECT_LT(away, 1e-9) << solid.name;
      }
      if (in_side || over_core) {
        EXPECT_LT(away, 0.04 + 1e-9) << solid.name;
      }
    }
  }
}

TEST(LongestRange, BoundsEveryShotThatTheGunCanDo) {
  Rng rng(33);
  for (int i = 0; i < cases(300); ++i) {
    ShotRules rules;
    rules.floor_z_m = rng.uniform(-1.0, 1.0);
    rules.gravity_mps2 = rng.uniform(3.0, 12.0);
    const Target target{"cat",
                        {0, 0, rules.floor_z_m + rng.uniform(-1.0, 6.0)},
                        {rng.uniform(0.1, 1.0), rng.uniform(0.1, 1.0), rng.uniform(0.1, 1.0)},
                        0.0};
    const double longest = longest_range(rules, target);
    double farthest = 0.0;
    for (int k = 0; k <= 150; ++k) {
      const Flight flight =
          launch(rules.gun, {}, rules.floor_z_m, {0.0, rules.gun.pitch_low_rad + radians(0.5) * k, 10.0},
                 rules.gravity_mps2);
      for (const double z : {target.base.z, target.base.z + target.size.z}) {
        const double t = fall_time(flight, z);
        if (t > 0.0) farthest = std::max(farthest, flight.position(t).x);
      }
    }
    if (farthest > 0.0) {
      EXPECT_GE(longest, farthest + 0.5 * std::hypot(target.size.x, target.size.y));
    }
  }
}

TEST(AimPoints, LieInTheTargetAndSpanItsOutline) {
  Rng rng(34);
  for (int i = 0; i < cases(300); ++i) {
    const Target target{
        "t", {0.3, -0.2, 0}, {rng.uniform(0.1, 2.0), rng.uniform(0.1, 1.0), 0.3}, rng.uniform(-pi, pi)};
    const Vec2 place = xy(target.base) + testing::random_offset(rng, 1.2, 6.0);
    const double step = rng.uniform(0.02, 0.2);
    const auto points = aim_points(target, place, step);
    ASSERT_GE(points.size(), 1U);
    const Solid box = solid_of(target);
    double previous = -pi;
    const Vec2 to_centre = xy(target.base) - place;
    const auto bearing = [&](Vec2 p) {
      return std::atan2(cross(to_centre, p - place), dot(to_centre, p - place));
    };
    bool centre = false;
    for (const Vec2 p : points) {
      EXPECT_LT(testing::own_distance({p.x, p.y, 0.1}, box), 1e-9);
      EXPECT_GT(bearing(p), previous);
      if (previous > -pi) {
        EXPECT_LE((bearing(p) - previous) * norm(p - place), step * 1.01);
      }
      previous = bearing(p);
      centre = centre || std::abs(bearing(p)) < 1e-12;
    }
    EXPECT_TRUE(centre);
    // The outermost are within a step of every corner's bearing.
    for (const Vec2 side : {Vec2{-1, -1}, Vec2{-1, 1}, Vec2{1, -1}, Vec2{1, 1}}) {
      const Vec2 corner = xy(solid_of(target).world_T_solid *
                             Vec3{0.5 * side.x * target.size.x, 0.5 * side.y * target.size.y, 0});
      EXPECT_LE((bearing(corner) - bearing(points.back())) * norm(corner - place), step * 1.01);
      EXPECT_LE((bearing(points.front()) - bearing(corner)) * norm(corner - place), step * 1.01);
    }
  }
}

TEST(Offsets, HoldBothEndsAndZero) {
  EXPECT_EQ(offsets(0.0, 0.0, 0.1), std::vector<double>{0.0});
  const auto some = offsets(-0.25, 0.1, 0.1);
  EXPECT_EQ(some.front(), -0.25);
  EXPECT_EQ(some.back(), 0.1);
  EXPECT_NE(std::find(some.begin(), some.end(), 0.0), some.end());
  for (std::size_t i = 1; i < some.size(); ++i) EXPECT_LE(some[i] - some[i - 1], 0.1 + 1e-12);
}

}  // namespace
}  // namespace outrider
