#include "outrider/jobs/explore/choose/decide.hpp"

#include <gtest/gtest.h>

#include "outrider/jobs/explore/choose/catalog.hpp"
#include "support/costly_cases.hpp"
#include "support/grid_explorer.hpp"
#include "support/random_rooms.hpp"

namespace outrider {
namespace {

constexpr RobotModel round_robot{.radius_m = 0.105, .speed_mps = 0.22, .turn_rate_radps = 2.84};

/// A map drawn by hand, the top row first: '.' free, '#' occupied, else unknown; cells of 0.1 m. The robot
/// stands at 'R' and its home is there.
struct Drawn {
  Grid<std::uint8_t> map;
  FrontierMap frontiers{{}, 0.105};
  Blacklist blacklist;
  Pose2 pose;

  explicit Drawn(const std::vector<std::string>& rows) {
    GridFrame frame;
    frame.resolution_m = 0.1;
    frame.width = static_cast<int>(rows[0].size());
    frame.height = static_cast<int>(rows.size());
    map = Grid<std::uint8_t>(frame, unknown_cell);
    for (int y = 0; y < frame.height; ++y) {
      for (int x = 0; x < frame.width; ++x) {
        const char c = rows[static_cast<std::size_t>(frame.height - 1 - y)][static_cast<std::size_t>(x)];
        if (c == '.' || c == 'R') map[{x, y}] = free_cell;
        if (c == '#') map[{x, y}] = occupied_cell;
        if (c == 'R') pose.position = frame.centre({x, y});
      }
    }
    frontiers.update(map, {.redrawn = true, .cells = {}});
  }
  [[nodiscard]] Outcome<Decision> decide(const ExploreOptions& options = {}, ExploreChoice before = {}) {
    Workspace workspace;
    return outrider::decide(state(before), options, workspace);
  }
  [[nodiscard]] ExploreState state(ExploreChoice before = {}) {
    return {frontiers, blacklist, round_robot, 3.5, pose, pose, 0.0, before};
  }
};

const std::vector<std::string> closed = {"##########", "#........#", "#........#", "#........#", "#...R....#",
                                         "#........#", "#........#", "#........#", "##########"};
const std::vector<std::string> open = {
    "##########          ", "#.........          ", "#.........          ",
    "#.........          ", "#...R.....          ", "#.........          ",
    "#.........          ", "#.........          ", "##########          "};

TEST(Decide, IsCompleteWhereNothingIsLeft) {
  Drawn drawn(closed);
  const auto decision = drawn.decide();
  ASSERT_TRUE(decision);
  EXPECT_EQ(decision->kind, DecisionKind::complete);
  EXPECT_TRUE(decision->refused.empty());
  EXPECT_EQ(decision->goal.position, drawn.pose.position);
}

TEST(Decide, GoesToSeeWhatIsOpen) {
  for (const ExploreStrategy& row : explore_strategies()) {
    Drawn drawn(open);
    ExploreOptions options;
    options.strategy = row.name;
    const auto decision = drawn.decide(options);
    ASSERT_TRUE(decision);
    EXPECT_EQ(decision->kind, DecisionKind::go);
    EXPECT_EQ(decision->waypoints.front(), drawn.pose.position);
    EXPECT_EQ(decision->waypoints.back(), decision->goal.position);
    EXPECT_NEAR(decision->goal.heading_rad, 0.0, 1.0) << "facing the opening";
    EXPECT_GT(decision->gain_m2, 1.0);
  }
}

TEST(Decide, RefusesWithReasons) {
  Drawn sealed({"####################", "#........##........ ", "#........##........ ",
                "#...R....##........ ", "#........##........ ", "#........##........ ",
                "####################"});
  ExploreOptions options;
  options.view_m = 1.0;
  const auto decision = sealed.decide(options);
  ASSERT_TRUE(decision);
  EXPECT_EQ(decision->kind, DecisionKind::complete);
  ASSERT_EQ(decision->refused.size(), 1U);
  EXPECT_EQ(decision->refused[0].reason, "no known way leads to where it would be seen");

  Drawn crack({"##########", "#........#", "#........ ", "#...R....#", "#........#", "##########"});
  const auto none = crack.decide();
  ASSERT_TRUE(none);
  EXPECT_EQ(none->kind, DecisionKind::complete);
  ASSERT_EQ(none->refused.size(), 1U);
  EXPECT_NE(none->refused[0].reason.find("crack"), std::string::npos);
}

TEST(Decide, LeavesAPlaceThatFailedAloneForAWhile) {
  Drawn drawn(open);
  const auto first = drawn.decide();
  ASSERT_TRUE(first);
  drawn.blacklist.radius_m = 2.0;
  drawn.blacklist.add(first->goal.position, 0.0);
  const auto second = drawn.decide();
  ASSERT_TRUE(second);
  EXPECT_EQ(second->kind, DecisionKind::complete);
  ASSERT_FALSE(second->refused.empty());
  EXPECT_EQ(second->refused[0].reason, "going there failed 1 times; left alone until 30 s");
  ExploreState later = drawn.state();
  later.time_s = 31.0;
  Workspace workspace;
  const auto third = decide(later, {}, workspace);
  ASSERT_TRUE(third);
  EXPECT_EQ(third->kind, DecisionKind::go);
}

TEST(Decide, BansGrowWithFailures) {
  Blacklist blacklist;
  blacklist.add({1, 1}, 0.0);
  EXPECT_NE(blacklist.find({1.1, 1}, 29.0), nullptr);
  EXPECT_EQ(blacklist.find({1.1, 1}, 30.0), nullptr);
  EXPECT_EQ(blacklist.find({2, 1}, 29.0), nullptr);
  blacklist.add({1.1, 1}, 40.0);
  EXPECT_NE(blacklist.find({1, 1}, 99.0), nullptr);
  EXPECT_EQ(blacklist.find({1, 1}, 100.0), nullptr);
  EXPECT_EQ(blacklist.bans.size(), 1U);
}

TEST(Decide, NoticesAWorldThatLeaks) {
  Drawn drawn(open);
  ExploreOptions options;
  options.most_extent_m = 0.9;
  const auto decision = drawn.decide(options);
  ASSERT_TRUE(decision);
  EXPECT_EQ(decision->kind, DecisionKind::leak);
  EXPECT_NE(decision->sentence.find("1.0 m x 0.9 m"), std::string::npos) << decision->sentence;
}

TEST(Decide, RefusesWhatItCannotDo) {
  Drawn drawn(open);
  ExploreOptions options;
  options.strategy = "tuor";
  const auto unknown = drawn.decide(options);
  ASSERT_FALSE(unknown);
  EXPECT_NE(unknown.error().sentence.find("'tour'"), std::string::npos);
  options = {};
  options.planner = "jpss";
  EXPECT_FALSE(drawn.decide(options));
  drawn.pose.position = {-3.0, 0.0};
  const auto lost = drawn.decide();
  ASSERT_FALSE(lost);
  EXPECT_EQ(lost.error().code, FaultCode::start_blocked);
}

TEST(Decide, DoesNotDependOnMemory) {
  Drawn drawn(open);
  Workspace used;
  Drawn other(closed);
  ASSERT_TRUE(decide(other.state(), {}, used));
  const auto again = decide(drawn.state(), {}, used);
  const auto fresh = drawn.decide();
  ASSERT_TRUE(again && fresh);
  EXPECT_EQ(again->waypoints, fresh->waypoints);
  EXPECT_EQ(again->sentence, fresh->sentence);
}

/// Every place where the robot can stand is known to be free in the end.
double known_part(const testing::GridExplorer& world, const OccupancyMap& map) {
  testing::GridExplorer at = world;
  std::size_t all = 0, known = 0;
  for (std::size_t i = 0; i < world.truth.cells.size(); ++i) {
    if (world.truth.cells[i] != 0) continue;
    at.pose.position = world.truth.frame.centre(world.truth.frame.cell(i));
    if (at.clearance_m() < 0.16) continue;
    ++all;
    const Cell there = map.frame().cell_at(at.pose.position);
    known += map.frame().contains(there) && map.occupancy()[there] == free_cell ? 1 : 0;
  }
  return static_cast<double>(known) / static_cast<double>(all);
}

TEST(Decide, ExploresHousesToTheEndWithEveryStrategy) {
  for (const ExploreStrategy& row : explore_strategies()) {
    for (int n = 0; n < testing::costly_cases(1); ++n) {
      Rng rng(10 + static_cast<std::uint64_t>(n));
      const auto rooms = testing::random_rooms(rng, 2, 0.05);
      testing::GridExplorer world;
      world.truth = rooms.solid;
      world.pose = {rooms.start, 0.0};
      world.range_m = 2.0;
      world.noise_m = 0.01;
      world.beams = 240;
      OccupancyMap map{OccupancyMapOptions{}};
      ExploreOptions options;
      options.strategy = row.name;
      options.view_m = 1.4;
      FrontierMap frontiers(options.frontier, world.robot.radius_m);
      const auto run = testing::explore(world, map, frontiers, options, 300.0, [](auto&&...) {});
      EXPECT_EQ(run.kind, DecisionKind::complete) << row.name << " " << n;
      EXPECT_TRUE(run.home) << row.name << " " << n;
      EXPECT_GT(run.least_clearance_m, world.robot.radius_m) << row.name << " " << n;
      EXPECT_GT(known_part(world, map), 0.995) << row.name << " " << n;
    }
  }
}

}  // namespace
}  // namespace outrider
