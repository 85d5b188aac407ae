#include "laser_run.hpp"

#include <algorithm>

#include "clocks.hpp"
#include "outrider/slam/map_error.hpp"

namespace outrider::cli {
namespace {

void compare(LaserRun& run, const std::vector<Pose2>& reference) {
  if (reference.empty()) return;
  std::vector<Vec2> track, truth;
  const std::vector<Pose2> poses = run.slam.trajectory();
  for (std::size_t i = 0; i < reference.size(); ++i) {
    track.push_back(poses[i + 1].position);
    truth.push_back(reference[i].position);
  }
  const Pose2 motion = rigid_alignment(truth, track);
  double sum_m = 0.0;
  for (std::size_t i = 0; i < truth.size(); ++i) {
    run.reference.push_back(motion.position + rotated(motion.heading_rad, truth[i]));
    sum_m += distance(run.reference.back(), track[i]);
  }
  run.mean_error_m = sum_m / static_cast<double>(truth.size());
  run.rms_error_m = rms_distance(truth, track, motion);
}

}  // namespace

Outcome<LaserRun> run_laser_log(const LaserLog& log, const LaserSlamOptions& options,
                                const LaserWatch& watch) {
  LaserSlamOptions used = options;
  if (used.trust_odometry) used.draw_late = false;  // nothing is matched that settle() would draw
  auto begun = LaserSlam::begin(used, {});
  if (!begun) return pass_on(begun);
  LaserRun run{std::move(*begun), 0, 0, 0.0, 0.0, 0.0, {}, {}, {}};
  const auto timed = [&](const auto& work) {
    const double begin = processor_s();
    work();
    const double spent_s = processor_s() - begin;
    run.time_s += spent_s;
    run.max_step_s = std::max(run.max_step_s, spent_s);
  };
  for (std::size_t i = 0; i < log.steps.size(); ++i) {
    Outcome<LaserSlamStep> step;
    timed([&] { step = run.slam.advance(log.steps[i].motion, log.steps[i].scan); });
    if (!step) return pass_on(step);
    run.matched += step->matched ? 1 : 0;
    run.lost += step->lost ? 1 : 0;
    if (watch.stepped) watch.stepped(run.slam, i, *step);
    if (watch.progress) watch.progress(static_cast<double>(i + 1) / static_cast<double>(log.steps.size()));
  }
  const double step_s = run.max_step_s;
  timed([&] { run.slam.settle(); });
  run.max_step_s = step_s;  // settling is no step
  run.log_s = std::max(0.0, log.steps.back().scan.time_s - log.steps.front().scan.time_s);
  compare(run, log.reference);
  return run;
}

}  // namespace outrider::cli
