// Steps of a path against rooms whose walls are known, and the overlap of scans against a search of all
// pairs.
#include "map/path_check.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "laser_room.hpp"
#include "outrider/core/units.hpp"
#include "outrider/slam/laser/laser_slam.hpp"
#include "support/random_cases.hpp"

namespace outrider {
namespace {

/// Sees half a turn, ahead.
testing::Finder half_turn_finder() {
  testing::Finder finder;
  finder.beams = 181;
  finder.first_rad = -0.5 * pi;
  finder.most_m = 8.0;
  return finder;
}

LaserScan half_turn_scan(const Pose2& pose, Rng& rng) {
  return testing::scan_from(testing::furnished_room(), pose, half_turn_finder(), rng);
}

double share_by_all_pairs(const Surface& a, const Pose2& b_T_a, const Surface& b) {
  double counted = 0.0, on = 0.0;
  for (const SurfacePoint& p : a) {
    if (p.normal == Vec2{}) continue;
    counted += 1.0;
    on += std::ranges::any_of(b, [&](const SurfacePoint& q) {
      return distance(b_T_a * p.position, q.position) <= 0.15 &&
             dot(rotated(b_T_a.heading_rad, p.normal), q.normal) >= 0.5;
    });
  }
  return on / counted;
}

TEST(PathCheck, TheShareIsThatOfASearchOfAllPairs) {
  Rng rng(1);
  for (int trial = 0; trial < testing::cases(20); ++trial) {
    const Pose2 a{{rng.uniform(1.8, 2.8), rng.uniform(1.5, 2.5)}, rng.uniform(-pi, pi)};
    const Pose2 b{a.position + testing::random_point(rng, 0.3), a.heading_rad + rng.uniform(-1.5, 1.5)};
    const Surface of_a = surface_of(half_turn_scan(a, rng), {}, 30.0);
    const Surface of_b = surface_of(half_turn_scan(b, rng), {}, 30.0);
    const Pose2 b_T_a = relative_pose(b, a);
    const double share = share_on(of_a, b_T_a, of_b);
    EXPECT_DOUBLE_EQ(share, share_by_all_pairs(of_a, b_T_a, of_b));
    EXPECT_GT(share, 0.2) << "they look the same way, by and large";
  }
}

TEST(PathCheck, TheTwoFacesOfAWallAreNotOneSurface) {
  const Surface near{{{1.0, 0.0}, {-1.0, 0.0}}}, far{{{1.1, 0.0}, {1.0, 0.0}}};
  EXPECT_EQ(share_on(near, {}, near), 1.0);
  EXPECT_EQ(share_on(near, {}, far), 0.0);
  EXPECT_EQ(share_on({}, {}, near), 0.0);
}

/// A drive along the room with odometry that is right.
KeyframeGraph drive_past_walls(Rng& rng) {
  KeyframeGraph graph;
  for (int i = 0; i < 8; ++i) {
    const Pose2 pose{{1.0 + 0.25 * i, 1.7}, 0.05 * i};
    const Pose2 odometry = i == 0 ? Pose2{} : relative_pose(graph.keyframes.back().pose, pose);
    graph.keyframes.push_back({pose, 0.25 * i, half_turn_scan(pose, rng), odometry, {0.05, 0.05}});
  }
  return graph;
}

TEST(PathCheck, OdometryThatIsWrongIsNoJumpWhereTheScansOverlap) {
  Rng rng(2);
  KeyframeGraph graph = drive_past_walls(rng);
  KeyframeSurfaces surfaces({}, 30.0);
  EXPECT_TRUE(find_jumps(graph, surfaces).empty());
  graph.keyframes[4].odometry.heading_rad += 0.5 * pi;
  ASSERT_GT(shared_surface(graph, surfaces, 3, 4), 0.6);
  EXPECT_TRUE(find_jumps(graph, surfaces).empty());
}

/// A robot is turned by hand, and the map has it half-way between what odometry and what the scans say.
TEST(PathCheck, AMapBetweenOdometryAndScansIsAJump) {
  Rng rng(8);
  KeyframeGraph graph = drive_past_walls(rng);
  KeyframeSurfaces surfaces({}, 30.0);
  Keyframe& turned = graph.keyframes[7];
  Pose2 truth = turned.pose;
  truth.heading_rad += 0.24;
  turned.scan = half_turn_scan(truth, rng);
  turned.odometry_noise = {0.02, 0.02};
  turned.pose.heading_rad += 0.12;
  ASSERT_GT(shared_surface(graph, surfaces, 6, 7), 0.5) << "most surfaces still lie near each other";
  const std::vector<Jump> jumps = find_jumps(graph, surfaces);
  ASSERT_EQ(jumps.size(), 1U);
  EXPECT_EQ(jumps[0].after, 7U);
  turned.pose = truth;
  EXPECT_TRUE(find_jumps(graph, surfaces).empty()) << "the scans confirm it";
}

TEST(PathCheck, WhatNeitherOdometryNorScansConfirmIsAJump) {
  Rng rng(3);
  KeyframeGraph graph = drive_past_walls(rng);
  Keyframe& carried = graph.keyframes[7];
  carried.pose = {{1.0, 2.5}, pi};
  carried.scan = half_turn_scan(carried.pose, rng);
  KeyframeSurfaces surfaces({}, 30.0);
  ASSERT_LT(shared_surface(graph, surfaces, 6, 7), 0.2);
  const std::vector<Jump> jumps = find_jumps(graph, surfaces);
  ASSERT_EQ(jumps.size(), 1U);
  EXPECT_EQ(jumps[0].before, 6U);
  EXPECT_EQ(jumps[0].after, 7U);
  EXPECT_NEAR(norm(jumps[0].by_map.position), std::hypot(1.5, 0.8), 1e-9);
  EXPECT_NEAR(norm(jumps[0].by_odometry.position), 0.25, 1e-9);
  carried.odometry = relative_pose(graph.keyframes[6].pose, carried.pose);
  EXPECT_TRUE(find_jumps(graph, surfaces).empty()) << "odometry confirms it";
}

/// Only the scans can tell what odometry missed in a minute without a scan.
TEST(PathCheck, AStepAfterAPauseNeedsScansThatAgree) {
  Rng rng(6);
  KeyframeGraph graph = drive_past_walls(rng);
  KeyframeSurfaces surfaces({}, 30.0);
  Keyframe& later = graph.keyframes[7];
  later.pose = compose(graph.keyframes[6].pose, {{1.0, 0.0}, 0.0});
  later.odometry = {{1.0, 0.0}, 0.0};
  later.scan = half_turn_scan(later.pose, rng);
  later.shared_before = 0.45;
  later.pause_s = 59.0;
  EXPECT_TRUE(find_jumps(graph, surfaces).empty()) << "odometry confirms it";
  later.pause_s = 61.0;
  const std::vector<Jump> jumps = find_jumps(graph, surfaces);
  ASSERT_EQ(jumps.size(), 1U);
  EXPECT_EQ(jumps[0].after, 7U);
  EXPECT_EQ(jumps[0].pause_s, 61.0);
  later.odometry.heading_rad = 0.5;
  ASSERT_GT(shared_surface(graph, surfaces, 6, 7), 0.34);
  EXPECT_EQ(find_jumps(graph, surfaces).at(0).pause_s, 61.0) << "the pause alone speaks against it";

  later.shared_before = 0.55;
  EXPECT_TRUE(find_jumps(graph, surfaces).empty()) << "the scans confirm it";
}

/// Without scans on the way, several places may lie within the error of the odometry, and the scans fit the
/// one that was chosen.
TEST(PathCheck, AStepThatOdometryHardlyMeasuresNeedsToAgreeWithIt) {
  Rng rng(7);
  KeyframeGraph graph = drive_past_walls(rng);
  KeyframeSurfaces surfaces({}, 30.0);
  Keyframe& later = graph.keyframes[7];
  ASSERT_GT(shared_surface(graph, surfaces, 6, 7), 0.6);
  later.odometry_noise = {0.4, 0.3};
  EXPECT_TRUE(find_jumps(graph, surfaces).empty());
  later.odometry.position.x += 0.5;
  const std::vector<Jump> jumps = find_jumps(graph, surfaces);
  ASSERT_EQ(jumps.size(), 1U) << "the scans agree, and would at other places";
  EXPECT_EQ(jumps[0].odometry_sd_m, 0.4);
  EXPECT_EQ(jumps[0].pause_s, 0.0);
  later.odometry_noise = {0.6, 0.3};
  EXPECT_TRUE(find_jumps(graph, surfaces).empty()) << "within its error, and the scans agree";
}

TEST(PathCheck, AShortStepAfterWhichTheScansDifferIsAJump) {
  Rng rng(5);
  KeyframeGraph graph = drive_past_walls(rng);
  KeyframeSurfaces surfaces({}, 30.0);
  graph.keyframes[4].shared_before = 0.45;
  const std::vector<Jump> jumps = find_jumps(graph, surfaces);
  ASSERT_EQ(jumps.size(), 1U) << "though odometry confirms it";
  EXPECT_EQ(jumps[0].after, 4U);
  EXPECT_EQ(jumps[0].shared, 0.45);
  graph.keyframes[4].shared_before = 0.55;
  EXPECT_TRUE(find_jumps(graph, surfaces).empty());
}

TEST(PathCheck, OfAReleasedScanTheShareOfItsTimeCounts) {
  Rng rng(4);
  KeyframeGraph graph = drive_past_walls(rng);
  graph.keyframes[4].odometry = {{2.0, 0.0}, 1.0};
  graph.keyframes[3].release_scan();
  KeyframeSurfaces surfaces({}, 30.0);
  graph.keyframes[4].shared_before = 0.8;
  EXPECT_TRUE(find_jumps(graph, surfaces).empty());
  graph.keyframes[4].shared_before = 0.1;
  EXPECT_EQ(find_jumps(graph, surfaces).size(), 1U);
}

/// A robot drives a lap around the room, and is then put down again at a place of that lap.
TEST(PathCheck, AMapperOwnsUpToHavingBeenCarried) {
  Rng rng(5);
  const auto place = [](int i) {
    const double angle = 2.0 * pi * i / 80.0;
    return Pose2{Vec2{2.4, 2.1} + 0.6 * direction(angle), wrap_angle(angle + 0.5 * pi)};
  };
  for (const bool is_carried : {false, true}) {
    LaserSlamOptions options;
    options.key_distance_m = 0.1;
    auto slam = LaserSlam::begin(options, place(0));
    ASSERT_TRUE(slam);
    std::size_t matched = 0;
    const auto step = [&](int at, const Pose2& motion) {
      auto done = slam->advance(motion, half_turn_scan(place(at), rng));
      ASSERT_TRUE(done);
      matched += done->matched ? 1 : 0;
    };
    step(0, {});
    for (int i = 1; i < 100; ++i) step(i, relative_pose(place(i - 1), place(i)));
    const int put_down = is_carried ? 60 : 100;
    for (int i = 0; i < 10; ++i)
      step(put_down + i, relative_pose(place(put_down + i - 1), place(put_down + i)));
    slam->settle();
    ASSERT_EQ(matched, 109U);
    ASSERT_LT(distance(slam->pose().position, place(put_down + 9).position), 0.1);
    const MapCheck check = slam->check();
    ASSERT_EQ(check.jumps.size(), is_carried ? 1U : 0U);
    if (!is_carried) continue;
    EXPECT_NEAR(static_cast<double>(check.jumps[0].after), 101.0, 1.0);
    EXPECT_GT(norm(check.jumps[0].by_map.position), 0.8);
  }
}

}  // namespace
}  // namespace outrider
