
#include <fmt/format.h>

#include <iterator>

#include "laser_picture.hpp"
#include "opened.hpp"
#include "outrider/io/map_server.hpp"
#include "outrider/job/clock.hpp"
#include "outrider/jobs/slam/laser_run.hpp"
#include "outrider/report/scan_map.hpp"
#include "outrider/report/slam_record.hpp"

namespace outrider {
namespace {

constexpr std::size_t most_cells = 150'000;       // maximum size of the map in the report
constexpr std::size_t most_shown_cells = 40'000;  // maximum size of the map shown to observers

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

double way_of(const LaserLog& log) {
  double way_m = 0.0;
  for (const LaserLogStep& step : log.steps) way_m += scan_way_m(step.motion);
  return way_m;
}

/// Records the report during mapping and shows it to the observer.
class Recorder {
 public:
  Recorder(const SlamScenario& scenario, const LaserLog& log, RunObserver* observer)
      : log_(log),
        options_(scenario.laser),
        observer_(observer),
        report_(opened(scenario)),
        record_(report_, "laser", way_of(log)),
        times_s_(times_of(log)),
        map_(options_.map, options_.robot_T_laser) {}

  void note(const LaserSlam& slam, std::size_t step, const LaserSlamStep& outcome) {
    const LaserLogStep& logged = log_.steps[step];
    odometry_ = compose(odometry_, logged.motion);
    record_.note({times_s_[step], outcome.pose, slam.pose_covariance(), odometry_, outcome.closed_loop});
    record_.note_scan([&] { return points_of(logged.scan, options_.robot_T_laser); });
    if (outcome.kept || options_.trust_odometry)
      map_.add(outcome.pose, logged.scan, times_s_[step], step + 1);
    if (outcome.lost)
      report_.events.push_back({times_s_[step], "lost", "odometry is off by too much to match the scan"});
    if (outcome.closed_loop) note_loops(slam, slam.trajectory());
    if (observer_ != nullptr && observer_->wants()) show(slam);
  }

  /// Returns the final report.
  Report settled(const LaserRun& run) {
    if (observer_ != nullptr) show(run.slam);
    std::vector<Pose2> poses = run.slam.trajectory();
    note_loops(run.slam, poses);
    map_.redraw(poses);
    report_.slam->map = map_.drawn(most_cells);
    poses.erase(poses.begin());  // before the first scan
    record_.settle(poses, run.reference);
    return std::move(report_);
  }

 private:
  void note_loops(const LaserSlam& slam, const std::vector<Pose2>& poses) {
    moved_ = true;
    std::vector<ReportLoop>& loops = report_.slam->loops;
    const std::size_t told = loops.size();
    loops.clear();
    for (const LaserLoop& loop : slam.closed_loops()) {
      const double then_s = times_s_[loop.from - 1], time_s = times_s_[loop.to - 1];
      loops.push_back({time_s, poses[loop.from].position, poses[loop.to].position});
      if (loops.size() > told)
        report_.events.push_back(
            {time_s, "loop", fmt::format("the place of {:.1f} s is recognised", then_s)});
    }
  }

  void show(const LaserSlam& slam) {
    if (moved_) map_.redraw(slam.trajectory());
    moved_ = false;
    report_.slam->map = map_.drawn(most_shown_cells);
    observer_->see(report_);
  }

  const LaserLog& log_;
  const LaserSlamOptions& options_;
  RunObserver* observer_;
  Report report_;
  SlamRecord record_;
  std::vector<double> times_s_;
  ScanMap map_;
  Pose2 odometry_;
  bool moved_ = false;  ///< a loop has moved scans since the map was drawn
};

Metrics metrics_of(const LaserRun& run) {
  const auto number = [](auto value) { return static_cast<double>(value); };
  return {{"mean_absolute_error_m", known(run.mean_error_m)},
          {"ate_m", known(run.rms_error_m)},
          {"steps", number(run.steps)},
          {"steps_matched", number(run.matched)},
          {"steps_lost", number(run.lost)},
          {"loops", number(run.slam.loops())},
          {"log_s", run.log_s}};
}

Outcome<std::vector<NamedContent>> files_of(const LaserLog& log, const LaserRun& run) {
  const std::vector<Pose2> poses = run.slam.trajectory();
  std::vector<Vec2> track;
  for (const Pose2& pose : poses) track.push_back(pose.position);
  const Grid<std::uint8_t> map = known_part(run.slam.map().occupancy());
  auto text = map_server_text({map, 0.0}, "map.pgm");
  if (!text) return pass_on(text);
  return std::vector<NamedContent>{{"track.csv", track_csv(log, poses)},
                                   {"slam.svg", to_svg(map, track, run.reference)},
                                   {"map.pgm", std::move(text->image)},
                                   {"map.yaml", std::move(text->yaml)}};
}

}  // namespace

Outcome<Run> map_laser_log(const SlamJob& job, const LaserLog& log, const RunWatch& watch) {
  Recorder recorder(job.scenario, log, watch.observer);
  RunSteps steps(watch, 1);
  if (auto ok = steps.next("mapping"); !ok) return pass_on(ok);
  const RunWatch inner = steps.inner();
  LaserWatch mapping;
  mapping.stop = watch.stop;
  mapping.progress = [&](double done) { inner.part(done); };
  mapping.stepped = [&](const LaserSlam& slam, std::size_t step, const LaserSlamStep& outcome) {
    recorder.note(slam, step, outcome);
  };
  const auto run = run_laser_log(log, job.scenario.laser, mapping, processor_s);
  if (!run) return tl::unexpected<Fault>(run.error());
  Report report = recorder.settled(*run);
  conclude(report, metrics_of(*run));
  const bool timed = run->log_s > 0.0 && run->time_s > 0.0;
  report.machine_times = {{"time_s", run->time_s}, {"max_step_s", run->max_step_s}};
  if (timed) report.machine_times.emplace_back("real_time_factor", run->log_s / run->time_s);
  if (run->steps < log.steps.size()) mark_cancelled(report, report.track.back().time_s);
  auto files = files_of(log, *run);
  if (!files) return pass_on(files);
  return Run{std::move(report), std::move(*files)};
}

}  // namespace outrider
