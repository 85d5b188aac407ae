#include "outrider/world/height_field.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "outrider/world/collision_map.hpp"
#include "outrider/world/contours.hpp"
#include "outrider/world/steep_ground.hpp"
#include "support/random_cases.hpp"
#include "support/random_terrain.hpp"

namespace outrider {
namespace {

using testing::cases;
using testing::height_by_plane;
using testing::hill;
using testing::random_terrain;
using testing::terrain_of;

Vec2 somewhere(Rng& rng, const HeightField& field, double beyond_m = 0.0) {
  const Box2 box = field.bounds().grown(beyond_m);
  return {rng.uniform(box.low.x, box.high.x), rng.uniform(box.low.y, box.high.y)};
}

TEST(HeightField, HeightsAndSlopesAreThoseOfThePlanesThroughThePosts) {
  Rng rng(1);
  for (int i = 0; i < cases(300); ++i) {
    const HeightField field = random_terrain(rng);
    for (int k = 0; k < 10; ++k) {
      const Vec2 p = somewhere(rng, field);
      EXPECT_NEAR(field.height(p), height_by_plane(field, p), 1e-9);
      const double h = 1e-7;
      const Vec2 slope = field.gradient(p);
      const double east = (field.height(p + Vec2{h, 0}) - field.height(p - Vec2{h, 0})) / (2 * h);
      const double north = (field.height(p + Vec2{0, h}) - field.height(p - Vec2{0, h})) / (2 * h);
      if (norm(slope - Vec2{east, north}) > 1e-5) continue;  // a side of a triangle in between
      EXPECT_NEAR(dot(field.normal(p), Vec3{1, 0, east}), 0.0, 1e-5);
      EXPECT_NEAR(dot(field.normal(p), Vec3{0, 1, north}), 0.0, 1e-5);
      EXPECT_NEAR(norm(field.normal(p)), 1.0, 1e-12);
    }
  }
}

TEST(HeightField, BeyondTheBoundsTheEdgeGoesOn) {
  const HeightField field = hill(2.0, 0.5, 1.0, 3.0);
  EXPECT_EQ(field.height({9.0, 0.3}), field.height({2.0, 0.3}));
  EXPECT_EQ(field.height({-9.0, -9.0}), field.height({-2.0, -2.0}));
}

TEST(HeightField, SteepestIsTheMostOfAllSlopes) {
  Rng rng(2);
  for (int i = 0; i < cases(50); ++i) {
    const HeightField field = random_terrain(rng);
    double most = 0.0;
    for (int k = 0; k < 4000; ++k) most = std::max(most, norm(field.gradient(somewhere(rng, field))));
    EXPECT_LE(most, field.steepest() + 1e-12);
    EXPECT_GE(most, 0.5 * field.steepest());
    EXPECT_LE(field.steepest_in(field.cell_at(somewhere(rng, field))), field.steepest());
  }
}

/// Returns the distance by looking at very many points of the surface, and of the walls under its edge.
double distance_by_sampling(const HeightField& field, Vec3 p, double step) {
  const Box2 box = field.bounds();
  double least = std::numeric_limits<double>::infinity();
  for (double x = box.low.x; x <= box.high.x + 1e-9; x += step) {
    for (double y = box.low.y; y <= box.high.y + 1e-9; y += step) {
      const double top = field.height({x, y});
      least = std::min(least, norm(p - Vec3{x, y, std::min(top, p.z)}));
    }
  }
  return least;
}

TEST(HeightField, DistanceIsThatToTheNearestPointOfTheGround) {
  Rng rng(3);
  for (int i = 0; i < cases(60); ++i) {
    const HeightField field = random_terrain(rng);
    const double step = 0.01 * norm(field.bounds().size());
    for (int k = 0; k < 10; ++k) {
      const Vec2 over = somewhere(rng, field, 2.0);
      const Vec3 p{over.x, over.y, rng.uniform(-1.5, 3.0)};
      const double sampled = distance_by_sampling(field, p, step);
      const double most_off = step * std::hypot(1.0, field.steepest());
      EXPECT_LE(field.distance(p), sampled + 1e-9);
      EXPECT_GE(field.distance(p), sampled - most_off);
    }
  }
}

TEST(HeightField, ADrapedSegmentIsAsLongAsManySmallSteps) {
  Rng rng(4);
  for (int i = 0; i < cases(200); ++i) {
    const HeightField field = random_terrain(rng);
    const Segment s{somewhere(rng, field, 0.5), somewhere(rng, field, 0.5)};
    double sum = 0.0;
    const int steps = 20'000;
    Vec3 before{s.a.x, s.a.y, field.height(s.a)};
    for (int k = 1; k <= steps; ++k) {
      const Vec2 p = s.a + (1.0 * k / steps) * (s.b - s.a);
      const Vec3 here{p.x, p.y, field.height(p)};
      sum += norm(here - before);
      before = here;
    }
    // A step over a side of a triangle cuts its corner, by no more than its own length on the surface.
    const double cut = 40.0 * distance(s.a, s.b) / steps * std::hypot(1.0, field.steepest());
    EXPECT_LE(sum, field.length(s) + 1e-9);
    EXPECT_GE(sum, field.length(s) - cut);
    EXPECT_GE(field.length(s), distance(s.a, s.b));
    EXPECT_NEAR(field.length(s), field.length({s.b, s.a}), 1e-9);

    const double part = rng.uniform(0.0, 1.0) * field.length(s);
    EXPECT_NEAR(field.length({s.a, field.walked(s, part)}), part, 1e-6);
    EXPECT_EQ(field.walked(s, field.length(s) + 1.0), s.b);
  }
}

TEST(HeightField, IsCutInColumnsUpToTheSurface) {
  Rng rng(7);
  for (int i = 0; i < cases(100); ++i) {
    const auto field = std::make_shared<const HeightField>(random_terrain(rng));
    const Solid ground{"terrain", {}, HeightFieldShape{field}};
    const Vec2 origin = somewhere(rng, *field);
    const Vec2 along = direction(rng.uniform(-pi, pi));
    const auto columns = slice(ground, origin, along);
    for (int k = 0; k < 20; ++k) {
      const double s = rng.uniform(-4.0, 4.0);
      const Vec2 p = origin + s * along;
      const auto column = std::ranges::find_if(
          columns, [s](const std::vector<Vec2>& c) { return c[0].x <= s && s <= c[1].x; });
      EXPECT_EQ(column != columns.end(), field->bounds().contains(p));
      if (column == columns.end()) continue;
      const Vec2 a = (*column)[3];
      const Vec2 b = (*column)[2];
      EXPECT_NEAR(a.y + (s - a.x) / (b.x - a.x) * (b.y - a.y), field->height(p), 1e-9);
    }
    EXPECT_TRUE(footprint(ground, -9.0, 9.0).empty());
    EXPECT_EQ(kind(ground.shape), "height_field");
    EXPECT_EQ(bounds(ground).high.z, field->highest_m());
  }
}

TEST(HeightField, RefusesWhatIsNoField) {
  const auto why = [](Vec2 spacing, int columns, int rows, std::vector<double> heights) {
    const auto field = HeightField::make({}, spacing, columns, rows, std::move(heights));
    return field ? "" : field.error().sentence;
  };
  const double nan = std::nan("");
  EXPECT_NE(why({1, 1}, 1, 4, {0, 0, 0, 0}).find("1 x 4 posts"), std::string::npos);
  EXPECT_NE(why({1, 1}, 2, 2, {0, 0, 0}).find("4 heights, 3 are given"), std::string::npos);
  EXPECT_NE(why({1, 0}, 2, 2, {0, 0, 0, 0}).find("spacing of 1 x 0 m"), std::string::npos);
  EXPECT_NE(why({1, 1}, 2, 2, {0, 0, nan, 0}).find("post 0, 1 is nan m"), std::string::npos);
  EXPECT_NE(why({1, 1}, 3000, 3000, {}).find("3000 x 3000 posts"), std::string::npos);
}

TEST(SteepGround, RectanglesCoverTheSteepCellsAndNoOthers) {
  Rng rng(5);
  for (int i = 0; i < cases(100); ++i) {
    const HeightField field = random_terrain(rng);
    const double limit = rng.uniform(0.2, 1.3);
    const auto patches = steep_ground(field, limit);
    for (int k = 0; k < 50; ++k) {
      const Vec2 p = somewhere(rng, field);
      const bool covered = std::ranges::any_of(
          patches, [&](const RoundedPolygon& patch) { return testing::inside(p, patch.core); });
      EXPECT_EQ(covered, field.steepest_in(field.cell_at(p)) > std::tan(limit));
    }
    const auto few = steep_ground(field, limit, 2);
    EXPECT_LE(few.size(), 2U);
    for (const RoundedPolygon& patch : patches) {
      const Vec2 middle = 0.5 * (patch.core[0] + patch.core[2]);
      EXPECT_TRUE(std::ranges::any_of(
          few, [&](const RoundedPolygon& larger) { return testing::inside(middle, larger.core); }));
    }
  }
}

TEST(SteepGround, ClosesGroundToTheRobot) {
  World world;
  world.bounds = {{-3.0, -3.0}, {3.0, 3.0}};
  world.floor_z_m = 0.0;
  world = world.on(std::make_shared<const HeightField>(terrain_of(
      {-4.0, -4.0}, {0.5, 0.5}, 17, 17, [](Vec2 p) { return p.x > 1.0 ? 2.0 * (p.x - 1.0) : 0.0; })));
  const CollisionMap steep = CollisionMap::of(world, 0.2, 1e-3, radians(30.0));
  EXPECT_TRUE(steep.segment_free({{-2.0, 0.0}, {0.7, 0.0}}, 0.25));
  EXPECT_FALSE(steep.segment_free({{-2.0, 0.0}, {0.8, 0.0}}, 0.25));
  EXPECT_TRUE(CollisionMap::of(world, 0.2).segment_free({{-2.0, 0.0}, {2.0, 0.0}}, 0.25));
  EXPECT_NEAR(steep.length({{0.0, 0.0}, {2.0, 0.0}}), 1.0 + std::sqrt(5.0), 1e-12);
}

TEST(CollisionMap, SolidsOnAHillStandInTheWayThere) {
  World world;
  world.bounds = {{-3.0, -3.0}, {3.0, 3.0}};
  world.solids = {{"floor", {}, HalfSpaceShape{}},
                  {"crate", {{0.0, 0.0, 1.2}, {}}, BoxShape{{0.3, 0.3, 0.3}}}};
  EXPECT_TRUE(CollisionMap::of(world, 0.2).segment_free({{-2.0, 0.0}, {2.0, 0.0}}, 0.2));
  const World hilly = world.on(std::make_shared<const HeightField>(hill(3.0, 0.25, 1.0, 2.5)));
  EXPECT_FALSE(CollisionMap::of(hilly, 0.2).segment_free({{-2.0, 0.0}, {2.0, 0.0}}, 0.2));
  EXPECT_EQ(hilly.solids.front().name, "terrain");
  EXPECT_EQ(hilly.solids.size(), 2U);
}

TEST(World, FlatTerrainAtTheFloorIsTheFloor) {
  World world;
  world.solids = {{"floor", {}, HalfSpaceShape{}}};
  const auto flat = [&](double z) {
    return world.on(
        std::make_shared<const HeightField>(terrain_of({-1, -1}, {1, 1}, 3, 3, [z](Vec2) { return z; })));
  };
  EXPECT_EQ(flat(0.0).terrain, nullptr);
  EXPECT_EQ(flat(0.0).solids.front().name, "floor");
  ASSERT_NE(flat(0.5).terrain, nullptr);
  EXPECT_EQ(flat(0.5).floor_z_m, 0.5);
  EXPECT_EQ(flat(0.5).ground_z_m({0.2, 0.2}), 0.5);
}

TEST(Contours, LieAtTheirHeightAndAreWhole) {
  Rng rng(6);
  for (int i = 0; i < cases(100); ++i) {
    const HeightField field = random_terrain(rng);
    const double step = contour_step(field);
    EXPECT_LE((field.highest_m() - field.lowest_m()) / step, 12.0 + 1e-9);
    for (const Contour& line : contours(field, step)) {
      ASSERT_GE(line.points.size(), 2U);
      for (std::size_t k = 0; k < line.points.size(); ++k) {
        EXPECT_NEAR(field.height(line.points[k]), line.height_m, 1e-9);
        if (k == 0) continue;  // between two points it stays on one triangle
        EXPECT_NEAR(field.height(0.5 * (line.points[k - 1] + line.points[k])), line.height_m, 1e-9);
      }
      const Box2 box = field.bounds();
      const auto on_edge = [&](Vec2 p) {
        return std::min({p.x - box.low.x, p.y - box.low.y, box.high.x - p.x, box.high.y - p.y}) < 1e-9;
      };
      const bool closed = distance(line.points.front(), line.points.back()) < 1e-12;
      EXPECT_TRUE(closed || (on_edge(line.points.front()) && on_edge(line.points.back())));
    }
  }
}

TEST(Contours, OfAConeAreRings) {
  const HeightField cone = terrain_of({-2, -2}, {0.1, 0.1}, 41, 41, [](Vec2 p) { return 1.0 - norm(p); });
  for (const Contour& ring : contours(cone, 0.25)) {
    if (ring.height_m < -0.9) continue;  // cut by the edge
    for (const Vec2 p : ring.points) EXPECT_NEAR(norm(p), 1.0 - ring.height_m, 0.02);
  }
}

}  // namespace
}  // namespace outrider
