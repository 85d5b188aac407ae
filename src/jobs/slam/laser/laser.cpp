
#include <fmt/format.h>

#include <algorithm>

#include "faults/truth.hpp"
#include "laser/laser_verdict.hpp"
#include "laser/scan_map.hpp"
#include "laser/track.hpp"
#include "outrider/io/log/g2o.hpp"
#include "outrider/io/map/map_server.hpp"
#include "outrider/job/clock.hpp"
#include "outrider/job/sensor_log.hpp"
#include "outrider/jobs/slam/laser/laser_run.hpp"
#include "outrider/log/append.hpp"
#include "outrider/log/messages/conversions.hpp"
#include "outrider/log/topics.hpp"
#include "outrider/slam/map_error.hpp"
#include "outrider/world/known_extent.hpp"
#include "recordings.hpp"
#include "slam_log.hpp"

namespace outrider {
namespace {

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

/// Logs the mapping. Of a recording that is read while it is mapped, belief, odometry and path are logged at
/// the keyframes only, scans at those of new places, and the map once in ten seconds: the log then grows with
/// the way, and not with the recording.
class LaserRecorder {
 public:
  /// `times_s` are the times of all steps, or empty for a recording that is read while it is mapped.
  LaserRecorder(Log& log, const SlamScenario& scenario, std::vector<double> times_s)
      : options_(scenario.laser),
        log_(log, scenario, "laser"),
        keyframes_only_(times_s.empty()),
        times_s_(std::move(times_s)),
        map_(options_.map, options_.robot_T_laser, keyframes_only_ ? period_s : 1.0) {
    log_mount(log, "laser", options_.robot_T_laser, 0.0);
  }

  void note(const LaserSlam& slam, std::size_t step, const Observation& seen, const LaserSlamStep& outcome) {
    recorded_s_.push_back(seen.time_s);
    if (keyframes_only_) times_s_.push_back(seen.time_s - recorded_s_.front());
    const double time_s = times_s_[step];
    if (!keyframes_only_ || outcome.kept || step == 0) {
      noted_.push_back(step);
      log_.note({time_s, outcome.pose, slam.pose_covariance(), seen.odometry, outcome.closed_loop});
      note_scan(time_s, *seen.scan, outcome.is_known_place);
    } else {
      log_.pass(time_s);
    }
    if (outcome.kept || options_.trust_odometry) map_.add(log_.log(), outcome.pose, *seen.scan, time_s);
    if (outcome.lost) log_event(log_.log(), time_s, "lost", "odometry is off by too much to match the scan");
    if (outcome.undid_loop)
      log_event(log_.log(), log_.end_s(), "loop",
                "a loop that was closed before contradicts the scans; it is undone");
    if (outcome.closed_loop) log_loops(slam, slam.trajectory());
  }

  /// Logs the final map and path, and returns the length of the path.
  double settle(const LaserRun& run) {
    std::vector<Pose2> poses = run.slam.trajectory();
    log_loops(run.slam, poses);
    map_.finish(log_.log(), run.slam.map().occupancy(), log_.end_s());
    poses.erase(poses.begin());  // before the first scan
    const Grid<std::uint8_t> map = known_part(run.slam.map().occupancy());
    const double way_m = length_of(poses);
    std::vector<Pose2> noted;
    for (const std::size_t step : noted_) noted.push_back(poses[step]);
    log_.settle(noted, run.reference, map.cells.empty() ? Box2{} : map.frame.bounds());
    return way_m;
  }

  [[nodiscard]] double end_s() const { return log_.end_s(); }
  /// Returns the times of the steps in the run.
  [[nodiscard]] const std::vector<double>& times_s() const { return times_s_; }
  /// Returns the times of the steps as they were recorded.
  [[nodiscard]] const std::vector<double>& recorded_s() const { return recorded_s_; }

 private:
  static constexpr double period_s = 10.0;  ///< of what is logged of a place that is known

  /// Logs a scan. A recording that is read while it is mapped may drive through known places for hours: of
  /// their scans, one in ten seconds is logged.
  void note_scan(double time_s, const LaserScan& scan, bool is_known_place) {
    if (keyframes_only_ && is_known_place && time_s < scan_logged_s_ + period_s) return;
    log_scan(log_.log(), time_s, scan);
    scan_logged_s_ = time_s;
  }

  void log_loops(const LaserSlam& slam, const std::vector<Pose2>& poses) {
    outrider_msgs::Loops loops;
    told_ = std::min(told_, slam.loops());  // one may be undone
    for (const LaserLoop& loop : slam.closed_loops()) {
      const double then_s = times_s_[loop.from - 1], time_s = times_s_[loop.to - 1];
      loops.loops.push_back({time_s, point_of(poses[loop.from].position), point_of(poses[loop.to].position)});
      if (loops.loops.size() <= told_) continue;
      ++told_;
      log_event(log_.log(), log_.end_s(), "loop", fmt::format("the place of {:.1f} s is recognised", then_s));
    }
    if (!loops.loops.empty() || slam.loops_undone() > 0)
      log_.log().append(topic::loops, log_.end_s(), std::move(loops));
  }

