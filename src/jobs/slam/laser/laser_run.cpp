#include "outrider/jobs/slam/laser/laser_run.hpp"

#include <algorithm>

#include "laser/laser_records.hpp"
#include "laser/track.hpp"
#include "outrider/jobs/slam/laser/laser_mission.hpp"
#include "outrider/jobs/slam/recording_clock.hpp"
#include "outrider/robot/recorded_robot.hpp"

namespace outrider {
namespace {

void compare(LaserRun& run, const std::vector<Pose2>& reference) {
  std::vector<Vec2> path, known;
  const std::vector<Pose2> poses = run.slam.trajectory();
  for (std::size_t i = 0; i < std::min(reference.size(), run.steps); ++i) {
    path.push_back(poses[i + 1].position);
    known.push_back(reference[i].position);
  }
  PathError error = path_error(path, known);
  run.reference = std::move(error.reference);
  run.mean_error_m = error.mean_m;
  run.rms_error_m = error.rms_m;
}

/// The mission, with the times of its steps.
struct TimedMission {
  std::optional<Command> step(const Observation& seen) {
    const double begin_s = processor_s();
    auto command = mission.step(seen);
    if (!command) return command;
    const double spent_s = processor_s() - begin_s;
    time_s += spent_s;
    max_step_s = std::max(max_step_s, spent_s);
    return command;
  }

  LaserMission mission;
  const std::function<double()>& processor_s;
  double time_s = 0.0;
  double max_step_s = 0.0;
};

}  // namespace

Outcome<LaserRun> run_laser_log(LaserSource& source, const LaserSlamOptions& options, const LaserWatch& watch,
                                const std::function<double()>& processor_s) {
  if (watch.stop.stop_requested())
    return fault(FaultCode::cancelled, "it was cancelled before the first scan");
  LaserSlamOptions used = options;
  if (used.trust_odometry) used.draw_late = false;  // nothing is matched that settle() would draw
  auto begun = LaserSlam::begin(used, {});
  if (!begun) return pass_on(begun);
  LaserRecords records(source);
  RecordedRobot robot([&] { return records.next(); });
  TimedMission timed{LaserMission(std::move(*begun)), processor_s};
  LaserMission& mission = timed.mission;
  RecordingClock clock;
  const bool ended =
      run_mission(timed, robot, watch.stop, [&](const Observation& seen, const Command* command) {
        if (command == nullptr) return;
        clock.note(seen.time_s);
        if (watch.stepped) watch.stepped(mission.slam, mission.scans - 1, seen, *mission.newest);
        if (watch.progress) watch.progress(source.progress());
      });
  if (records.fault()) return tl::unexpected<Fault>(*records.fault());
  if (mission.fault) return tl::unexpected<Fault>(std::move(*mission.fault));
  if (mission.scans == 0) return bad_input("the log has no scan");
  const double begin_s = processor_s();
  mission.slam.settle();
  timed.time_s += processor_s() - begin_s;
  return LaserRun{.slam = std::move(mission.slam),
                  .steps = mission.scans,
                  .stopped = !ended,
                  .trusts_odometry = options.trust_odometry,
                  .matched = mission.matched,
                  .lost = mission.lost,
                  .repeated = mission.repeated,
                  .time_s = timed.time_s,
                  .max_step_s = timed.max_step_s,
                  .log_s = clock.length_s(),
                  .mean_error_m = {},
                  .rms_error_m = {},
                  .reference = {}};
}

Outcome<LaserRun> run_laser_log(const LaserLog& log, const LaserSlamOptions& options, const LaserWatch& watch,
                                const std::function<double()>& processor_s) {
  LoadedLaserSource source(log);
  auto run = run_laser_log(source, options, watch, processor_s);
  if (!run) return run;
  run->stopped = run->steps < log.steps.size();
  compare(*run, log.reference);
  return run;
}

}  // namespace outrider
