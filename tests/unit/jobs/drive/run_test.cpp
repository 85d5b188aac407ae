#include "outrider/jobs/drive/run.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "outrider/core/units.hpp"
#include "outrider/report/json.hpp"
#include "support/costly_cases.hpp"
#include "support/curious.hpp"
#include "support/paged.hpp"
#include "support/random_cases.hpp"

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
  DriveSimParams params;
  params.wheels.gains = {0.985, 1.012, 1.003, 0.989};
  params.wheels.backwards = 0.985;
  params.wheels.dead_time_s = 0.08;
  params.wheels.lag_s = 0.08;
  params.wheels.deadband_radps = 0.05;
  params.wheels.sag_per_min = 0.006;
  params.wheels.strafe_slip = 0.1;
  params.wheels.noise = 0.005;
  params.link = {1, 0.05, 0.01};
  return params;
}

struct Worst {
  double position_m = 0.0;
  double heading_rad = 0.0;
};
Worst worst_of(const PageReport& report) {
  Worst worst;
  for (const ReportStop& stop : report.drive->stops) {
    worst.position_m = std::max({worst.position_m, std::abs(stop.error.x), std::abs(stop.error.y)});
    worst.heading_rad = std::max(worst.heading_rad, std::abs(stop.heading_error_rad));
  }
  return worst;
}

PageReport driven(const DriveTask& task, const DriveSimParams& params, bool rendered, std::uint64_t seed,
                  const RunWatch& watch = {}) {
  const auto run = testing::paged(watch, [&](Log& log) -> Outcome<Report> {
    return run_drive(task, params, rendered, seed, log, watch);
  });
  return run.value();
}

void expect_arrives(const DriveTask& task, std::uint64_t seed, double most_ratio) {
  const PageReport report = driven(task, faults(), false, seed);
  ASSERT_EQ(report.status, "done") << report.reason;
  EXPECT_LE(worst_of(report).position_m, 0.03) << seed;
  EXPECT_LE(worst_of(report).heading_rad, 0.03) << seed;
  EXPECT_LE(metric(report, "driven_m"), most_ratio * metric(report, "ideal_m")) << seed;
}

TEST(DriveRun, ClosedLoopArrivesWithinThreeCentimetres) {
  for (int seed = 1; seed <= testing::costly_cases(10); ++seed) {
    expect_arrives(waypoints(), static_cast<std::uint64_t>(seed), 1.05);
  }
}

TEST(DriveRun, EveryChassisFollowerAndManner) {
  for (const char* follower : {"pid", "pure_pursuit"}) {
    DriveTask task = waypoints();
    task.follow.follower = follower;
    expect_arrives(task, 1, 1.05);
    task.chassis = holonomic_chassis(0.03, 0.15);
    expect_arrives(task, 2, 1.05);
    task.follow.mode = "rotate_then_go";
    expect_arrives(task, 3, 1.15);
    task.chassis = differential_chassis(0.03, 0.15);
    expect_arrives(task, 4, 1.15);
  }
}

TEST(DriveRun, RenderedImagesSayTheSame) {
  DriveTask task = waypoints();
  task.waypoints = {{{{0.5, 0}, 0}}, {{{0.5, 0.5}, pi / 4}}};
  task.eye.rate_hz = 5.0;
  const PageReport report = driven(task, faults(), true, 1);
  ASSERT_EQ(report.status, "done") << report.reason;
  EXPECT_LE(worst_of(report).position_m, 0.03);
  EXPECT_LE(worst_of(report).heading_rad, 0.03);
  EXPECT_GT(metric(report, "tag_fraction"), 0.5);
  ASSERT_TRUE(report.drive->camera);
  EXPECT_EQ(report.drive->camera->fx, task.eye.camera.fx);
  EXPECT_EQ(report.drive->tags.front().height_m, task.tags.tags.front().world_T_tag.position.z);
}

TEST(DriveRun, CalibrationTakesTwoThirdsOfTheErrorOfTheOpenLoop) {
  DriveTask raw = waypoints();
  raw.closed_loop = false;
  DriveTask calibrated = raw;
  const auto fit = calibrate(raw.chassis, record_runs(raw, faults(), 5, 0.002, radians(0.3), 1));
  ASSERT_TRUE(fit);
  calibrated.calibration = fit->calibration;
  for (int seed = 1; seed <= testing::cases(20); ++seed) {
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
  const PageReport report = driven(waypoints(), params, false, 1);
  EXPECT_EQ(report.status, "not_done");
  EXPECT_NE(report.reason.find("lost: the belief"), std::string::npos) << report.reason;
  const Pose2 last = report.track.back().pose, before = report.track[report.track.size() - 2].pose;
  EXPECT_LT(distance(last.position, before.position), 0.1);
  EXPECT_TRUE(std::isnan(report.drive->stops.back().time_s));
}

TEST(DriveRun, AKidnappedRobotStopsAndSaysSo) {
  for (int seed = 1; seed <= testing::cases(5); ++seed) {
    DriveSimParams params = faults();
    params.kidnapping.at_s = 6.0;
    const PageReport report = driven(waypoints(), params, false, static_cast<std::uint64_t>(seed));
    EXPECT_EQ(report.status, "not_done");
    EXPECT_NE(report.reason.find("lost"), std::string::npos) << report.reason;
    EXPECT_EQ(report.events.back().kind, "lost");
  }
}

TEST(DriveRun, SameSeedSameBytes) {
  const PageReport report = driven(waypoints(), faults(), false, 7);
  const std::string once = to_json(report);
  testing::Curious curious;
  EXPECT_EQ(once, to_json(driven(waypoints(), faults(), false, 7, {.sinks = {&curious}})));
  curious.expect_to_have_seen(report);
  EXPECT_NE(once, to_json(driven(waypoints(), faults(), false, 8)));
  const auto read = report_from_json(once);
  ASSERT_TRUE(read);
  EXPECT_EQ(to_json(*read), once);
}

}  // namespace
}  // namespace outrider
