#include "outrider/ballistics/stance.hpp"

#include <gtest/gtest.h>

#include "outrider/ballistics/firing_region.hpp"
#include "support/random_cases.hpp"
#include "support/random_terrain.hpp"

namespace outrider {
namespace {

using testing::cases;
using testing::hill;
using testing::terrain_of;

/// Rodrigues' formula.
Vec3 turned(Vec3 v, Vec3 axis, double angle) {
  return std::cos(angle) * v + std::sin(angle) * cross(axis, v) +
         (1.0 - std::cos(angle)) * dot(axis, v) * axis;
}

/// Returns what stance.hpp says in words: z goes to the normal, about the horizontal axis across both.
Vec3 leant(Vec3 v, Vec3 up) {
  const Vec3 axis = cross({0, 0, 1}, up);
  return turned(v, 1.0 / norm(axis) * axis, std::acos(up.z));
}

Stance random_stance(Rng& rng) {
  const double slope = std::tan(rng.uniform(0.01, 0.7));
  const Vec2 downhill = direction(rng.uniform(-pi, pi));
  const Vec3 up{slope * downhill.x, slope * downhill.y, 1.0};
  return {rng.uniform(-2.0, 2.0), 1.0 / norm(up) * up};
}

Vec3 pointing(double yaw, double pitch) {
  return {std::cos(pitch) * std::cos(yaw), std::cos(pitch) * std::sin(yaw), std::sin(pitch)};
}

TEST(Stance, OnALevelEverythingIsAsWithoutIt) {
  const Stance level{0.5, {0, 0, 1}};
  const Shot shot{1.1, 0.3, 7.0};
  EXPECT_EQ(angles_of(level, shot).yaw_rad, 1.1);
  EXPECT_EQ(angles_of(level, shot).pitch_rad, 0.3);
  EXPECT_EQ(heading_on(level, 0.7), 0.7);
  const Flight flight = launch(GunModel{}, level, {1, 2}, shot, 9.8);
  EXPECT_EQ(flight.muzzle, launch(GunModel{}, {1, 2}, 0.5, shot, 9.8).muzzle);
  ShotRules rules;
  EXPECT_EQ(line_of_fire(rules, level, {1, 2}, {3, 4}, 0.2)->from, (Vec2{1, 2}));
  EXPECT_EQ(stance_at(rules, {1, 2}).ground_z_m, rules.floor_z_m);
}

TEST(Stance, TheGunLeansWithTheGround) {
  Rng rng(1);
  const GunModel gun;
  for (int i = 0; i < cases(300); ++i) {
    const Stance stance = random_stance(rng);
    const GunAngles angles{rng.uniform(-pi, pi), rng.uniform(-0.5, 0.8)};
    const Vec3 barrel = leant(pointing(angles.yaw_rad, angles.pitch_rad), stance.up);
    const Shot shot = shot_of(stance, angles, 5.0);
    EXPECT_NEAR(norm(pointing(shot.yaw_rad, shot.pitch_rad) - barrel), 0.0, 1e-12);
    EXPECT_NEAR(wrap_angle(angles_of(stance, shot).yaw_rad - angles.yaw_rad), 0.0, 1e-9);
    EXPECT_NEAR(angles_of(stance, shot).pitch_rad, angles.pitch_rad, 1e-12);

    const Vec2 place{rng.uniform(-5.0, 5.0), rng.uniform(-5.0, 5.0)};
    const Vec3 above = leant(pointing(angles.yaw_rad, angles.pitch_rad + pi / 2), stance.up);
    const Vec3 tip = Vec3{place.x, place.y, stance.ground_z_m} + gun.pivot_height_m * stance.up +
                     gun.tip_forward_m * barrel + gun.tip_up_m * above;
    const Flight flight = launch(gun, stance, place, shot, 9.8);
    EXPECT_NEAR(norm(flight.muzzle - tip), 0.0, 1e-12);
    EXPECT_NEAR(norm(flight.velocity_mps - 5.0 * barrel), 0.0, 1e-12);
  }
}

TEST(Stance, TheBodyStandsOnTheNormalAndLooksWhereItHeads) {
  Rng rng(2);
  for (int i = 0; i < cases(200); ++i) {
    const Stance stance = random_stance(rng);
    const double heading = rng.uniform(-pi, pi);
    const Rotation body = world_T_robot(stance, {{1, 2}, heading}).rotation;
    EXPECT_NEAR(norm(body.axes[2] - stance.up), 0.0, 1e-12);
    EXPECT_NEAR(dot(body.axes[0], stance.up), 0.0, 1e-12);
    EXPECT_NEAR(norm(cross(body.axes[0], body.axes[1]) - body.axes[2]), 0.0, 1e-12);
    EXPECT_NEAR(wrap_angle(heading_of(xy(body.axes[0])) - heading), 0.0, 1e-12);
    // Yaw 0 of the joint is the forward axis.
    const Shot ahead = shot_of(stance, {heading_on(stance, heading), 0.0}, 1.0);
    EXPECT_NEAR(norm(pointing(ahead.yaw_rad, ahead.pitch_rad) - body.axes[0]), 0.0, 1e-9);
  }
}

TEST(Stance, ALineOfFirePassesOverTheAimAtThatPitchOfTheJoint) {
  Rng rng(3);
  ShotRules rules;
  int lines = 0;
  for (int i = 0; i < cases(500); ++i) {
    const Stance stance = random_stance(rng);
    const Vec2 place{rng.uniform(-5.0, 5.0), rng.uniform(-5.0, 5.0)};
    const Vec2 aim = place + rng.uniform(0.6, 8.0) * direction(rng.uniform(-pi, pi));
    const double pitch = rng.uniform(radians(-30.0), radians(45.0));
    const auto line = line_of_fire(rules, stance, place, aim, pitch);
    if (!line) continue;
    ++lines;
    const Shot shot{heading_of(aim - line->from), line->at.pitch_rad, 6.0};
    EXPECT_NEAR(angles_of(stance, shot).pitch_rad, pitch, 1e-9);
    const Flight flight = launch(rules.gun, stance, place, shot, 9.8);
    const Vec2 along = direction(shot.yaw_rad);
    EXPECT_NEAR(cross(along, aim - xy(flight.muzzle)), 0.0, 1e-9);
    EXPECT_NEAR(norm(line->from + line->at.tip.x * along - xy(flight.muzzle)), 0.0, 1e-9);
    EXPECT_NEAR(stance.ground_z_m + line->at.tip.y, flight.muzzle.z, 1e-9);
    EXPECT_NEAR(line->at.tangent, flight.velocity_mps.z / norm(xy(flight.velocity_mps)), 1e-9);
    const double slope = std::tan(std::acos(stance.up.z));
    ShotRules on_slope = rules;
    on_slope.terrain = std::make_shared<const HeightField>(
        terrain_of({-9, -9}, {9, 9}, 3, 3, [slope](Vec2 p) { return slope * p.x; }));
    EXPECT_LE(distance(line->from, place), largest_lean_m(on_slope) + 1e-9);
  }
  EXPECT_GT(lines, cases(500) / 2);
}

struct HillRange {
  ShotRules rules;
  FlightSpace space;
  Target target;
};

/// A hill with a wall on it and a target somewhere.
HillRange random_range(Rng& rng) {
  const auto ground =
      std::make_shared<const HeightField>(hill(6.0, 0.5, rng.uniform(0.5, 1.5), rng.uniform(3.0, 5.0)));
  const auto on_ground = [&](Vec2 p, double above) { return Vec3{p.x, p.y, ground->height(p) + above}; };
  const auto place = [&] { return Vec2{rng.uniform(-4.0, 4.0), rng.uniform(-4.0, 4.0)}; };
  HillRange range{{},
                  FlightSpace({{"terrain", {}, HeightFieldShape{ground}},
                               {"wall", {on_ground(place(), 0.4), {}}, BoxShape{{0.2, 1.0, 0.4}}}}),
                  {"cat", on_ground(place(), 0.0), {0.4, 0.3, 0.3}, rng.uniform(-pi, pi)}};
  range.rules.terrain = ground;
  range.rules.floor_z_m = ground->lowest_m();
  range.rules.pitch_step_rad = radians(7.5);
  return range;
}

/// Returns true if a ball hits the target before it comes within the margin of anything, by small steps.
bool hits_by_steps(const HillRange& range, const Flight& flight, double slack_m) {
  const Solid box = solid_of(range.target);
  const double ball = range.rules.gun.ball_radius_m;
  for (double t = 0.0; t < 3.0; t += 5e-4) {
    const Vec3 p = flight.position(t);
    if (p.z < range.rules.floor_z_m - 1.0) return false;
    for (const Solid& solid : range.space.solids()) {
      if (distance(p, solid) < ball + range.rules.margin_m + slack_m) return false;
    }
    if (distance(p, box) < ball + 1e-3) return true;
  }
  return false;
}

/// A shot of the lattice at the centre from there, solved by halving alone: the speed and the yaw are
/// searched for until the flight passes the centre.
std::optional<Flight> searched(const HillRange& range, Vec2 position, double pitch) {
  const Stance stance = stance_at(range.rules, position);
  const Vec3 aim = range.target.centre();
  GunAngles angles{angles_of(stance, {heading_of(xy(aim) - position), 0.0, 1.0}).yaw_rad, pitch};
  for (int round = 0; round < 200; ++round) {
    const Shot shot = shot_of(stance, angles, 1.0);
    const Vec3 tip = launch(range.rules.gun, stance, position, shot, 9.8).muzzle;
    angles.yaw_rad += 0.5 * wrap_angle(heading_of(xy(aim) - xy(tip)) - shot.yaw_rad);
  }
  const auto height_at_aim = [&](double speed) {
    const Flight flight = launch(range.rules.gun, stance, position, shot_of(stance, angles, speed), 9.8);
    const double t = distance(xy(flight.muzzle), xy(aim)) / norm(xy(flight.velocity_mps));
    return flight.position(t).z;
  };
  double low = 0.01;
  double high = range.rules.gun.muzzle_speed_mps;
  if (height_at_aim(high) < aim.z) return std::nullopt;
  for (int round = 0; round < 100; ++round) {
    const double middle = 0.5 * (low + high);
    (height_at_aim(middle) < aim.z ? low : high) = middle;
  }
  return launch(range.rules.gun, stance, position, shot_of(stance, angles, high), 9.8);
}

TEST(FiringRegionOnTerrain, IsThatOfEveryShotOfTheLatticeFlownInSmallSteps) {
  Rng rng(4);
  std::size_t decided = 0;
  std::size_t hits = 0;
  for (int i = 0; i < cases(2); ++i) {
    const HillRange range = random_range(rng);
    const GridFrame frame = covering({{-4.0, -4.0}, {4.0, 4.0}}, 1.0);
    const auto region = firing_region(range.rules, range.space, range.target, frame,
                                      std::vector<std::uint8_t>(frame.size(), 1));
    for (std::size_t cell = 0; cell < frame.size(); ++cell) {
      const Vec2 place = frame.centre(frame.cell(cell));
      if (!clear_of(range.rules, range.target, place)) continue;
      bool surely = false;
      bool perhaps = false;
      for (const double pitch : pitch_lattice(range.rules)) {
        const auto flight = searched(range, place, pitch);
        if (!flight) continue;
        surely = surely || hits_by_steps(range, *flight, 4e-3);
        perhaps = perhaps || hits_by_steps(range, *flight, -4e-3);
      }
      const bool hit = region.pitch[cell] != FiringRegion::no_shot;
      if (surely == perhaps) {
        EXPECT_EQ(hit, surely) << "case " << i << ", place " << place.x << ", " << place.y;
        ++decided;
        hits += hit ? 1 : 0;
      }
    }
  }
  EXPECT_GT(decided, 80U);
  EXPECT_GT(hits, 15U);
}

TEST(ExhaustOnTerrain, AgreesWithTheRegionAndFindsNoMoreThanTheBestShot) {
  Rng rng(5);
  int found = 0;
  for (int i = 0; i < cases(10); ++i) {
    const HillRange range = random_range(rng);
    const GridFrame frame = covering({{-4.0, -4.0}, {4.0, 4.0}}, 1.0);
    const std::vector<std::uint8_t> all(frame.size(), 1);
    const auto region = firing_region(range.rules, range.space, range.target, frame, all);
    const auto tried = exhaust(range.rules, range.space, range.target, frame, all);
    if (region.hits > 0) {
      EXPECT_TRUE(tried.found);
    }
    if (!tried.found) continue;
    ++found;
    const Vec2 place = frame.centre(frame.cell(*tried.found));
    const Flight flight = launch(range.rules, {place, {}}, range.target, tried.shot);
    EXPECT_TRUE(hits_by_steps(range, flight, -1e-3));
    const auto shot = best_shot(range.rules, range.space, range.target, place, 0.0);
    ASSERT_TRUE(shot);
    EXPECT_GE(shot->gun.pitch_rad, range.rules.gun.pitch_low_rad - 1e-9);
    EXPECT_LE(shot->gun.pitch_rad, range.rules.gun.pitch_high_rad + 1e-9);
    EXPECT_TRUE(hits_by_steps(range, launch(range.rules, {place, {}}, range.target, shot->shot), -1e-3));
    EXPECT_LE(distance(place, xy(range.target.base)), longest_range(range.rules, range.target));
  }
  EXPECT_GT(found, 0);
}

}  // namespace
}  // namespace outrider
