// A robot that is carried away while it maps is joined to its map again, wherever on it it was put.
#include <gtest/gtest.h>

#include "flat.hpp"
#include "outrider/slam/laser/laser_slam.hpp"
#include "support/random_cases.hpp"

namespace outrider {
namespace {

using testing::Wall;
using testing::Wanderer;

/// Maps while the robot drives so far.
void map_on(LaserSlam& slam, Wanderer& robot, const std::vector<Wall>& walls, double way_m, Rng& rng) {
  for (const double end_m = robot.way_m + way_m; robot.way_m < end_m;) {
    const Pose2 motion = robot.step();
    ASSERT_TRUE(slam.advance(motion, testing::scan_from(walls, robot.pose, testing::flat_finder, rng)));
  }
}

TEST(LaserRejoin, AKidnappedRobotIsJoinedToItsMapAgain) {
  const int trials = testing::cases(2);
  int joined = 0;
  for (int trial = 0; trial < trials; ++trial) {
    Rng rng(static_cast<std::uint64_t>(trial) + 1);
    const std::vector<Wall> walls = testing::flat(rng);
    Wanderer robot(walls, rng);
    auto slam = LaserSlam::begin({}, robot.pose);
    ASSERT_TRUE(slam);
    map_on(*slam, robot, walls, 60.0, rng);
    ASSERT_LT(distance(slam->pose().position, robot.pose.position), 0.1) << trial;
    testing::kidnap(robot, walls, rng);
    const auto at = slam->trajectory().size();
    map_on(*slam, robot, walls, 0.1, rng);
    EXPECT_GT(distance(slam->pose().position, robot.pose.position), 1.0)
        << trial << ": it is not noticed at once";
    map_on(*slam, robot, walls, 15.0, rng);
    slam->settle();
    const bool is_right = distance(slam->pose().position, robot.pose.position) < 0.1;
    const MapCheck check = slam->check();
    const bool is_told = !slam->gaps().empty() || !check.jumps.empty() || check.contradicted > 0;
    EXPECT_TRUE(is_right || is_told) << trial << ": wrong, and nothing says so";
    joined += is_right ? 1 : 0;
    if (is_right) {
      EXPECT_TRUE(std::ranges::any_of(check.jumps, [&](const Jump& jump) { return jump.after + 60 >= at; }))
          << trial;
    }
  }
  EXPECT_GE(4 * joined, trials) << "within 15 m";
  RecordProperty("joined", joined);
}

}  // namespace
}  // namespace outrider
