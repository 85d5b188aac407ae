// Local maps hold no more scans of a place that is known.
#include "laser/local_map.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "laser_room.hpp"
#include "outrider/core/units.hpp"
#include "outrider/slam/laser/laser_slam.hpp"

namespace outrider {
namespace {

/// Keyframes on a circle in a room, each well joined to the one before and to the one a lap earlier.
KeyframeGraph laps(int count, int keyframes_a_lap) {
  Rng rng(1);
  KeyframeGraph graph;
  LocalMap local({}, 30.0);
  for (int i = 0; i < count * keyframes_a_lap; ++i) {
    const double angle = 2.0 * pi * i / keyframes_a_lap;
    const Pose2 pose{Vec2{2.3, 2.0} + 0.5 * direction(angle), wrap_angle(angle + 0.5 * pi)};
    graph.keyframes.push_back({pose, 0.2 * i, testing::scan_from(testing::furnished_room(), pose, {}, rng)});
    const auto key = static_cast<std::uint32_t>(i), lap = static_cast<std::uint32_t>(keyframes_a_lap);
    const Eigen::Matrix3d certain = 1e5 * Eigen::Matrix3d::Identity();
    if (key > 0) graph.add_constraint(key - 1, key, pose, certain);
    if (key >= lap) graph.add_constraint(key - lap, key, pose, certain);
    local.build(graph, 0, pose);
  }
  return graph;
}

std::ptrdiff_t held(const KeyframeGraph& graph) {
  return std::ranges::count_if(graph.keyframes, [](const Keyframe& key) { return key.has_scan(); });
}

TEST(LocalMap, HoldsTheFirstAndTheLastScansOfAPlaceThatIsKnown) {
  const KeyframeGraph few = laps(12, 24), more = laps(24, 24);
  ASSERT_LT(held(few), std::ssize(few.keyframes)) << "else nothing was released";
  EXPECT_LT(held(more), held(few) + 24);
  for (const Keyframe& key : more.keyframes) EXPECT_TRUE(key.has_scan() || key.scan.ranges_m.capacity() == 0);
  EXPECT_TRUE(std::ranges::all_of(more.keyframes.begin(), more.keyframes.begin() + 48, &Keyframe::has_scan));
  EXPECT_TRUE(std::ranges::all_of(more.keyframes.end() - 20, more.keyframes.end(), &Keyframe::has_scan));
}

TEST(LocalMap, OfAFewVisitsEachScanIsHeld) {
  const KeyframeGraph graph = laps(3, 24);
  EXPECT_EQ(held(graph), std::ssize(graph.keyframes));
}

/// Twenty laps are mapped as well as the first ones were, though most of their scans are released.
TEST(LocalMap, ALongDriveInARoomStaysAccurate) {
  Rng rng(2);
  Pose2 pose{{2.8, 2.0}, 0.5 * pi};
  LaserSlamOptions options;
  options.key_distance_m = 0.1;
  auto slam = LaserSlam::begin(options, pose);
  ASSERT_TRUE(slam);
  int known = 0;
  for (int i = 0; i < 20 * 24; ++i) {
    const Pose2 motion{{0.13, 0.0}, 2.0 * pi / 24};
    if (i > 0) pose = compose(pose, motion);
    const auto step = slam->advance(i == 0 ? Pose2{} : Pose2{{0.134, 0.0}, motion.heading_rad * 1.01},
                                    testing::scan_from(testing::furnished_room(), pose, {}, rng));
    ASSERT_TRUE(step);
    known += step->is_known_place ? 1 : 0;
    ASSERT_LT(distance(step->pose.position, pose.position), 0.05) << i;
  }
  EXPECT_GT(known, 100);
  EXPECT_LT(slam->check().scans, 300U);
  EXPECT_EQ(slam->check().contradicted, 0U);
}

}  // namespace
}  // namespace outrider
