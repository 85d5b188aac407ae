#include "outrider/jobs/slam/laser_run.hpp"

#include <algorithm>

#include "outrider/slam/map_error.hpp"

namespace outrider {
namespace {

void compare(LaserRun& run, const std::vector<Pose2>& reference) {
  if (reference.empty()) return;
  std::vector<Vec2> onto, from;
  const std::vector<Pose2> poses = run.slam.trajectory();
  for (std::size_t i = 0; i < std::min(reference.size(), run.steps); ++i) {
    onto.push_back(poses[i + 1].position);
    from.push_back(reference[i].position);
  }
  const Pose2 motion = rigid_alignment(from, onto);
  double sum_m = 0.0;
  for (std::size_t i = 0; i < from.size(); ++i) {
    run.reference.push_back(motion * from[i]);
    sum_m += distance(run.reference.back(), onto[i]);
  }
  run.mean_error_m = sum_m / static_cast<double>(from.size());
  run.rms_error_m = rms_distance(from, onto, motion);
}

}  // namespace

Outcome<LaserRun> run_laser_log(const LaserLog& log, const LaserSlamOptions& options, const LaserWatch& watch,
                                const std::function<double()>& processor_s) {
  LaserSlamOptions used = options;
  if (used.trust_odometry) used.draw_late = false;  // nothing is matched that settle() would draw
  auto begun = LaserSlam::begin(used, {});
  if (!begun) return pass_on(begun);
  LaserRun run{std::move(*begun), 0, 0, 0, 0.0, 0.0, 0.0, {}, {}, {}};
  const auto timed = [&](const auto& work) {
    const double begin = processor_s();
    work();
    const double spent_s = processor_s() - begin;
    run.time_s += spent_s;
    run.max_step_s = std::max(run.max_step_s, spent_s);
  };
  for (std::size_t i = 0; i < log.steps.size() && !watch.stop.stop_requested(); ++i) {
    Outcome<LaserSlamStep> step;
    timed([&] { step = run.slam.advance(log.steps[i].motion, log.steps[i].scan); });
    if (!step) return pass_on(step);
    ++run.steps;
    run.matched += step->matched ? 1 : 0;
    run.lost += step->lost ? 1 : 0;
    if (watch.stepped) watch.stepped(run.slam, i, *step);
    if (watch.progress) watch.progress(static_cast<double>(i + 1) / static_cast<double>(log.steps.size()));
  }
  if (run.steps == 0) return fault(FaultCode::cancelled, "it was cancelled before the first scan");
  const double step_s = run.max_step_s;
  timed([&] { run.slam.settle(); });
  run.max_step_s = step_s;  // settling is no step
  run.log_s = std::max(0.0, log.steps[run.steps - 1].scan.time_s - log.steps.front().scan.time_s);
  compare(run, log.reference);
  return run;
}

}  // namespace outrider
