#include "outrider/sim/sensors/range_finder.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "outrider/world/blocks.hpp"
#include "support/random_cases.hpp"

namespace outrider {
namespace {

using testing::cases;

constexpr double inf = std::numeric_limits<double>::infinity();

std::vector<RoundedPolygon> random_pieces(Rng& rng, int count) {
  std::vector<RoundedPolygon> pieces;
  for (int i = 0; i < count; ++i) {
    RoundedPolygon piece = testing::random_rounded_polygon(rng, 1.0);
    if (piece.core.size() == 1) piece.radius_m += 0.01;  // a point has no outline
    const Vec2 aside = testing::random_point(rng, 5.0);
    for (Vec2& corner : piece.core) corner = corner + aside;
    pieces.push_back(std::move(piece));
  }
  return pieces;
}

double gap(Vec2 p, const std::vector<RoundedPolygon>& pieces) {
  double nearest = inf;
  for (const RoundedPolygon& piece : pieces) nearest = std::min(nearest, signed_distance(p, piece));
  return nearest;
}

/// Walks along the beam by what is free around each point.
double walked(Vec2 from, Vec2 along, const std::vector<RoundedPolygon>& pieces, double most_m) {
  double t = 0.0;
  while (t <= most_m) {
    const double free = gap(from + t * along, pieces);
    if (free < 1e-9) return t;
    t += free;
  }
  return inf;
}

TEST(RangeFinder, BeamsAreThoseOfAWalkThroughAllPieces) {
  Rng rng(1);
  for (int i = 0; i < cases(10); ++i) {
    const std::vector<RoundedPolygon> pieces = random_pieces(rng, 12);
    RangeFinderModel model;
    model.most_m = rng.uniform(1.0, 8.0);
    const RangeFinder laser(pieces, model);
    const Pose2 pose{testing::random_point(rng, 6.0), rng.uniform(-10.0, 10.0)};
    if (gap(pose.position, pieces) < 1e-3) continue;
    const auto beams = static_cast<std::int64_t>(4 + rng.below(90));
    const std::vector<double> ranges = laser.ranges(pose, beams);
    ASSERT_EQ(ranges.size(), static_cast<std::size_t>(beams));
    for (std::size_t k = 0; k < ranges.size(); ++k) {
      const double bearing =
          pose.heading_rad + 2.0 * pi * static_cast<double>(k) / static_cast<double>(beams);
      const double expected = walked(pose.position, direction(bearing), pieces, model.most_m);
      if (std::isinf(expected)) {
        EXPECT_TRUE(std::isinf(ranges[k])) << ranges[k] << " of " << model.most_m;
      } else {
        EXPECT_NEAR(ranges[k], expected, 1e-5);
      }
    }
  }
}

TEST(RangeFinder, SightAndDistanceAreThoseOfAllPieces) {
  Rng rng(2);
  for (int i = 0; i < cases(20); ++i) {
    const std::vector<RoundedPolygon> pieces = random_pieces(rng, 10);
    const RangeFinder laser(pieces, {});
    for (int k = 0; k < 50; ++k) {
      const Segment s{testing::random_point(rng, 6.0), testing::random_point(rng, 6.0)};
      if (gap(s.a, pieces) <= 0.0 || gap(s.b, pieces) <= 0.0) continue;
      const bool free =
          std::ranges::all_of(pieces, [&](const auto& p) { return signed_distance(s, p) > 0.0; });
      EXPECT_EQ(laser.sees(s.a, s.b), free);
      EXPECT_NEAR(laser.surface_distance(s.a, 2.0), std::min(2.0, gap(s.a, pieces)), 1e-9);
    }
  }
}

TEST(RangeFinder, NothingIsSeenThroughAJoint) {
  Rng rng(3);
  for (int i = 0; i < cases(200); ++i) {
    const Vec2 joint = testing::random_point(rng, 2.0);
    const Vec2 along = direction(rng.uniform(-pi, pi));
    const std::vector<RoundedPolygon> walls = {{{joint - along, joint}, 0.0}, {{joint, joint + along}, 0.0}};
    const RangeFinder laser(walls, {});
    const Vec2 from = joint + rng.uniform(0.2, 2.0) * direction(heading_of(along) + rng.uniform(0.1, 3.0));
    const std::vector<double> ranges = laser.ranges({from, heading_of(joint - from)}, 360);
    EXPECT_NEAR(ranges[0], distance(from, joint), 1e-7);
    EXPECT_FALSE(laser.sees(from, joint + (joint - from)));
  }
}

TEST(RangeFinder, MapsAreSeenCellByCell) {
  Rng rng(4);
  for (int i = 0; i < cases(10); ++i) {
    Grid<std::uint8_t> map({{-1.0, -1.0}, 0.1, 20, 20}, free_cell);
    for (auto& cell : map.cells) cell = rng.below(8) == 0 ? occupied_cell : free_cell;
    World world;
    world.solids = blocks(map, 0.0, 1.0);
    const RangeFinder laser(world, {});
    const Cell stand{static_cast<int>(rng.below(20)), static_cast<int>(rng.below(20))};
    if (map[stand] != free_cell) continue;
    const Vec2 from = map.frame.centre(stand);
    const std::vector<double> ranges = laser.ranges({from, 0.01}, 36);
    for (std::size_t k = 0; k < ranges.size(); ++k) {
      const Vec2 along = direction(0.01 + 2.0 * pi * static_cast<double>(k) / 36.0);
      double t = 0.0;
      const auto blocked = [&](Vec2 p) {
        return map.contains(map.frame.cell_at(p)) && map[map.frame.cell_at(p)] != 0;
      };
      while (t < 3.5 && !blocked(from + t * along)) t += 1e-4;
      if (t < 3.5) {
        EXPECT_NEAR(ranges[k], t, 2e-4);
      } else {
        EXPECT_TRUE(std::isinf(ranges[k]));
      }
    }
  }
}

TEST(RangeFinder, MeasuresAsItsModelSays) {
  const std::vector<RoundedPolygon> walls = {{{{2.0, -50.0}, {2.0, 50.0}}, 0.0},
                                             {{{-0.05, -1.0}, {-0.05, 1.0}}, 0.0}};
  RangeFinderModel model;
  model.missed = 0.25;
  const RangeFinder laser(walls, model);
  Rng rng(5);
  double sum = 0.0;
  double squares = 0.0;
  int read = 0;
  for (int i = 0; i < 1500; ++i) {
    const LaserScan scan = laser.look({{0.0, 0.0}, 0.0}, 0.2 * i, rng);
    ASSERT_TRUE(check(scan));
    ASSERT_EQ(scan.ranges_m.size(), 360U);
    EXPECT_LT(scan.ranges_m[180], scan.least_m) << "too near";
    EXPECT_TRUE(scan.ranges_m[80] > scan.most_m || scan.ranges_m[80] == 0.0F) << "too far";
    const double ahead = static_cast<double>(scan.ranges_m[0]);
    if (ahead < scan.least_m) continue;
    ++read;
    sum += ahead - 2.0;
    squares += (ahead - 2.0) * (ahead - 2.0);
  }
  EXPECT_NEAR(read / 1500.0, 0.75, 0.03);
  EXPECT_NEAR(sum / read, 0.0, 1e-3);
  EXPECT_NEAR(std::sqrt(squares / read), 0.01, 1e-3);
}

/// sensor_msgs/LaserScan has single precision, and no range beyond the longest: "no return" is infinite
/// there.
TEST(RangeFinder, MeasuresWhatAMessageCanHold) {
  const std::vector<RoundedPolygon> walls = {{{{3.5, -50.0}, {3.5, 50.0}}, 0.0}};  // as far as it sees
  RangeFinderModel model;
  model.beams = 7;
  const RangeFinder laser(walls, model);
  Rng rng(6);
  int returns = 0, none = 0;
  for (int i = 0; i < 400; ++i) {
    const LaserScan scan = laser.look({{0.0, 0.0}, 0.0}, 0.2 * i, rng);
    for (const double value : {scan.first_rad, scan.step_rad, scan.least_m, scan.most_m})
      ASSERT_EQ(static_cast<double>(static_cast<float>(value)), value);
    const float ahead = scan.ranges_m[0];
    ASSERT_TRUE(std::isinf(ahead) || static_cast<double>(ahead) <= scan.most_m) << ahead;
    ++(std::isinf(ahead) ? none : returns);
    ASSERT_TRUE(std::isinf(scan.ranges_m[3])) << "behind there is nothing";
  }
  EXPECT_GT(returns, 100);
  EXPECT_GT(none, 100);
}

TEST(RangeFinder, AnEmptyWorldShowsNothing) {
  const RangeFinder laser(World{}, {});
  EXPECT_TRUE(laser.bounds().empty());
  for (const double range : laser.ranges({}, 8)) EXPECT_TRUE(std::isinf(range));
  EXPECT_TRUE(laser.sees({0, 0}, {1, 1}));
  EXPECT_EQ(laser.surface_distance({0, 0}, 3.0), 3.0);
}

}  // namespace
}  // namespace outrider
