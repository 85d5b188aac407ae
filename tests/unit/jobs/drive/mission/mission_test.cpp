#include "outrider/jobs/drive/mission/mission.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "outrider/core/units.hpp"
#include "outrider/estimate/planar_pnp.hpp"
#include "outrider/sim/faults/drive_sim_params.hpp"

namespace outrider {
namespace {

DriveTask task_with(std::vector<Waypoint> waypoints) {
  DriveTask task;
  task.tags.tags = {upright_tag(1, {2, 0.3, 0.2}, pi), upright_tag(2, {2, -0.3, 0.2}, pi)};
  task.world.bounds = {{-5, -5}, {5, 5}};
  task.waypoints = std::move(waypoints);
  return task;
}

/// Returns what the camera sees without an error, of tags that are `scale` times as large as the robot
/// believes.
std::vector<TagSighting> seen_from_pose(const DriveTask& task, const Pose2& pose, double scale = 1.0) {
  const RobotCamera camera = robot_camera(task.eye);
  const Pose3 world_T_robot{{pose.position.x, pose.position.y, 0.0},
                            Rotation::from_rpy(0.0, 0.0, pose.heading_rad)};
  std::vector<TagSighting> sightings;
  for (const Tag& tag : task.tags.tags) {
    TagSighting sighting;
    sighting.id = tag.id;
    const auto corners = tag_corners(scale * tag.size_m);
    for (std::size_t i = 0; i < 4; ++i) {
      const Vec3 point = (world_T_robot * camera.robot_T_camera).to_local(tag.world_T_tag * corners[i]);
      sighting.corners_px[i] = *project(camera.camera, point);
    }
    sighting.poses = planar_pnp(camera.camera, tag.size_m, sighting.corners_px);
    sightings.push_back(std::move(sighting));
  }
  return sightings;
}

Observation at(double time_s) {
  Observation seen;
  seen.time_s = time_s;
  return seen;
}
Observation at(double time_s, double taken_s, const std::vector<TagSighting>& sightings) {
  Observation seen = at(time_s);
  seen.image = TagImage{taken_s, sightings};
  return seen;
}

/// The next command, where there is one.
std::optional<DriveWheels> step(DriveMission& mission, const Observation& seen) {
  const auto command = mission.step(seen);
  if (!command) return std::nullopt;
  return std::get<DriveWheels>(*command);
}

TEST(DriveMission, TheFirstAndTheLastCommandAreToRest) {
  for (const bool closed : {true, false}) {
    DriveTask task = task_with({{{{0, 0}, 0}}});
    task.closed_loop = closed;
    DriveMission mission = begin(task);
    std::vector<WheelSpeeds4> commands;
    double time_s = 0.0;
    while (const auto command = step(mission, at(time_s))) {
      EXPECT_GT(command->until_s, time_s);
      time_s = command->until_s;
      commands.push_back(command->wheels);
    }
    ASSERT_GE(commands.size(), 2U);
    EXPECT_EQ(commands.front(), WheelSpeeds4{});
    EXPECT_EQ(commands.back(), WheelSpeeds4{});
    EXPECT_EQ(mission.end, closed ? DriveEnd::unconfirmed : DriveEnd::done);
    ASSERT_EQ(mission.arrivals.size(), 1U);
    EXPECT_EQ(mission.arrivals[0].doubt, closed ? "no tag was of use there" : "");
    EXPECT_FALSE(step(mission, at(time_s)));
  }
}

TEST(DriveMission, ATagPoseIsUsedOnceAndOnlyWhileFresh) {
  const DriveTask task = task_with({{{{1, 0}, 0}}});
  const auto sightings = seen_from_pose(task, {{0.0, 0.0}, 0.0});
  DriveMission mission = begin(task);
  ASSERT_TRUE(step(mission, at(0.0)));
  ASSERT_TRUE(step(mission, at(0.05, 0.0249, sightings)));
  EXPECT_EQ(mission.used, 0) << "older than half a period";
  ASSERT_TRUE(step(mission, at(0.10, 0.0751, sightings)));
  EXPECT_EQ(mission.used, 1);
  EXPECT_EQ(mission.tag_s, 0.0751);
  ASSERT_TRUE(step(mission, at(0.11, 0.0751, sightings)));
  EXPECT_EQ(mission.used, 1) << "the same image again";
  EXPECT_EQ(mission.reckoning.time_s, 0.11) << "the model carries on";
}

TEST(DriveMission, LooksMakeTheBeliefSharper) {
  const DriveTask task = task_with({{{{0, 0}, 0}}});
  DriveMission mission = begin(task);
  mission.reckoning.belief.world_T_robot = {{0.02, -0.03}, 0.02};
  mission.reckoning.belief.covariance *= 25.0;
  const auto sightings = seen_from_pose(task, {});
  for (int i = 0; i < 10; ++i) (void)step(mission, at(0.1 * i, 0.1 * i, sightings));
  EXPECT_LT(norm(mission.arrivals.empty() ? mission.reckoning.belief.world_T_robot.position
                                          : mission.arrivals[0].belief.world_T_robot.position),
            0.01);
  EXPECT_LT(position_sigma_m(mission.reckoning.belief), 0.02);
}

/// Drives a mission whose robot never moves and sees what `sightings` says of each time. Returns its end.
template <class Sightings>
DriveEnd run_at_rest(DriveMission& mission, const Sightings& sightings) {
  double time_s = 0.0;
  while (const auto command = step(mission, at(time_s, time_s, sightings(time_s)))) time_s = command->until_s;
  return mission.end;
}

TEST(DriveMission, AStopIsReachedByEnoughImagesThatAgree) {
  DriveTask task = task_with({{{{0, 0}, 0}}});
  task.rules.settle_sightings = 5;
  DriveMission mission = begin(task);
  const auto here = seen_from_pose(task, {});
  EXPECT_EQ(run_at_rest(mission, [&](double) { return here; }), DriveEnd::done);
  ASSERT_EQ(mission.arrivals.size(), 1U);
  EXPECT_GE(mission.arrivals[0].time_s, task.rules.settle_s);

  task.rules.settle_sightings = 100;  // more than there are within most_settle
  mission = begin(task);
  EXPECT_EQ(
      run_at_rest(mission, [&](double time_s) { return time_s < 1.0 ? here : std::vector<TagSighting>{}; }),
      DriveEnd::unconfirmed);
  EXPECT_NE(mission.reason.find("waypoint 1"), std::string::npos) << mission.reason;
}

TEST(DriveMission, AnImageThatContradictsStartsTheCountAnew) {
  const DriveTask task = task_with({{{{0, 0}, 0}}});
  const auto here = seen_from_pose(task, {}), elsewhere = seen_from_pose(task, {{0.0, 0.2}, 0.0});
  DriveMission mission = begin(task);
  constexpr double nudged_s = 0.4;
  EXPECT_EQ(run_at_rest(mission,
                        [&](double time_s) { return std::abs(time_s - nudged_s) < 0.01 ? elsewhere : here; }),
            DriveEnd::done);
  EXPECT_GE(mission.arrivals.at(0).time_s, nudged_s + task.rules.settle_s - 0.01);
}

TEST(DriveMission, ARobotThatTwoTagsPutElsewhereIsRelocalised) {
  const DriveTask task = task_with({{{{0, 0}, 0}}});
  const Pose2 truth{{-0.5, 0.4}, 0.2};
  const auto sightings = seen_from_pose(task, truth);
  DriveMission mission = begin(task);
  double time_s = 0.0;
  while (mission.relocalisations.empty() && time_s < 5.0) {
    const auto command = step(mission, at(time_s, time_s, sightings));
    ASSERT_TRUE(command) << mission.reason;
    if (mission.refused >= task.rules.hold_refused) {
      EXPECT_EQ(command->wheels, WheelSpeeds4{});
    }
    time_s = command->until_s;
  }
  ASSERT_EQ(mission.relocalisations.size(), 1U);
  EXPECT_LT(distance(mission.relocalisations[0].belief.world_T_robot.position, truth.position), 0.01);
  EXPECT_TRUE(mission.support->corroborated);
}

TEST(DriveMission, OneTagAloneRelocalisesButConfirmsNoStop) {
  DriveTask task = task_with({{{{0, 0}, 0}}});
  task.tags.tags = {upright_tag(1, {2, 1.0, 0.2}, pi)};
  DriveTask moved = task;  // the tag hangs 0.3 m beside the place in the map, or the robot was moved
  moved.tags.tags[0].world_T_tag.position.y += 0.3;
  const auto sightings = seen_from_pose(moved, {});
  DriveMission mission = begin(task);
  mission.task.follow.within_m = 10.0;  // it stands wherever it is
  mission.task.follow.within_rad = 3.0;
  EXPECT_EQ(run_at_rest(mission, [&](double) { return sightings; }), DriveEnd::unconfirmed);
  ASSERT_FALSE(mission.relocalisations.empty());
  EXPECT_FALSE(mission.support->corroborated);
  EXPECT_NE(mission.reason.find("only tag 1"), std::string::npos) << mission.reason;
}

TEST(DriveMission, ATagThatContradictsTheOthersMakesTheDriveDoubtful) {
  DriveTask task = task_with({{{{0, 0}, 0}}});
  task.tags.tags.push_back(upright_tag(3, {2, 0.0, 0.2}, pi));
  task.rules.settle_s = 2.0;
  DriveTask moved = task;
  moved.tags.tags[2].world_T_tag.position.y += 0.15;
  const auto sightings = seen_from_pose(moved, {});
  DriveMission mission = begin(task);
  EXPECT_EQ(run_at_rest(mission, [&](double) { return sightings; }), DriveEnd::doubtful);
  EXPECT_TRUE(mission.arrivals.at(0).doubt.empty());
  EXPECT_NE(mission.reason.find("tag 3"), std::string::npos) << mission.reason;
}

/// With a tag on another wall, so that tags of a wrong size cannot agree.
DriveTask corner_task() {
  DriveTask task = task_with({{{{1, 0}, 0}}});
  task.tags.tags.push_back(upright_tag(3, {1.0, 1.2, 0.2}, -pi / 2.0));
  return task;
}

/// Drives until the robot is lost by images that it cannot have from where it believes to be, after `before`
/// images that agree. Returns the reason.
std::string reason_when_lost(const std::vector<TagSighting>& impossible, int before) {
  DriveTask task = corner_task();
  task.rules.most_refused = 30;
  task.rules.relocalise = 100;
  DriveMission mission = begin(task);
  double time_s = 0.0;
  WheelSpeeds4 last{};
  for (int i = 0; i < before + 100; ++i) {
    const Pose2 believed = mission.reckoning.belief.world_T_robot;
    const auto command =
        step(mission, at(time_s, time_s, i < before ? seen_from_pose(task, believed) : impossible));
    if (!command) break;
    last = command->wheels;
    time_s = command->until_s;
  }
  EXPECT_EQ(mission.end, DriveEnd::lost);
  EXPECT_EQ(mission.refused, 30);
  EXPECT_EQ(mission.used > 0, before > 0);
  EXPECT_EQ(last, WheelSpeeds4{});
  return mission.reason;
}

TEST(DriveMission, ALostRobotNamesTheCausesThatItsImagesSupport) {
  const DriveTask task = corner_task();
  const auto elsewhere = seen_from_pose(task, {{-0.5, 0.4}, 0.2});
  const auto larger = seen_from_pose(task, {}, 1.5);
  const std::vector<TagSighting> one_larger(larger.begin(), larger.begin() + 1);
  const std::string moved = reason_when_lost(elsewhere, 4), start = reason_when_lost(elsewhere, 0);
  const std::string size = reason_when_lost(larger, 0), late = reason_when_lost(larger, 4);
  EXPECT_NE(moved.find(" images before agreed: was the robot moved, or a tag?"), std::string::npos) << moved;
  EXPECT_NE(start.find("no image ever agreed with the start: are the start, "), std::string::npos) << start;
  for (const std::string& reason : {size, late})
    EXPECT_NE(reason.find("contradict one another or the floor: are their places, tag_size "),
              std::string::npos)
        << reason;
  for (const std::string& reason : {start, size, late})
    EXPECT_EQ(reason.find("was the robot moved"), std::string::npos) << reason;
  EXPECT_NE(reason_when_lost(one_larger, 0).find("tag_size"), std::string::npos) << "of one tag too";
}

TEST(DriveMission, GivesUpWhenItsPatienceEnds) {
  DriveTask task = task_with({{{{50, 0}, 0}}});
  task.rules.patience_s = 2.0;
  task.reckoning.lost_m = 100.0;
  task.reckoning.lost_rad = pi;
  DriveMission mission = begin(task);
  double time_s = 0.0;
  while (const auto command = step(mission, at(time_s))) time_s = command->until_s;
  EXPECT_EQ(mission.end, DriveEnd::stuck);
  EXPECT_NE(mission.reason.find("waypoint 1"), std::string::npos);
}

TEST(DriveTask, DefaultsLieInTheirRanges) {
  DriveTask task;
  DriveSimParams params;
  for (const auto& options : {describe(task.eye), describe(task.rules), describe(params),
                              describe(task.follow), describe(task.pid), describe(task.reckoning)}) {
    for (const Option& option : options) {
      EXPECT_TRUE(assign(option, value_text(option))) << option.name;
      EXPECT_FALSE(option.sentence.empty()) << option.name;
    }
  }
}

}  // namespace
}  // namespace outrider
