// Landmarks that a consistent filter moves, and those that it must not. Wrong maps of published logs:
// slam_test.py.
#include "outrider/slam/landmark/landmark_check.hpp"

#include <gtest/gtest.h>

#include "outrider/core/units.hpp"
#include "support/random_cases.hpp"
#include "tag_course.hpp"

namespace outrider {
namespace {

LandmarkMap map_of(std::int64_t id, Vec2 place, double sd_m) {
  return {{id, place, sd_m * sd_m * Eigen::Matrix2d::Identity(), 1}};
}

TEST(LandmarkCheck, ALandmarkMayMoveByAsMuchAsItWasUncertain) {
  LandmarkCheck check;
  check.note(1, map_of(7, {1.0, 0.0}, 0.5));
  EXPECT_TRUE(check.judge(map_of(7, {2.0, 1.0}, 0.1)).empty());
  const auto moved = check.judge(map_of(7, {1.0, 6.0}, 0.1));
  ASSERT_EQ(moved.size(), 1U);
  EXPECT_EQ(moved[0].id, 7);
  EXPECT_EQ(moved[0].step, 1U);
  EXPECT_NEAR(moved[0].moved_m, 6.0, 1e-12);
  EXPECT_NEAR(moved[0].sd_m, std::sqrt(0.25 - 0.01), 1e-9);
}

/// A landmark that is known to a centimetre must not move by half a metre, also where the covariance has not
/// shrunk.
TEST(LandmarkCheck, ALandmarkThatWasWellKnownMayNot) {
  LandmarkCheck check;
  check.note(1, map_of(1, {}, 1.0));
  check.note(2, map_of(1, {}, 0.01));  // neither new nor due
  EXPECT_TRUE(check.judge(map_of(1, {0.5, 0.0}, 0.01)).empty());
  check.note(21, map_of(1, {}, 0.01));
  const auto moved = check.judge(map_of(1, {0.5, 0.0}, 0.01));
  ASSERT_EQ(moved.size(), 1U);
  EXPECT_EQ(moved[0].step, 21U);
}

TEST(LandmarkCheck, ALandmarkThatIsNewTellsNothing) {
  LandmarkCheck check;
  EXPECT_TRUE(check.judge(map_of(1, {}, 0.1)).empty());
  check.note(1, map_of(1, {}, 0.1));
  EXPECT_TRUE(check.judge(map_of(2, {9.0, 9.0}, 0.1)).empty());
}

LandmarkSlamOptions without_ids() {
  LandmarkSlamOptions options;
  options.engine = "ekf";
  options.unknown_ids = true;
  options.patience_distance_m = 0.2;
  return options;
}

/// Maps a log without its ids, and returns how many landmarks were moved too far.
std::size_t moved_too_far(LandmarkLog log, std::size_t& landmarks) {
  LandmarkSlam slam = begun(without_ids(), log.start);
  LandmarkCheck check;
  for (std::size_t i = 0; i < log.steps.size(); ++i) {
    for (LandmarkSighting& s : log.steps[i].sightings) s.id.reset();
    EXPECT_TRUE(slam.advance(log.steps[i]));
    check.note(i, slam.landmarks());
  }
  landmarks = slam.landmarks().size();
  return check.judge(slam.landmarks()).size();
}

TEST(LandmarkCheck, TheMapsOfTheTagCoursesStand) {
  for (std::uint64_t seed = 1; seed <= static_cast<std::uint64_t>(testing::cases(5)); ++seed) {
    std::size_t landmarks = 0;
    EXPECT_EQ(moved_too_far(tag_run(seed, {4, 2}).log, landmarks), 0U);
    ASSERT_EQ(landmarks, 8U);
  }
}

/// Odometry is off by 40 degrees in one step, so tags enter the map again. That map is consistent in itself;
/// with the range of the sensor, the tags of the first lap are missed and removed.
TEST(LandmarkCheck, ADoubledMapNeedsTheRangeOfTheSensor) {
  for (std::uint64_t seed = 1; seed <= static_cast<std::uint64_t>(testing::cases(3)); ++seed) {
    TagRun run = tag_run(seed, {4, 2});
    for (LogStep& step : run.log.steps) {
      for (LandmarkSighting& s : step.sightings) s.id.reset();
    }
    run.log.steps[run.log.steps.size() / 2].odometry.heading_rad += 0.7;
    LandmarkSlamOptions options = without_ids();
    options.field_of_view_rad = radians(90.0);
    ASSERT_GT(after(options, run.log).landmarks().size(), 8U);
    options.sensor_range_m = 2.5;
    EXPECT_EQ(after(options, run.log).landmarks().size(), 8U);
  }
}

}  // namespace
}  // namespace outrider
