#include "outrider/jobs/slam/laser/laser_run.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "outrider/jobs/slam/scenario.hpp"

namespace outrider {
namespace {

/// A robot that drives 2 m along the middle of a room of 8 m by 4 m, whose walls a laser of 180 beams ranges
/// exactly; the odometry is exact too.
LaserLog exact_log() {
  constexpr double pi = 3.141592653589793;
  LaserLog log;
  for (int i = 0; i <= 20; ++i) {
    const double x = 2.0 + 0.1 * i;
    LaserScan scan{0.5 * i, -pi / 2.0, pi / 180.0, 0.0, 20.0, {}};
    for (int beam = 0; beam < 180; ++beam) {
      const double bearing = scan.first_rad + beam * scan.step_rad;
      const double ahead = std::cos(bearing) > 1e-9 ? (8.0 - x) / std::cos(bearing) : 1e9;
      const double aside = std::abs(std::sin(bearing)) > 1e-9 ? 2.0 / std::abs(std::sin(bearing)) : 1e9;
      scan.ranges_m.push_back(static_cast<float>(std::min(ahead, aside)));
    }
    log.steps.push_back({Pose2{{i == 0 ? 0.0 : 0.1, 0.0}, 0.0}, scan});
    log.reference.push_back(Pose2{{5.0, 0.1 * i}, 0.5 * pi});  // the same drive in another frame
  }
  return log;
}

TEST(LaserRun, TimesAreThoseOfTheClockGiven) {
  const LaserLog log = exact_log();
  double ticks = 0.0;
  std::size_t stepped = 0;
  LaserWatch watch;
  watch.stepped = [&](const LaserSlam&, std::size_t step, const Observation&, const LaserSlamStep&) {
    EXPECT_EQ(step, stepped++);
    ticks += 1000.0;  // what the watch does does not count
  };
  const auto run = run_laser_log(log, laser_options_for_logs(), watch, [&] { return ticks += 1.0; });
  ASSERT_TRUE(run.has_value()) << run.error().sentence;
  EXPECT_EQ(stepped, log.steps.size());
  EXPECT_EQ(run->time_s, static_cast<double>(log.steps.size()) + 1.0);  // each step, and settling
  EXPECT_EQ(run->max_step_s, 1.0);
  EXPECT_DOUBLE_EQ(run->log_s.value(), 10.0);
}

TEST(LaserRun, TheReferenceIsLaidOverTheTrack) {
  LaserLog log = exact_log();
  const auto run = run_laser_log(log, laser_options_for_logs(), {}, [] { return 0.0; });
  ASSERT_TRUE(run.has_value()) << run.error().sentence;
  ASSERT_EQ(run->reference.size(), log.steps.size());
  EXPECT_LT(*run->mean_error_m, 0.02);
  EXPECT_LE(*run->mean_error_m, *run->rms_error_m);
  const std::vector<Pose2> track = run->slam.trajectory();
  for (std::size_t i = 0; i < run->reference.size(); ++i) {
    EXPECT_NEAR(distance(run->reference[i], track[i + 1].position), 0.0, 0.05) << i;
  }
  log.reference.clear();
  const auto without = run_laser_log(log, laser_options_for_logs(), {}, [] { return 0.0; });
  ASSERT_TRUE(without.has_value());
  EXPECT_FALSE(without->mean_error_m.has_value());
}

}  // namespace
}  // namespace outrider
