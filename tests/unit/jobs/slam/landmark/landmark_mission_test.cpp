#include "outrider/jobs/slam/landmark/landmark_mission.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "outrider/robot/recorded_robot.hpp"

namespace outrider {
namespace {

/// A robot that drives straight past three landmarks.
std::vector<LogStep> street() {
  std::vector<LogStep> steps;
  for (int i = 1; i <= 12; ++i) {
    LogStep step;
    step.time_s = 0.5 * i;
    step.odometry = {{0.25, 0.0}, 0.0};
    step.covariance.diagonal() << 1e-4, 1e-4, 1e-5;
    for (std::int64_t id = 0; id < 3; ++id) {
      const Vec2 ahead{1.0 + static_cast<double>(id) - 0.25 * i, id % 2 == 0 ? 0.8 : -0.6};
      step.sightings.push_back({id, ahead, 1e-4 * Eigen::Matrix2d::Identity()});
    }
    steps.push_back(std::move(step));
  }
  return steps;
}

RecordedRobot replay_of(const std::vector<LogStep>& steps) {
  std::vector<Observation> records;
  for (const LogStep& step : steps) {
    Observation record;
    record.time_s = step.time_s;
    record.landmarks = step;
    records.push_back(std::move(record));
  }
  return RecordedRobot(std::move(records));
}

TEST(LandmarkMission, MapsARecordingAsTheEngineByItself) {
  const auto steps = street();
  LandmarkSlam alone = LandmarkSlam::begin({}, {}).value();
  for (const LogStep& step : steps) ASSERT_TRUE(alone.advance(step));
  LandmarkMission mission(LandmarkSlam::begin({}, {}).value());
  RecordedRobot robot = replay_of(steps);
  int waits = 0;
  EXPECT_TRUE(run_mission(mission, robot, {}, [&](const Observation&, const Command* command) {
    if (command == nullptr) return;
    EXPECT_TRUE(std::holds_alternative<Wait>(*command)) << "a mission that listens commands nothing";
    ++waits;
  }));
  EXPECT_EQ(waits, 12);
  EXPECT_EQ(mission.times_s.size(), steps.size());
  EXPECT_EQ(mission.odometry.size(), steps.size() + 1);
  EXPECT_NEAR(mission.odometry.back().position.x, 3.0, 1e-12);
  EXPECT_FALSE(mission.fault);
  EXPECT_EQ(mission.slam.state(), alone.state());
  EXPECT_EQ(mission.slam.landmarks().size(), 3U);
}

TEST(LandmarkMission, EndsWithTheFaultOfAStep) {
  auto steps = street();
  steps[4].odometry.position.x = std::nan("");
  LandmarkMission mission(LandmarkSlam::begin({}, {}).value());
  RecordedRobot robot = replay_of(steps);
  EXPECT_TRUE(run_mission(mission, robot, {}, [](const Observation&, const Command*) {}));
  ASSERT_TRUE(mission.fault);
  EXPECT_EQ(mission.times_s.size(), 5U);
  EXPECT_FALSE(mission.newest);
}

TEST(LandmarkMission, IsStoppedBetweenTwoSteps) {
  std::stop_source stop;
  LandmarkMission mission(LandmarkSlam::begin({}, {}).value());
  RecordedRobot robot = replay_of(street());
  EXPECT_FALSE(run_mission(mission, robot, stop.get_token(), [&](const Observation&, const Command*) {
    if (mission.times_s.size() == 7) stop.request_stop();
  }));
  EXPECT_EQ(mission.times_s.size(), 7U);
}

}  // namespace
}  // namespace outrider
