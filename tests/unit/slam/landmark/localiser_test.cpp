#include "outrider/slam/landmark/localiser.hpp"

#include <gtest/gtest.h>

#include "tag_course.hpp"

namespace outrider {
namespace {

TEST(Localiser, FollowsTheRobotOnAMapThatStaysAsItIs) {
  const TagRun made = tag_run(12, {4, 2}), run = tag_run(13, {4, 2});
  const LandmarkMap map = after({}, made.log).landmarks();
  for (const bool ids : {true, false}) {
    auto localiser = Localiser::begin(map, {}, {run.log.start.position + Vec2{0.05, -0.05}, 0.1},
                                      0.01 * Eigen::Matrix3d::Identity());
    ASSERT_TRUE(localiser);
    for (std::size_t i = 0; i < run.log.steps.size(); ++i) {
      LogStep step = run.log.steps[i];
      for (LandmarkSighting& s : step.sightings) {
        if (!ids) s.id.reset();
      }
      const auto outcome = localiser->advance(step);
      ASSERT_TRUE(outcome);
      EXPECT_FALSE(outcome->lost);
    }
    EXPECT_LT(distance(localiser->pose().position, run.poses.back().position), 0.1);
    EXPECT_EQ(localiser->map(), map);
  }
  EXPECT_EQ(Localiser::begin({}, {}, {}, Eigen::Matrix3d::Zero()).error().sentence,
            "the map has no landmarks; expected at least one");
}

}  // namespace
}  // namespace outrider
