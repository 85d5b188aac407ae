// Localises the robot of a laser log on a known map.

#include <fmt/format.h>

#include <algorithm>

#include "laser/laser_records.hpp"
#include "laser/track.hpp"
#include "outrider/io/log/laser_source.hpp"
#include "outrider/io/map/map.hpp"
#include "outrider/job/clock.hpp"
#include "outrider/job/map_log.hpp"
#include "outrider/job/sensor_log.hpp"
#include "outrider/jobs/slam/laser/localise_mission.hpp"
#include "outrider/jobs/slam/recording_clock.hpp"
#include "outrider/log/append.hpp"
#include "outrider/robot/recorded_robot.hpp"
#include "recordings.hpp"
#include "slam_log.hpp"

namespace outrider {
namespace {

/// Logs what the robot believed, and remembers when. Scans, odometry and belief are logged for each scan.
class LocaliseRecorder {
 public:
  LocaliseRecorder(Log& log, const SlamScenario& scenario, const KnownMap& map)
      : log_(log, scenario, "localiser") {
    log_mount(log, "laser", scenario.laser.robot_T_laser, 0.0);
    log_map(log, map.occupancy, map.yaw_rad, 0.0);
  }

  void note(const LocaliseMission& mission, const Observation& seen) {
    const MapLocaliserStep& step = *mission.newest;
    recorded_s_.push_back(seen.time_s);
    const double time_s = std::max(log_.end_s(), seen.time_s - recorded_s_.front());
    times_s_.push_back(time_s);
    if (step.located) {
      log_.note({time_s, step.pose, mission.localiser.pose_covariance(), seen.odometry, step.found});
    } else {
      log_odometry(log_.log(), time_s, seen.odometry);
      log_.pass(time_s);
    }
    log_scan(log_.log(), time_s, *seen.scan);
    if (step.found) {
      log_event(
          log_.log(), time_s, "located",
          fmt::format("the robot is at ({:.2f}, {:.2f}) m", step.pose.position.x, step.pose.position.y));
    }
    if (step.lost) {
      log_event(log_.log(), time_s, "lost", "the scans fit the map no longer");
      lost_s_.push_back(time_s);
    }
  }

  void settle(const std::vector<TrackedPose>& track, const std::vector<Vec2>& reference, const Box2& map) {
    std::vector<double> times_s;
    std::vector<Pose2> poses;
    for (const TrackedPose& one : track) {
      times_s.push_back(times_s_[one.step]);
      poses.push_back(one.pose);
    }
    log_.settle_at(times_s, poses, reference, map);
  }

  [[nodiscard]] double end_s() const { return log_.end_s(); }
  [[nodiscard]] const std::vector<double>& recorded_s() const { return recorded_s_; }
  /// Returns the times at which the robot was lost.
  [[nodiscard]] const std::vector<double>& lost_s() const { return lost_s_; }

