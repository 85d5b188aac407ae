
#include <fmt/format.h>

#include <algorithm>
#include <iterator>

#include "outrider/io/map_server.hpp"
#include "outrider/job/clock.hpp"
#include "outrider/job/sensor_log.hpp"
#include "outrider/jobs/slam/laser_run.hpp"
#include "outrider/log/append.hpp"
#include "outrider/log/conversions.hpp"
#include "outrider/log/topics.hpp"
#include "outrider/world/known_extent.hpp"
#include "recordings.hpp"
#include "scan_map.hpp"
#include "slam_log.hpp"

namespace outrider {
namespace {

/// Returns one line per scan: number, time (s), x, y (m), heading (rad).
std::string track_csv(const LaserLog& log, const std::vector<Pose2>& poses) {
  std::string text = "step,time,x,y,heading\n";
  for (std::size_t i = 0; i + 1 < poses.size(); ++i) {
    const Pose2& pose = poses[i + 1];
    fmt::format_to(std::back_inserter(text), "{},{},{},{},{}\n", i, log.steps[i].scan.time_s, pose.position.x,
                   pose.position.y, pose.heading_rad);
  }
  return text;
}

std::vector<double> times_of(const LaserLog& log) {
  std::vector<double> recorded_s;
  for (const LaserLogStep& step : log.steps) recorded_s.push_back(step.scan.time_s);
  return run_times(recorded_s);
}

/// Returns the smallest part of a map that contains all known cells; one cell if there are none.
Grid<std::uint8_t> known_part(const Grid<std::uint8_t>& occupancy) {
  const GridFrame& frame = occupancy.frame;
  const CellExtent known = known_extent(occupancy);
  Grid<std::uint8_t> part;
  part.frame = {frame.corner(known.low), frame.resolution_m, std::max(1, known.width()),
                std::max(1, known.height())};
  part.cells = moved_cells(occupancy.cells, frame, part.frame, {-known.low.x, -known.low.y},
                           static_cast<std::uint8_t>(unknown_cell));
  return part;
}

/// Logs the mapping.
class Recorder {
 public:
  Recorder(Log& log, const SlamScenario& scenario, const LaserLog& recording)
      : recording_(recording),
        options_(scenario.laser),
        log_(log, scenario, "laser"),
        times_s_(times_of(recording)),
        map_(options_.map, options_.robot_T_laser) {
    log_mount(log, "laser", options_.robot_T_laser, 0.0);
  }

  void note(const LaserSlam& slam, std::size_t step, const LaserSlamStep& outcome) {
    const LaserLogStep& logged = recording_.steps[step];
    const double time_s = times_s_[step];
    odometry_ = compose(odometry_, logged.motion);
    log_.note({time_s, outcome.pose, slam.pose_covariance(), odometry_, outcome.closed_loop});
    log_scan(log_.log(), time_s, logged.scan);
    if (outcome.kept || options_.trust_odometry)
      map_.add(log_.log(), outcome.pose, logged.scan, time_s, step + 1);
    if (outcome.lost) log_event(log_.log(), time_s, "lost", "odometry is off by too much to match the scan");
    if (outcome.closed_loop) log_loops(slam, slam.trajectory());
  }

  /// Logs the final map and path, and returns the length of the path.
  double settle(const LaserRun& run) {
    std::vector<Pose2> poses = run.slam.trajectory();
    log_loops(run.slam, poses);
    map_.finish(log_.log(), poses, log_.end_s());
    poses.erase(poses.begin());  // before the first scan
    const Grid<std::uint8_t> map = known_part(map_.map().occupancy());
    return log_.settle(poses, run.reference, map.cells.empty() ? Box2{} : map.frame.bounds());
  }

  [[nodiscard]] double end_s() const { return log_.end_s(); }

 private:
  void log_loops(const LaserSlam& slam, const std::vector<Pose2>& poses) {
    outrider_msgs::Loops loops;
    for (const LaserLoop& loop : slam.closed_loops()) {
      const double then_s = times_s_[loop.from - 1], time_s = times_s_[loop.to - 1];
      loops.loops.push_back({time_s, point_of(poses[loop.from].position), point_of(poses[loop.to].position)});
      if (loops.loops.size() <= told_) continue;
      ++told_;
      log_event(log_.log(), time_s, "loop", fmt::format("the place of {:.1f} s is recognised", then_s));
    }
    if (!loops.loops.empty()) log_.log().append(topic::loops, log_.end_s(), std::move(loops));
  }

  const LaserLog& recording_;
  const LaserSlamOptions& options_;
  SlamLog log_;
  std::vector<double> times_s_;
  ScanMap map_;
  Pose2 odometry_;
  std::size_t told_ = 0;  ///< number of loops that are logged as events
};

double free_m2(const OccupancyMap& map) {
  const double cell_m = map.frame().resolution_m;
  return cell_m * cell_m * static_cast<double>(std::ranges::count(map.occupancy().cells, free_cell));
}

Metrics metrics_of(const LaserRun& run) {
  const auto number = [](auto value) { return static_cast<double>(value); };
  return {{"mean_absolute_error_m", known(run.mean_error_m)},
          {"ate_m", known(run.rms_error_m)},
          {"steps", number(run.steps)},
          {"steps_matched", number(run.matched)},
          {"steps_lost", number(run.lost)},
          {"loops", number(run.slam.loops())},
          {"map_m2", free_m2(run.slam.map())},
          {"log_s", run.log_s}};
}

Outcome<std::vector<NamedContent>> files_of(const LaserLog& log, const LaserRun& run) {
  const std::vector<Pose2> poses = run.slam.trajectory();
  const Grid<std::uint8_t> map = known_part(run.slam.map().occupancy());
  auto text = map_server_text({map, 0.0}, "map.pgm");
  if (!text) return pass_on(text);
  return std::vector<NamedContent>{{"track.csv", track_csv(log, poses)},
                                   {"map.pgm", std::move(text->image)},
                                   {"map.yaml", std::move(text->yaml)}};
}

}  // namespace

Status map_laser_log(const SlamJob& job, const LaserLog& log, Run& run, const RunWatch& watch) {
  Recorder recorder(run.log, job.scenario, log);
  RunSteps steps(watch, 1);
  if (auto ok = steps.next("mapping"); !ok) return ok;
  const RunWatch inner = steps.inner();
  LaserWatch mapping;
  mapping.stop = watch.stop;
  mapping.progress = [&](double done) { inner.part(done); };
  mapping.stepped = [&](const LaserSlam& slam, std::size_t step, const LaserSlamStep& outcome) {
    recorder.note(slam, step, outcome);
  };
  const auto mapped = run_laser_log(log, job.scenario.laser, mapping, processor_s);
  if (!mapped) return tl::unexpected<Fault>(mapped.error());
  run.report.metrics = metrics_of(*mapped);
  run.report.metrics.emplace_back("distance_m", recorder.settle(*mapped));
  run.report.metrics.emplace_back("run_s", recorder.end_s());
  const bool timed = mapped->log_s > 0.0 && mapped->time_s > 0.0;
  run.report.machine_times = {{"time_s", mapped->time_s}, {"max_step_s", mapped->max_step_s}};
  if (timed) run.report.machine_times.emplace_back("real_time_factor", mapped->log_s / mapped->time_s);
  if (mapped->steps < log.steps.size()) mark_cancelled(run.report, run.log, recorder.end_s());
  auto files = files_of(log, *mapped);
  if (!files) return tl::unexpected<Fault>(files.error());
  run.files = std::move(*files);
  return {};
}

}  // namespace outrider
