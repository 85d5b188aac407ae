#include "outrider/jobs/explore/choose/view.hpp"

#include <gtest/gtest.h>

#include "map/sight.hpp"
#include "support/grid_explorer.hpp"
#include "support/random_cases.hpp"
#include "support/random_rooms.hpp"

namespace outrider {
namespace {

/// The map and the pose after a few scans along a random drive.
struct Known {
  OccupancyMap map{OccupancyMapOptions{}};
  FrontierMap frontiers{{}, 0.105};
  testing::GridExplorer robot;

  explicit Known(std::uint64_t seed, int scans) {
    Rng rng(seed);
    const auto rooms = testing::random_rooms(rng, 2, 0.05);
    robot.truth = rooms.solid;
    robot.pose = {rooms.start, 0.3};
    robot.range_m = 2.0;
    for (int i = 0; i < scans; ++i) {
      const MapUpdate update = map.insert(robot.pose, robot.scan());
      frontiers.update(map.occupancy(), update);
      robot.pose.position = robot.pose.position + Vec2{rng.uniform(-0.1, 0.1), rng.uniform(-0.1, 0.1)};
    }
  }
};

/// Returns true if the straight way between two points lies in free cells, but for its end in `last`; dense
/// sampling.
bool sees(const Grid<std::uint8_t>& known, Vec2 from, Vec2 to, Cell last) {
  const int parts = 1 + static_cast<int>(distance(from, to) / (0.04 * known.frame.resolution_m));
  for (int i = 0; i <= parts; ++i) {
    const Cell at = known.frame.cell_at(from + static_cast<double>(i) / parts * (to - from));
    if (!(at == last) && known[at] != free_cell) return false;
  }
  return true;
}

bool sees_from_within(const Grid<std::uint8_t>& known, Cell from, Cell seen) {
  for (int k = 0; k < 121; ++k) {
    const double side = known.frame.resolution_m;
    const Vec2 point = known.frame.corner(from) + side * Vec2{(k % 11 + 0.5) / 11.0, (k / 11 + 0.5) / 11.0};
    if (sees(known, point, known.frame.centre(seen), seen)) return true;
  }
  return false;
}

TEST(View, SeatsSeeWhatTheySayAndAreFree) {
  for (int n = 0; n < testing::cases(2); ++n) {
    Known known(static_cast<std::uint64_t>(n), 6);
    const TraversabilityGrid& ground = known.frontiers.ground();
    SightMemory memory;
    std::size_t looked = 0;
    for (const auto& [id, frontier] : known.frontiers.frontiers()) {
      const FrontierSight sight = sight_of(frontier, known.frontiers, 1.5, memory);
      for (std::size_t i = 0; i < sight.seats.size(); i += 1 + sight.seats.size() / 5) {
        const Seat& seat = sight.seats[i];
        ASSERT_FALSE(ground.blocked(seat.cell));
        ASSERT_EQ(ground.block_of(seat.cell), seat.block);
        const Cell from = ground.frame().cell(seat.cell);
        std::uint32_t seen = 0;
        // The seat is a block: another of its cells may be the one that sees.
        for (const std::uint32_t cell : sight.sample) {
          bool any = false;
          for (int k = 0; k < 4 && !any; ++k) {
            const Cell in_block{from.x / 2 * 2 + k % 2, from.y / 2 * 2 + k / 2};
            any = sees_from_within(ground.known(), in_block, ground.frame().cell(cell));
          }
          seen += any ? 1 : 0;
        }
        ASSERT_GE(seen, seat.seen) << n << " frontier " << id;
        ++looked;
      }
    }
    EXPECT_GT(looked, 3U);
  }
}

TEST(View, SightsThatAreKeptAreThoseOfAFreshLook) {
  Rng rng(5);
  const auto rooms = testing::random_rooms(rng, 2, 0.05);
  testing::GridExplorer robot;
  robot.truth = rooms.solid;
  robot.pose = {rooms.start, 0.3};
  robot.range_m = 1.5;
  OccupancyMap map{OccupancyMapOptions{}};
  FrontierOptions options;
  options.patience = 3;
  FrontierMap frontiers(options, 0.105);
  SightMemory kept;
  std::size_t same = 0, given_up = 0;
  for (int i = 0; i < 40; ++i) {
    MapUpdate update = map.insert(robot.pose, robot.scan());
    if (i % 13 == 12) update = {true, {}};
    frontiers.update(map.occupancy(), update);
    forget_gone(kept, frontiers);
    const std::size_t made = kept.made;
    for (const auto& [id, frontier] : frontiers.frontiers()) {
      SightMemory fresh;
      const FrontierSight& now = sight_of(frontier, frontiers, 1.0, fresh);
      const FrontierSight& then = sight_of(frontier, frontiers, 1.0, kept);
      ASSERT_EQ(then.sample, now.sample) << i;
      ASSERT_EQ(then.seats.size(), now.seats.size()) << i;
      for (std::size_t k = 0; k < now.seats.size(); ++k) {
        ASSERT_EQ(then.seats[k].block, now.seats[k].block);
        ASSERT_EQ(then.seats[k].cell, now.seats[k].cell);
        ASSERT_EQ(then.seats[k].seen, now.seats[k].seen);
      }
      given_up += now.sample.empty() ? 1 : 0;
    }
    same += frontiers.frontiers().size() - (kept.made - made);
    if (!frontiers.frontiers().empty()) frontiers.pursue(frontiers.frontiers().begin()->first);
    const Vec2 next = robot.pose.position + Vec2{rng.uniform(-0.2, 0.2), rng.uniform(-0.2, 0.2)};
    if (testing::cast_ray(robot.truth, robot.pose.position, heading_of(next - robot.pose.position), 1.0) >
        0.4)
      robot.pose.position = next;
  }
  EXPECT_GT(same, 20U);
  EXPECT_GT(given_up, 0U);
}

TEST(View, GainOfTheOpenIsTheDisk) {
  Grid<std::uint8_t> known(GridFrame{{0, 0}, 0.05, 100, 100}, unknown_cell);
  const RayFan fan = RayFan::of(40, 180);
  EXPECT_NEAR(gain_at({50, 50}, known, fan), pi * 2.0 * 2.0, 0.4);
  for (int y = 0; y < 100; ++y) known[{60, y}] = occupied_cell;
  // A wall at 0.475 m: what is left of the disk is a little more than half of it.
  const double cut = 2.0 * 2.0 * std::acos(0.5 / 2.0) - 0.5 * std::sqrt(4.0 - 0.25);
  EXPECT_NEAR(gain_at({50, 50}, known, fan), pi * 4.0 - cut, 0.4);
}

TEST(View, AreReachedInTheirOrderAndInReach) {
  Known known(3, 4);
  const Blacklist none;
  const ExploreState state{known.frontiers, none, known.robot.robot, 2.0, known.robot.pose, known.robot.pose};
  Workspace workspace;
  ExploreOptions options;
  options.view_m = 1.5;
  const Views views = find_views(state, options, workspace);
  ASSERT_GT(views.views.size(), 1U);
  EXPECT_TRUE(views.all);
  for (std::size_t i = 0; i < views.views.size(); ++i) {
    const View& view = views.views[i];
    EXPECT_GE(view.reach_s, views.views[i > 0 ? i - 1 : 0].reach_s);
    EXPECT_GT(view.gain_m2, 0.0);
    auto way = way_to(state, view.pose.position, options, workspace);
    ASSERT_TRUE(way) << way.error().sentence;
    double length = 0.0;
    for (std::size_t k = 1; k < way->size(); ++k) length += distance((*way)[k - 1], (*way)[k]);
    EXPECT_LE(length, view.reach_s * known.robot.robot.speed_mps + 0.3);
    EXPECT_GE(length, 0.92 * view.reach_s * known.robot.robot.speed_mps - 0.3);
  }
  options.most_views = 1;
  const Views nearest = find_views(state, options, workspace);
  ASSERT_EQ(nearest.views.size(), 1U);
  EXPECT_FALSE(nearest.all);
  EXPECT_EQ(nearest.views[0].frontier, views.views[0].frontier);
}

}  // namespace
}  // namespace outrider
