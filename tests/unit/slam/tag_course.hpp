// A simulated robot that drives round in a square of tags and looks ahead: what SLAM is measured on.
//
// Eight tags stand on the corners and the middles of a square of 1.8 m about the origin. The robot drives
// along a square of 0.8 m or an octagon of 0.3313 m side, counter-clockwise, and looks twice before it
// starts, then every 2.5 cm and every 7.5 degrees. Odometry is off by 0.2 m after a metre, along and across,
// and by 5 degrees after a metre and after a quarter turn; errors of steps are independent, so that they grow
// with the root. The camera sees tags within 90 degrees and 2.5 m; their places are off by 1 cm in the middle
// of the image and by twice that at its edge.
#pragma once

#include <gtest/gtest.h>

#include "outrider/core/rng.hpp"
#include "outrider/slam/landmark/landmark_log.hpp"
#include "outrider/slam/landmark/landmark_slam.hpp"

namespace outrider {

struct TagCourse {
  int sides = 4;  ///< 4 or 8
  int laps = 1;
};

struct TagRun {
  LandmarkLog log;
  std::vector<Pose2> poses;  ///< the true ones, after each step
};

TagRun drive_tag_course(const TagCourse& course, Rng& rng);

/// An engine that is about to begin.
inline LandmarkSlam begun(const LandmarkSlamOptions& options, const Pose2& start) {
  auto slam = LandmarkSlam::begin(options, start);
  EXPECT_TRUE(slam) << to_string(slam.error());
  return std::move(*slam);
}

/// The engine after the whole log.
inline LandmarkSlam after(const LandmarkSlamOptions& options, const LandmarkLog& log) {
  LandmarkSlam slam = begun(options, log.start);
  for (const LogStep& step : log.steps) EXPECT_TRUE(slam.advance(step));
  return slam;
}

inline TagRun tag_run(std::uint64_t seed, const TagCourse& course = {}) {
  Rng rng(seed);
  return drive_tag_course(course, rng);
}

}  // namespace outrider
