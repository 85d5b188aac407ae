#include "outrider/jobs/drive/run.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "outrider/core/units.hpp"
#include "outrider/log/messages/motion_messages.hpp"
#include "outrider/log/messages/ros_sensor_messages.hpp"
#include "support/costly_cases.hpp"
#include "support/drive_faults.hpp"
#include "support/logged_run.hpp"
#include "support/random_cases.hpp"
#include "support/run_bytes.hpp"

namespace outrider {
namespace {

DriveTask waypoints() {
  DriveTask task;
  task.world.name = "open ground";
  task.world.bounds = {{-3, -3}, {5, 5}};
  task.tags.tags = {upright_tag(1, {2, 1, 0.2}, pi), upright_tag(2, {1, 2.5, 0.2}, -pi / 2),
                    upright_tag(3, {0, 2, 0.2}, 0)};
  task.waypoints = {{{{0, 0}, 0}}, {{{1, 0}, 0}}, {{{1, 2}, pi}}, {{{0, 0}, 0}}};
  return task;
}

DriveSimParams faults() {
  DriveSimParams params = testing::usual_faults();
  params.wheels.backwards = 0.985;
  params.wheels.deadband_radps = 0.05;
  params.wheels.sag_per_min = 0.006;
  return params;
}

struct Worst {
  double position_m = 0.0;
  double heading_rad = 0.0;
};
Worst worst_of(const Run& run) {
  Worst worst;
  for (const auto& one : run.log.latest<outrider_msgs::Waypoints>(topic::waypoints)->waypoints) {
    if (std::isnan(one.reached)) continue;
    worst.position_m = std::max({worst.position_m, std::abs(one.error.x), std::abs(one.error.y)});
    worst.heading_rad = std::max(worst.heading_rad, std::abs(one.heading_error));
  }
  return worst;
}

Run driven(const DriveTask& task, const DriveSimParams& params, bool rendered, std::uint64_t seed,
           const RunWatch& watch = {}) {
  auto run = testing::logged_run(watch, [&](Log& log) -> Outcome<Report> {
    return run_drive(task, params, rendered, seed, log, watch);
  });
  return std::move(run.value());
}

void expect_arrives(const DriveTask& task, std::uint64_t seed, double most_ratio) {
  const auto run = driven(task, faults(), false, seed);
  ASSERT_EQ(run.report.status, "done") << run.report.reason;
  EXPECT_LE(worst_of(run).position_m, 0.03) << seed;
  EXPECT_LE(worst_of(run).heading_rad, 0.03) << seed;
  EXPECT_LE(metric(run, "driven_m"), most_ratio * metric(run, "ideal_m")) << seed;
}

TEST(DriveRun, ClosedLoopArrivesWithinThreeCentimetres) {
  for (int seed = 1; seed <= testing::costly_cases(4); ++seed) {
    expect_arrives(waypoints(), static_cast<std::uint64_t>(seed), 1.05);
  }
}

TEST(DriveRun, EveryChassisFollowerAndManner) {
  for (const char* follower : {"pid", "pure_pursuit", "time_optimal"}) {
    DriveTask task = waypoints();
    task.follow.follower = follower;
    expect_arrives(task, 1, 1.05);
    task.chassis = holonomic_chassis(0.03, 0.15);
    expect_arrives(task, 2, 1.05);
    task.follow.mode = "rotate_then_go";
    expect_arrives(task, 3, 1.15);
    task.chassis = differential_chassis(0.03, 0.15);
    // The others see no tag on the last leg, but are slow enough for their beliefs to stay within the limits.
    if (task.follow.follower == "time_optimal")
      task.tags.tags.push_back(upright_tag(4, {-1, -1.5, 0.2}, radians(60.0)));
    expect_arrives(task, 4, 1.15);
  }
}

TEST(DriveRun, TheTimeOptimalFollowerComesNearTheIdealTime) {
  DriveTask task = waypoints();
  task.rules.tags_move = false;  // the ideal time has no looking round
  const double pid_s = metric(driven(task, faults(), false, 1), "time_s");
  task.follow.follower = "time_optimal";
  const auto run = driven(task, faults(), false, 1);
  EXPECT_EQ(run.report.status, "done") << run.report.reason;
  EXPECT_LE(metric(run, "time_s"), 1.15 * metric(run, "ideal_s"));
  EXPECT_GE(metric(run, "time_s"), metric(run, "ideal_s"));
  EXPECT_LE(metric(run, "time_s"), 0.75 * pid_s);
}

TEST(DriveRun, RenderedImagesSayTheSame) {
  DriveTask task = waypoints();
  task.waypoints = {{{{0.5, 0}, 0}}, {{{0.5, 0.5}, pi / 4}}};
  task.eye.rate_hz = 5.0;
  const auto run = driven(task, faults(), true, 1);
  ASSERT_EQ(run.report.status, "done") << run.report.reason;
  EXPECT_LE(worst_of(run).position_m, 0.03);
  EXPECT_LE(worst_of(run).heading_rad, 0.03);
  EXPECT_GT(metric(run, "tag_fraction"), 0.5);
  const auto* camera = run.log.latest<sensor_msgs::CameraInfo>(topic::camera);
  ASSERT_NE(camera, nullptr);
  EXPECT_EQ(camera->k[0], task.eye.camera.fx);
  EXPECT_EQ(run.log.latest<outrider_msgs::Tags>(topic::tags)->tags.front().position.z,
            task.tags.tags.front().world_T_tag.position.z);
}

TEST(DriveRun, CalibrationTakesTwoThirdsOfTheErrorOfTheOpenLoop) {
  DriveTask raw = waypoints();
  raw.closed_loop = false;
  DriveTask calibrated = raw;
  const auto fit = calibrate(raw.chassis, record_runs(raw, faults(), 5, 0.002, radians(0.3), 1));
  ASSERT_TRUE(fit);
  calibrated.calibration = fit->calibration;
  for (int seed = 1; seed <= testing::cases(8); ++seed) {
    const auto number = static_cast<std::uint64_t>(seed);
    const Worst before = worst_of(driven(raw, faults(), false, number));
    const Worst after = worst_of(driven(calibrated, faults(), false, number));
    EXPECT_GT(before.position_m, 0.1);
    EXPECT_LE(before.position_m, 0.3048);
    EXPECT_LE(before.heading_rad, radians(30.0));
    EXPECT_LE(after.position_m, before.position_m / 3.0);
    EXPECT_LE(after.heading_rad, before.heading_rad / 3.0);
  }
}

TEST(DriveRun, ABlindedRobotStopsAndSaysSo) {
  DriveSimParams params = faults();
  params.sight.blind_from_s = 8.0;
  const auto run = driven(waypoints(), params, false, 1);
  EXPECT_EQ(run.report.status, "not_done");
  EXPECT_NE(run.report.reason.find("lost: the belief"), std::string::npos) << run.report.reason;
  const auto poses = poses_of(run.log);
  const Pose2 last = poses.back(), before = poses[poses.size() - 2];
  EXPECT_LT(distance(last.position, before.position), 0.1);
  EXPECT_TRUE(
      std::isnan(run.log.latest<outrider_msgs::Waypoints>(topic::waypoints)->waypoints.back().reached));
}

TEST(DriveRun, AKidnappedRobotFindsItselfByTheTagsInSight) {
  for (int seed = 1; seed <= testing::cases(5); ++seed) {
    DriveSimParams params = faults();
    params.kidnapping.at_s = 6.0;
    const auto run = driven(waypoints(), params, false, static_cast<std::uint64_t>(seed));
    EXPECT_GT(metric(run, "belief_error_m"), 0.7) << "it was kidnapped";
    EXPECT_EQ(run.report.status, "done") << run.report.reason;
    EXPECT_LE(worst_of(run).position_m, metric(run, "tolerance_m"));
    EXPECT_TRUE(std::ranges::any_of(events_of(run.log),
                                    [](const auto& event) { return event.message.name == "relocalised"; }));
  }
}

TEST(DriveRun, AKidnappedRobotThatSeesNoTagsSaysSo) {
  DriveSimParams params = faults();
  params.kidnapping = {6.0, 0.8, pi};
  const auto run = driven(waypoints(), params, false, 1);
  EXPECT_EQ(run.report.status, "not_done");
  EXPECT_NE(run.report.reason.find("lost"), std::string::npos) << run.report.reason;
  const auto lost = events_of(run.log).back();
  EXPECT_EQ(lost.message.name, "lost");
  EXPECT_GE(metric(run, "time_s"), 1e-9 * static_cast<double>(nanoseconds_of(lost.message.stamp)) - 1e-6)
      << "until it was lost, not until its last stop";
}

TEST(DriveRun, SameSeedSameBytes) {
  auto run = driven(waypoints(), faults(), false, 7);
  const std::string once = test::bytes_of_run(run);
  test::LogRecorder recorder;
  EXPECT_EQ(once, test::bytes_of_run(driven(waypoints(), faults(), false, 7, {.sinks = {&recorder}})));
  EXPECT_EQ(recorder.finish(), test::bytes_of_log(run.log));
  auto other = driven(waypoints(), faults(), false, 8);
  EXPECT_NE(once, test::bytes_of_run(other));
  EXPECT_NE(poses_of(run.log), poses_of(other.log));
}

}  // namespace
}  // namespace outrider
