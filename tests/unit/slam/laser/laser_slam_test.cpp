// Matching and mapping against rooms whose walls are known.
#include "outrider/slam/laser/laser_slam.hpp"

#include <gtest/gtest.h>

#include <ctime>
#include <limits>

#include "laser_room.hpp"
#include "outrider/core/units.hpp"
#include "support/random_cases.hpp"

namespace outrider {
namespace {

using testing::Drive;
using testing::drive_along;
using testing::ring;

struct Mapped {
  double mean_m = 0.0;
  double most_m = 0.0;
  double odometry_m = 0.0;
  int matched = 0;
  int steps = 0;
  std::vector<std::size_t> closings;  ///< numbers of poses of the trajectory
};
Mapped map_along(LaserSlam& slam, const std::vector<testing::Wall>& walls, const Drive& drive, Rng& rng,
                 const testing::Finder& finder = {}) {
  Mapped result;
  Pose2 odometry = drive.poses.front();
  for (std::size_t i = 0; i < drive.poses.size(); ++i) {
    odometry = compose(odometry, drive.motions[i]);
    const auto step = slam.advance(drive.motions[i], testing::scan_from(walls, drive.poses[i], finder, rng));
    EXPECT_TRUE(step);
    const double off = distance(step->pose.position, drive.poses[i].position);
    result.mean_m += off;
    result.most_m = std::max(result.most_m, off);
    result.matched += step->matched ? 1 : 0;
    if (step->closed_loop) result.closings.push_back(i + 1);
    ++result.steps;
  }
  result.mean_m /= result.steps;
  result.odometry_m = distance(odometry.position, drive.poses.back().position);
  return result;
}

TEST(LaserSlam, FollowsADriftingRobotThroughARoom) {
  Rng rng(1);
  for (int trial = 0; trial < testing::cases(1); ++trial) {
    const Drive drive = drive_along({{0.5, 0.5},
                                     {2.4, 0.5},
                                     {2.4, 3.5},
                                     {5.5, 3.5},
                                     {5.5, 0.5},
                                     {3.5, 0.6},
                                     {3.5, 3.4},
                                     {0.5, 3.5},
                                     {0.5, 0.5}},
                                    0.0, rng);
    auto slam = LaserSlam::begin({}, drive.poses.front());
    ASSERT_TRUE(slam);
    const Mapped mapped = map_along(*slam, testing::furnished_room(), drive, rng);
    EXPECT_GT(mapped.odometry_m, 0.3) << "else there is nothing to show";
    EXPECT_LT(mapped.mean_m, 0.025);
    EXPECT_LT(mapped.most_m, 0.05);
    EXPECT_GE(mapped.matched, mapped.steps - 1);
    const Eigen::Matrix3d covariance = slam->pose_covariance();
    EXPECT_GT(covariance(0, 0), 0.0);
    EXPECT_LT(covariance(0, 0), 0.01);
  }
}

Drive round_the_ring(Rng& rng) {
  return drive_along({{3, 0.8}, {12.2, 0.8}, {12.2, 8.2}, {0.8, 8.2}, {0.8, 0.8}, {7, 0.8}}, 0.0, rng);
}

/// Loops end at the poses where they were closed, begin at poses that see the same, and some lead all around.
void expect_loops_of(const LaserSlam& slam, const Drive& drive, const std::vector<std::size_t>& closings) {
  constexpr std::size_t around = 400;  // steps of 4.4 cm
  const std::vector<LaserLoop> loops = slam.closed_loops();
  EXPECT_EQ(loops.size(), slam.loops());
  std::vector<std::size_t> ends;
  std::size_t most = 0;
  for (const LaserLoop& loop : loops) {
    if (ends.empty() || ends.back() != loop.to) ends.push_back(loop.to);
    EXPECT_LT(distance(drive.poses[loop.from - 1].position, drive.poses[loop.to - 1].position), 5.0);
    most = std::max(most, loop.to - loop.from);
  }
  EXPECT_EQ(ends, closings);
  EXPECT_GT(most, around);
}

TEST(LaserSlam, ClosesALoopThatOpenedByDrift) {
  const auto driven = [&](bool close_loops, bool late) {
    Rng rng(3);
    const Drive drive = round_the_ring(rng);
    LaserSlamOptions options;
    options.close_loops = close_loops;
    options.draw_late = late;
    options.odometry_distance = 0.1;
    auto slam = LaserSlam::begin(options, drive.poses.front());
    const Mapped mapped = map_along(*slam, ring(), drive, rng);
    slam->settle();
    if (close_loops) expect_loops_of(*slam, drive, mapped.closings);
    return std::pair(std::move(*slam), distance(slam->pose().position, drive.poses.back().position));
  };
  const auto [open, open_m] = driven(false, true);
  const auto [closed, closed_m] = driven(true, true);
  const auto [drawn, drawn_m] = driven(true, false);
  EXPECT_EQ(open.loops(), 0U);
  EXPECT_GE(closed.loops(), 1U);
  EXPECT_GT(open_m, 2.0 * closed_m) << "else there is nothing to show";
  EXPECT_LT(closed_m, 0.1);
  EXPECT_EQ(closed.trajectory(), drawn.trajectory()) << "drawing changes no pose";
  EXPECT_EQ(closed.map().occupancy().cells, drawn.map().occupancy().cells);
}

TEST(LaserSlam, ItsMapIsTheOneThatItsUpdatesTellOf) {
  Rng rng(4);
  const Drive drive = drive_along({{0.5, 0.5}, {2.4, 0.5}, {2.4, 2.0}}, 0.0, rng);
  auto slam = LaserSlam::begin({}, drive.poses.front());
  Grid<std::uint8_t> told;
  for (std::size_t i = 0; i < drive.poses.size(); ++i) {
    const auto step = slam->advance(drive.motions[i],
                                    testing::scan_from(testing::furnished_room(), drive.poses[i], {}, rng));
    if (step->update.redrawn) told = slam->map().occupancy();
    for (const std::size_t cell : step->update.cells) told.cells[cell] = slam->map().occupancy().cells[cell];
    ASSERT_EQ(told.cells, slam->map().occupancy().cells);
  }
}

TEST(LaserSlam, TrustedOdometryIsThePose) {
  Rng rng(5);
  LaserSlamOptions options;
  options.trust_odometry = true;
  options.robot_T_laser = {{0.1, 0.0}, 0.0};
  auto slam = LaserSlam::begin(options, {{1.0, 1.0}, 0.5});
  ASSERT_TRUE(slam);
  Pose2 pose{{1.0, 1.0}, 0.5};
  OccupancyMap map(options.map);
  for (int i = 0; i < 5; ++i) {
    const Pose2 motion{{0.2, 0.0}, 0.1};
    pose = compose(pose, motion);
    const LaserScan scan =
        testing::scan_from(testing::furnished_room(), compose(pose, options.robot_T_laser), {}, rng);
    const auto step = slam->advance(motion, scan);
    map.insert(compose(pose, options.robot_T_laser), scan);
    EXPECT_EQ(step->pose, pose);
    EXPECT_FALSE(step->matched);
  }
  EXPECT_EQ(slam->map().occupancy().cells, map.occupancy().cells);
  EXPECT_EQ(slam->trajectory().size(), 6U);
}

TEST(LaserSlam, OneBadScanKillsNoRun) {
  Rng rng(6);
  const Drive drive = drive_along({{0.5, 0.5}, {2.4, 0.5}, {2.4, 2.4}}, 0.0, rng);
  auto slam = LaserSlam::begin({}, drive.poses.front());
  const float nothing = std::numeric_limits<float>::quiet_NaN();
  for (std::size_t i = 0; i < drive.poses.size(); ++i) {
    LaserScan scan = testing::scan_from(testing::furnished_room(), drive.poses[i], {}, rng);
    if (i % 7 == 1) scan.ranges_m.clear();
    if (i % 7 == 2) scan.ranges_m.assign(360, nothing);
    if (i % 7 == 3) scan.ranges_m.assign(360, 0.5F);  // a hand before the laser, all round
    if (i % 7 == 4) scan.step_rad = std::nan("");
    if (i % 7 == 5) scan.ranges_m.resize(3);
    const auto step = slam->advance(drive.motions[i], scan);
    ASSERT_TRUE(step);
    EXPECT_LT(distance(step->pose.position, drive.poses[i].position), 0.2);
  }
  EXPECT_FALSE(slam->advance({{std::nan(""), 0.0}, 0.0}, {}));
  EXPECT_FALSE(slam->advance({{1e300, 0.0}, 0.0}, {}));
  EXPECT_EQ(slam->trajectory().size(), drive.poses.size() + 1);
}

/// Odometry that is right but for a jump, of a robot that was not moved, or was carried to another room.
struct Jumped {
  int lost = 0;
  double longest_s = 0.0;        ///< of the processor, a step
  double off_m = 0.0;            ///< in the end
  bool matched = false;          ///< the scan at the jump
  int unmatched_after = 0;       ///< the jump
  double end_variance_m2 = 0.0;  ///< of x
};
Jumped map_with_a_jump(double jump_m, bool carried, const testing::Finder& finder = {}) {
  Rng rng(7);
  const Drive drive = drive_along({{0.5, 0.5}, {2.4, 0.5}, {2.4, 3.4}}, 0.0, rng);
  std::vector<testing::Wall> elsewhere = testing::box_walls({-1.3, -2.2}, {4.1, 6.0});
  for (const testing::Wall& wall : testing::box_walls({0.2, 1.1}, {1.5, 1.4})) elsewhere.push_back(wall);
  auto slam = LaserSlam::begin({}, drive.poses.front());
  const std::size_t when = drive.poses.size() / 2;
  Jumped result;
  for (std::size_t i = 0; i < drive.poses.size(); ++i) {
    Pose2 motion = drive.motions[i];
    if (i == when) motion.position.x += jump_m;
    const bool there = carried && i >= when;
    const LaserScan scan =
        testing::scan_from(there ? elsewhere : testing::furnished_room(), drive.poses[i], finder, rng);
    const std::clock_t begin = std::clock();
    const auto step = slam->advance(motion, scan);
    const double took_s = static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC;
    result.longest_s = std::max(result.longest_s, took_s);
    EXPECT_FALSE(step->lost && step->matched);
    result.lost += step->lost ? 1 : 0;
    if (i == when) result.matched = step->matched;
    result.unmatched_after += i > when && !step->matched ? 1 : 0;
    result.off_m = distance(step->pose.position, drive.poses[i].position);
  }
  result.end_variance_m2 = slam->pose_covariance()(0, 0);
  return result;
}

TEST(LaserSlam, AJumpOfItsOdometryIsMendedOrOwnedUpTo) {
  for (const double jump_m : {10.0, 100.0, 1000.0, 1e5}) {
    const Jumped stayed = map_with_a_jump(jump_m, false);
    EXPECT_LT(stayed.longest_s, 10.0) << jump_m;
    EXPECT_TRUE(!stayed.matched || stayed.off_m < 0.1) << jump_m << ": else it is joined later, or lost";
    EXPECT_EQ(stayed.matched, jump_m > 500.0) << "less is beyond what odometry is taken to err by " << jump_m;
    const Jumped carried = map_with_a_jump(jump_m, true);
    EXPECT_LT(carried.longest_s, 10.0) << jump_m;
    EXPECT_FALSE(carried.matched) << jump_m;
    if (jump_m < 20.0) continue;  // nearer than that is a correction
    EXPECT_EQ(carried.lost, 1) << jump_m;
    EXPECT_EQ(carried.unmatched_after, 0) << jump_m;
    EXPECT_GT(carried.end_variance_m2, 0.01 * jump_m * jump_m) << jump_m;
  }
}

/// A laser that sees far turns in steps so fine that more poses are to be told apart than are searched.
TEST(LaserSlam, AJumpInAHallTakesBoundedWork) {
  testing::Finder finder;
  finder.most_m = 80.0;
  for (const double jump_m : {1000.0, 9e5}) {
    const Jumped stayed = map_with_a_jump(jump_m, false, finder);
    EXPECT_LT(stayed.longest_s, 10.0) << jump_m;
    EXPECT_EQ(stayed.matched, stayed.off_m < 0.1) << jump_m;
  }
}

TEST(LaserSlam, RefusesInASentence) {
  LaserSlamOptions options;
  options.map.resolution_m = 0.0;
  const auto refused = LaserSlam::begin(options, {});
  ASSERT_FALSE(refused);
  EXPECT_NE(to_string(refused.error()).find("resolution"), std::string::npos);
  EXPECT_FALSE(LaserSlam::begin({}, {{std::nan(""), 0.0}, 0.0}));
}

}  // namespace
}  // namespace outrider
