#include "outrider/sim/profile.hpp"

#include <gtest/gtest.h>

#include "outrider/log/messages/conversions.hpp"
#include "support/fine_flight.hpp"
#include "support/random_cases.hpp"
#include "support/random_yard.hpp"

namespace outrider {
namespace {

using testing::cases;
using testing::floor_at;
using testing::random_small_yard;
using testing::random_solid;

/// The side view of a solid shows what the plane of the flight cuts of it.
TEST(Profile, ShowsWhatThePlaneOfTheFlightCuts) {
  Rng rng(111);
  int filled = 0;
  for (int i = 0; i < cases(60); ++i) {
    auto yard = random_small_yard(rng, 0, 1.0);
    const std::uint64_t kind = static_cast<std::uint64_t>(i) % 7;
    if (kind == 5) continue;  // a mesh is a surface
    yard.solids.push_back(random_solid(rng, kind, 0.4));
    const Vec2 place = 1.8 * direction(rng.uniform(-pi, pi));
    const Vec2 sight = xy(yard.target.base) - place;
    const Flight flight = launch({}, place, 0.0, {heading_of(sight), 0.3, 5.0}, 9.8);
    const FlightSpace space(yard.solids);
    const Impact impact = fly(flight, 0.01, space, yard.target, 0.0);
    const auto pieces = profile_of(flight, impact, space, yard.target);
    ASSERT_FALSE(pieces.empty());
    EXPECT_EQ(pieces.back().name, "cat");
    std::vector<std::vector<Vec2>> polygons(pieces.size());
    for (std::size_t piece = 0; piece < pieces.size(); ++piece) {
      for (const auto& corner : pieces[piece].polygon) polygons[piece].push_back(vec2_of(corner));
    }
    const Vec2 along = 1.0 / norm(xy(flight.velocity_mps)) * xy(flight.velocity_mps);
    const double end = std::max(dot(along, xy(impact.position) - xy(flight.muzzle)),
                                dot(along, xy(yard.target.base) - xy(flight.muzzle)));
    const double lowest = std::min({flight.muzzle.z, impact.position.z, yard.target.base.z});
    std::vector<Solid> all = yard.solids;
    all.push_back(solid_of(yard.target));
    for (int k = 0; k < 200; ++k) {
      const Vec2 in_plane{rng.uniform(-0.6, end + 0.6), rng.uniform(lowest - 0.25, 1.5)};
      const Vec2 ground = xy(flight.muzzle) + in_plane.x * along;
      for (const Solid& solid : all) {
        bool drawn = false;
        bool nearly = false;
        for (std::size_t piece = 0; piece < pieces.size(); ++piece) {
          if (pieces[piece].name != solid.name) continue;
          drawn = drawn || testing::inside(in_plane, polygons[piece], -0.004);
          nearly = nearly || testing::inside(in_plane, polygons[piece], 0.004);
        }
        const double out = testing::own_distance({ground.x, ground.y, in_plane.y}, solid);
        if (drawn) {
          EXPECT_LT(out, 0.006) << solid.name;
        }
        // Well inside: a ball of 1 cm around it is as well.
        if (out == 0.0 && !nearly) {
          double deepest = 0.0;
          for (const Vec3 d : {Vec3{0.02, 0, 0}, Vec3{-0.02, 0, 0}, Vec3{0, 0.02, 0}, Vec3{0, -0.02, 0},
                               Vec3{0, 0, 0.02}, Vec3{0, 0, -0.02}}) {
            deepest =
                std::max(deepest, testing::own_distance(Vec3{ground.x, ground.y, in_plane.y} + d, solid));
          }
          EXPECT_GT(deepest, 0.0) << solid.name << " is missing";
        }
        filled += drawn ? 1 : 0;
      }
    }
    for (const auto& polygon : polygons) {
      for (const Vec2 corner : polygon) {
        EXPECT_GE(corner.x, -0.6 - 1e-9);
        EXPECT_LE(corner.x, end + 0.6 + 1e-9);
        EXPECT_TRUE(std::isfinite(corner.y));
      }
    }
  }
  EXPECT_GT(filled, 500);
}

}  // namespace
}  // namespace outrider