 private:
  SlamLog log_;
  std::vector<double> recorded_s_;  ///< times of all scans
  std::vector<double> times_s_;     ///< the same in the run
  std::vector<double> lost_s_;
};

void judge_localisation(Report& report, const LocaliseMission& mission, const std::vector<double>& lost_s) {
  constexpr double most_contradicted = 0.1;  // share of the scans that were checked
  if (mission.located.empty()) {
    report.status = "not_done";
    report.reason =
        "the robot was not located: no place of the map fits what it saw, or several do; let it drive "
        "farther";
  } else if (!mission.localiser.is_located()) {
    report.status = "not_done";
    report.reason = fmt::format(
        "the robot has been lost since {:.1f} s: the scans fit the map no longer, and no place fits them "
        "alone",
        lost_s.back());
  } else if (static_cast<double>(mission.contradicted) >
             most_contradicted * static_cast<double>(mission.checked)) {
    report.status = "doubtful";
    report.reason = fmt::format("{} of {} scans do not fit the map where the robot is believed to be",
                                mission.contradicted, mission.checked);
  }
}

PathError compare(const LocaliseMission& mission, const std::vector<Pose2>& reference) {
  std::vector<Vec2> path, known_path;
  for (std::size_t i = 0; i < mission.located.size(); ++i) {
    if (mission.located[i] >= reference.size()) break;
    path.push_back(mission.poses[i].position);
    known_path.push_back(reference[mission.located[i]].position);
  }
  return path_error(path, known_path);
}

Metrics metrics_of(const LocaliseMission& mission, const LocaliseRecorder& recorder) {
  const auto number = [](std::size_t value) { return static_cast<double>(value); };
  return {{"steps", number(mission.scans)},
          {"steps_located", number(mission.located.size())},
          {"times_located", number(mission.found)},
          {"times_lost", number(recorder.lost_s().size())},
          {"scans_checked", number(mission.checked)},
          {"scans_contradicted", number(mission.contradicted)},
          {"run_s", recorder.end_s()}};
}

std::vector<TrackedPose> track_of(const LocaliseMission& mission, const LocaliseRecorder& recorder) {
  std::vector<TrackedPose> track;
  for (std::size_t i = 0; i < mission.located.size(); ++i) {
    const std::size_t step = mission.located[i];
    track.push_back({step, recorder.recorded_s()[step], mission.poses[i]});
  }
  return track;
}

/// Returns the length of the path, without the parts on which the robot was not located.
double length_of(const std::vector<TrackedPose>& track) {
  double way_m = 0.0;
  for (std::size_t i = 1; i < track.size(); ++i) {
    if (track[i].step == track[i - 1].step + 1)
      way_m += distance(track[i - 1].pose.position, track[i].pose.position);
  }
  return way_m;
}

Status localise(const SlamJob& job, LaserSource& source, const KnownMap& map,
                const std::vector<Pose2>& reference, Run& run, const RunWatch& watch) {
  auto begun = MapLocaliser::begin(map, job.scenario.laser);
  if (!begun) return bad_input(begun.error().sentence, job.scenario.map);
  RunSteps steps(watch, 1);
  if (auto ok = steps.next("localising"); !ok) return ok;
  const RunWatch inner = steps.inner();
  LocaliseRecorder recorder(run.log, job.scenario, map);
  LaserRecords records(source);
  RecordedRobot robot([&] { return records.next(); });
  LocaliseMission mission(std::move(*begun), job.scenario.laser);
  RecordingClock clock;
  const double begin_s = processor_s();
  const bool ended =
      run_mission(mission, robot, watch.stop, [&](const Observation& seen, const Command* command) {
        if (command == nullptr) return;
        clock.note(seen.time_s);
        recorder.note(mission, seen);
        inner.part(source.progress());
      });
  if (records.fault()) return tl::unexpected<Fault>(*records.fault());
  if (mission.fault) return tl::unexpected<Fault>(std::move(*mission.fault));
  if (mission.scans == 0) return bad_input("the log has no scan", job.scenario.log);

  const PathError error = compare(mission, reference);
  run.report.metrics = metrics_of(mission, recorder);
  run.report.metrics.emplace_back("mean_absolute_error_m", known(error.mean_m));
  run.report.metrics.emplace_back("ate_m", known(error.rms_m));
  run.report.metrics.emplace_back("log_s", known(clock.length_s()));
  const std::vector<TrackedPose> track = track_of(mission, recorder);
  recorder.settle(track, error.reference, map.occupancy.frame.bounds());
  run.report.metrics.emplace_back("distance_m", length_of(track));
  run.report.machine_times = {{"time_s", processor_s() - begin_s}};
  judge_localisation(run.report, mission, recorder.lost_s());
  if (!ended) mark_cancelled(run.report, run.log, recorder.end_s());
  run.files = track_files(track);
  return {};
}

}  // namespace

Outcome<KnownMap> load_known_map(const std::string& path) {
  auto loaded = load_map(path);
  if (!loaded) return pass_on(loaded);
  auto* cells = std::get_if<MapCells>(&loaded->shape);
  if (cells == nullptr || loaded->kind == MapKind::movingai)
    return bad_input("it has no occupied and unknown cells; give a map_server map, as slam writes it", path);
  return KnownMap{std::move(cells->occupancy), cells->yaw_rad};
}

Status localise_laser_log(const SlamJob& job, const LaserLog& log, const KnownMap& map, Run& run,
                          const RunWatch& watch) {
  LoadedLaserSource source(log);
  return localise(job, source, map, log.reference, run, watch);
}

Status localise_laser_topics(const SlamJob& job, TopicsInput source, const KnownMap& map, Run& run,
                             const RunWatch& watch) {
  if (auto ok = open_again(source, job.scenario); !ok) return ok;
  auto done = localise(job, *source, map, {}, run, watch);
  for (std::string& warning : source->warnings()) run.report.warnings.push_back(std::move(warning));
  return done;
}

}  // namespace outrider
