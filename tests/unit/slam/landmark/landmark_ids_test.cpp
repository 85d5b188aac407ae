// Landmark SLAM without ids: landmarks are told apart by where they stand.
#include <gtest/gtest.h>

#include <cmath>

#include "outrider/slam/landmark/landmark_slam.hpp"
#include "support/random_cases.hpp"
#include "tag_course.hpp"

namespace outrider {
namespace {

TEST(LandmarkSlam, WithoutIdsJointCompatibilityTellsTheTagsApart) {
  for (std::uint64_t seed = 1; seed <= static_cast<std::uint64_t>(testing::cases(5)); ++seed) {
    TagRun run = tag_run(seed, {4, 2});
    for (LogStep& step : run.log.steps) {
      for (LandmarkSighting& s : step.sightings) s.id.reset();
    }
    LandmarkSlamOptions options;
    options.engine = "ekf";
    options.unknown_ids = true;
    options.patience_distance_m = 0.2;
    const LandmarkMap map = after(options, run.log).landmarks();
    EXPECT_EQ(map.size(), 8U);
    for (const LandmarkEstimate& tag : map) {
      double nearest = HUGE_VAL;
      for (const auto& [id, place] : run.log.true_landmarks) {
        nearest = std::min(nearest, distance(place, tag.position));
      }
      EXPECT_LT(nearest, 0.2);
    }
  }
}

/// Two posts stand nearer to each other than sightings of one new landmark may.
TEST(LandmarkSlam, WithoutIdsAPostBesideAnotherOneIsALandmarkToo) {
  LandmarkSlamOptions options;
  options.engine = "ekf";
  options.unknown_ids = true;
  const std::vector<Vec2> posts = {{2.0, 0.5}, {2.0, 1.1}};
  ASSERT_LT(distance(posts[0], posts[1]), options.patience_distance_m);
  LandmarkSlam slam = begun(options, {});
  int refused = 0;
  for (int i = 1; i <= 20; ++i) {
    LogStep step{0.0, {{0.05, 0.0}, 0.0}, Eigen::Vector3d(1e-5, 1e-5, 1e-6).asDiagonal(), {}};
    for (const Vec2 post : posts) {
      if (i < 4 && post == posts[1]) continue;  // the first post is known before the second is seen
      step.sightings.push_back({{}, post - Vec2{0.05 * i, 0.0}, 1e-4 * Eigen::Matrix2d::Identity()});
    }
    const auto outcome = slam.advance(step);
    ASSERT_TRUE(outcome);
    refused += outcome->refused;
  }
  EXPECT_EQ(refused, 0);
  const LandmarkMap map = slam.landmarks();
  ASSERT_EQ(map.size(), 2U);
  for (std::size_t i = 0; i < 2; ++i) EXPECT_LT(distance(map[i].position, posts[i]), 0.01);
}

}  // namespace
}  // namespace outrider