  const LaserSlamOptions& options_;
  SlamLog log_;
  bool keyframes_only_;
  std::vector<double> times_s_;     ///< of the run
  std::vector<double> recorded_s_;  ///< of the steps so far
  std::vector<std::size_t> noted_;  ///< the steps that are logged
  double scan_logged_s_ = 0.0;
  ScanMap map_;
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
          {"log_s", known(run.log_s)}};
}

Outcome<std::vector<NamedContent>> files_of(const std::vector<double>& recorded_s, const LaserRun& run) {
  const Grid<std::uint8_t> map = known_part(run.slam.map().occupancy());
  auto text = map_server_text({map, 0.0}, "map.pgm");
  if (!text) return pass_on(text);
  const std::vector<Pose2> poses = run.slam.trajectory();
  std::vector<TrackedPose> track;
  track.reserve(poses.size());
  for (std::size_t i = 0; i + 1 < poses.size(); ++i) track.push_back({i, recorded_s[i], poses[i + 1]});
  std::vector<NamedContent> files = track_files(track);
  const PoseGraph graph = run.slam.pose_graph();
  if (!graph.edges.empty()) {
    std::vector<Pose2> placed;
    for (const GraphNode& node : graph.nodes) placed.push_back(node.pose);
    auto g2o = to_g2o(graph, placed);
    if (!g2o) return pass_on(g2o);
    files.push_back({"graph.g2o", std::move(*g2o)});
  }
  files.push_back({"map.pgm", std::move(text->image)});
  files.push_back({"map.yaml", std::move(text->yaml)});
  return files;
}

/// Returns the pose of the map of the log on the map that was made.
Pose2 reference_on_map(const LaserRun& run, const std::vector<Pose2>& reference) {
  const std::vector<Pose2> poses = run.slam.trajectory();
  std::vector<Vec2> path, known_path;
  for (std::size_t i = 0; i < std::min(reference.size(), run.steps); ++i) {
    path.push_back(poses[i + 1].position);
    known_path.push_back(reference[i].position);
  }
  return rigid_alignment(known_path, path);
}

/// Maps what `map` runs, and reports it.
template <class Map>
Status report_mapping(LaserRecorder& recorder, Run& run, const RunWatch& watch, const Map& map) {
  RunSteps steps(watch, 1);
  if (auto ok = steps.next("mapping"); !ok) return ok;
  const RunWatch inner = steps.inner();
  LaserWatch mapping;
  mapping.stop = watch.stop;
  mapping.progress = [&](double done) { inner.part(done); };
  mapping.stepped = [&](const LaserSlam& slam, std::size_t step, const Observation& seen,
                        const LaserSlamStep& outcome) { recorder.note(slam, step, seen, outcome); };
  const Outcome<LaserRun> mapped = map(mapping);
  if (!mapped) return pass_on(mapped);
  run.report.metrics = metrics_of(*mapped);
  run.report.metrics.emplace_back("distance_m", recorder.settle(*mapped));
  run.report.metrics.emplace_back("run_s", recorder.end_s());
  judge_mapping(run.report, run.log, *mapped, recorder.times_s());
  run.report.machine_times = {{"time_s", mapped->time_s}, {"max_step_s", mapped->max_step_s}};
  if (mapped->log_s && mapped->time_s > 0.0)
    run.report.machine_times.emplace_back("real_time_factor", *mapped->log_s / mapped->time_s);
  if (mapped->stopped) mark_cancelled(run.report, run.log, recorder.end_s());
  auto files = files_of(recorder.recorded_s(), *mapped);
  if (!files) return pass_on(files);
  run.files = std::move(*files);
  return {};
}

}  // namespace

Status open_again(TopicsInput& source, const SlamScenario& scenario) {
  if (source) return {};
  auto opened = open_laser_topics(scenario.log, scenario.topics);
  if (!opened) return pass_on(opened);
  source = std::move(*opened);
  return {};
}

Status map_laser_log(const SlamJob& job, const LaserLog& log, const LaserLog& recorded, Run& run,
                     const RunWatch& watch) {
  LaserRecorder recorder(run.log, job.scenario, times_of(log));
  std::optional<double> map_error_m;
  auto done = report_mapping(recorder, run, watch, [&](const LaserWatch& mapping) {
    auto mapped = run_laser_log(log, job.scenario.laser, mapping, processor_s);
    if (mapped && !recorded.reference.empty()) {
      map_error_m = wall_error_m(mapped->slam.map().occupancy(), recorded,
                                 reference_on_map(*mapped, log.reference), job.scenario.laser.robot_T_laser);
    }
    return mapped;
  });
  if (map_error_m) run.report.metrics.emplace_back("map_error_m", *map_error_m);
  return done;
}

Status map_laser_topics(const SlamJob& job, TopicsInput source, Run& run, const RunWatch& watch) {
  if (auto ok = open_again(source, job.scenario); !ok) return ok;
  LaserRecorder recorder(run.log, job.scenario, {});
  auto done = report_mapping(recorder, run, watch, [&](const LaserWatch& mapping) {
    return run_laser_log(*source, job.scenario.laser, mapping, processor_s);
  });
  for (std::string& warning : source->warnings()) run.report.warnings.push_back(std::move(warning));
  return done;
}

}  // namespace outrider
