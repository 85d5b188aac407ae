#include "slam_laser.hpp"

#include <fmt/format.h>

#include <iterator>
#include <nlohmann/json.hpp>

#include "laser_picture.hpp"
#include "laser_run.hpp"
#include "outrider/io/map_server.hpp"
#include "outrider/motion/twist.hpp"
#include "outrider/report/scan_map.hpp"
#include "outrider/report/slam_record.hpp"
#include "progress.hpp"
#include "terminal.hpp"

namespace outrider::cli {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t most_cells = 150'000;       // of the map in the report
constexpr std::size_t most_shown_cells = 40'000;  // of the map, to who looks on

/// A scan a line: number, time (s), x, y (m), heading (rad).
std::string track_csv(const LaserLog& log, const std::vector<Pose2>& poses) {
  std::string text = "step,time,x,y,heading\n";
  for (std::size_t i = 0; i < log.steps.size(); ++i) {
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

/// What is noted while the log is mapped, for the report and for who looks on.
class Recorder {
 public:
  Recorder(const SlamJob& job, const LaserLog& log, Onlooker* onlooker)
      : log_(log),
        options_(job.scenario.laser),
        onlooker_(onlooker),
        report_(opened(job)),
        record_(report_, "laser", way_of(log)),
        times_s_(times_of(log)),
        map_(options_.map, options_.robot_T_laser) {}

  void note(const LaserSlam& slam, std::size_t step, const LaserSlamStep& outcome) {
    const LaserLogStep& logged = log_.steps[step];
    odometry_ = placed_in(odometry_, logged.motion);
    record_.note({times_s_[step], outcome.pose, slam.pose_covariance(), odometry_, outcome.closed_loop});
    record_.note_scan([&] { return points_of(logged.scan, options_.robot_T_laser); });
    if (outcome.kept || options_.trust_odometry)
      map_.add(outcome.pose, logged.scan, times_s_[step], step + 1);
    if (outcome.lost)
      report_.events.push_back({times_s_[step], "lost", "odometry is off by too much to match the scan"});
    if (outcome.closed_loop) note_loops(slam, slam.trajectory());
    if (onlooker_ != nullptr && onlooker_->wants()) show(slam);
  }

  /// The report as it stands once all is settled.
  Report settled(const LaserRun& run) {
    if (onlooker_ != nullptr) show(run.slam);
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
    onlooker_->see(report_);
  }

  const LaserLog& log_;
  const LaserSlamOptions& options_;
  Onlooker* onlooker_;
  Report report_;
  SlamRecord record_;
  std::vector<double> times_s_;
  ScanMap map_;
  Pose2 odometry_;
  bool moved_ = false;  ///< a loop has moved scans since the map was drawn
};

Outcome<std::string> write_all(const SlamJob& job, const LaserLog& log, const LaserRun& run, Report& report) {
  if (job.out.empty()) return std::string{};
  const std::vector<Pose2> poses = run.slam.trajectory();
  std::vector<Vec2> track;
  for (const Pose2& pose : poses) track.push_back(pose.position);
  const Grid<std::uint8_t> map = known_part(run.slam.map().occupancy());
  auto path = write_report(
      job, report, {{"track.csv", track_csv(log, poses)}, {"slam.svg", to_svg(map, track, run.reference)}});
  if (!path) return path;
  if (auto ok = save_map_server(job.out + "/map.yaml", {map, 0.0}); !ok) return pass_on(ok);
  return path;
}

Json result_of(const SlamJob& job, const LaserLog& log, const LaserRun& run) {
  const bool timed = run.log_s > 0.0 && run.time_s > 0.0;
  return {{"status", "done"},
          {"job", "slam"},
          {"file", job.scenario.log},
          {"engine", "laser"},
          {"mean_absolute_error_m", known(run.mean_error_m)},
          {"ate_m", known(run.rms_error_m)},
          {"steps", log.steps.size()},
          {"steps_matched", run.matched},
          {"steps_lost", run.lost},
          {"loops", run.slam.loops()},
          {"time_s", run.time_s},
          {"max_step_s", run.max_step_s},
          {"log_s", run.log_s},
          {"real_time_factor", timed ? Json(run.log_s / run.time_s) : Json(nullptr)}};
}

void print_summary(const LaserLog& log, const LaserRun& run) {
  const bool timed = run.log_s > 0.0 && run.time_s > 0.0;
  show("{} scans, {} matched, {} loops closed in {}{}\n", log.steps.size(), run.matched, run.slam.loops(),
       duration_text(run.time_s),
       timed ? fmt::format(", {:.0f} times as fast as the robot drove", run.log_s / run.time_s) : "");
  if (run.lost > 0) {
    show("lost {}: odometry is off by too much there to match the scan; what follows may lie elsewhere\n",
         run.lost == 1 ? "once" : fmt::format("{} times", run.lost));
  }
  if (run.mean_error_m) {
    show("poses {:.3f} m from the reference on average, once the track is laid over it\n", *run.mean_error_m);
  }
}

}  // namespace

int map_laser_log(const SlamJob& job, const LaserLog& log) {
  LiveReport live;
  std::optional<Recorder> recorder;
  if (!job.out.empty() || live.onlooker() != nullptr) recorder.emplace(job, log, live.onlooker());
  Progress progress(1);
  progress.next("mapping");
  LaserWatch watch;
  watch.progress = [&](double done) { progress.part(done); };
  if (recorder) {
    watch.stepped = [&](const LaserSlam& slam, std::size_t step, const LaserSlamStep& outcome) {
      recorder->note(slam, step, outcome);
    };
  }
  const auto run = run_laser_log(log, job.scenario.laser, watch);
  progress.end();
  if (!run) return say(run.error(), job.json);
  Json result = result_of(job, log, *run);
  std::string path;
  if (recorder) {
    Report report = recorder->settled(*run);
    add_metrics(report, result);
    auto written = write_all(job, log, *run, report);
    if (!written) return say(written.error(), job.json);
    path = *written;
  }
  result["report"] = path.empty() ? Json(nullptr) : Json(path);
  job.json ? print(result) : print_summary(log, *run);
  return job_done;
}

}  // namespace outrider::cli
