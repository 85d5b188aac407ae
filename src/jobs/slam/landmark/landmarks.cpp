
#include <fmt/format.h>

#include <Eigen/LU>
#include <algorithm>
#include <iterator>
#include <map>

#include "landmark/landmark_verdict.hpp"
#include "outrider/io/files/files.hpp"
#include "outrider/io/log/trajectory.hpp"
#include "outrider/job/clock.hpp"
#include "outrider/jobs/slam/landmark/landmark_mission.hpp"
#include "outrider/log/append.hpp"
#include "outrider/log/messages/conversions.hpp"
#include "outrider/log/topics.hpp"
#include "outrider/robot/recorded_robot.hpp"
#include "outrider/slam/map_error.hpp"
#include "recordings.hpp"
#include "slam_log.hpp"

namespace outrider {
namespace {

constexpr double map_every_s = 10.0;  // between two messages with the same landmarks
constexpr double reach_m = 0.5;  // largest distance between a true place and a landmark with a meaningless id

std::string landmarks_csv(const LandmarkMap& map) {
  std::string text = "id,x,y,xx,xy,yy,sightings\n";
  for (const LandmarkEstimate& l : map) {
    fmt::format_to(std::back_inserter(text), "{},{},{},{},{},{},{}\n", l.id, l.position.x, l.position.y,
                   l.covariance(0, 0), l.covariance(0, 1), l.covariance(1, 1), l.sightings);
  }
  return text;
}

/// Returns the true places in the frame of the map.
std::map<std::int64_t, Vec2> truth_in_map(const LandmarkLog& log, const MapError& error) {
  std::map<std::int64_t, Vec2> result;
  if (error.landmarks == 0) return result;
  const Pose2& motion = error.alignment;
  for (const auto& [id, place] : log.true_landmarks) result.emplace(id, motion.to_local(place));
  return result;
}

std::vector<double> times_of(const LandmarkLog& log) {
  std::vector<double> recorded_s;
  for (const LogStep& step : log.steps) recorded_s.push_back(log.timed ? step.time_s : 0.0);
  return run_times(recorded_s);
}

/// Logs the mapping.
class LandmarkRecorder {
 public:
  LandmarkRecorder(Log& log, const SlamScenario& scenario, const LandmarkLog& recording)
      : recording_(recording),
        log_(log, scenario, scenario.landmarks.engine),
        times_s_(times_of(recording)) {}

  void note(const LandmarkSlam& slam, std::size_t step, const StepOutcome& outcome, const Pose2& odometry) {
    const double time_s = times_s_[step];
    log_.note({time_s, slam.pose(), slam.pose_covariance(), odometry, outcome.used > 0});
    outrider_msgs::Sightings seen;
    for (const LandmarkSighting& sighting : recording_.steps[step].sightings)
      seen.points.push_back(point_of(sighting.position));
    if (!seen.points.empty()) log_.log().append(topic::sightings, time_s, std::move(seen));
    for (const std::int64_t id : outcome.added) {
      first_s_[id] = time_s;
      log_event(log_.log(), time_s, "landmark", fmt::format("landmark {} is in the map", id));
    }
    for (const std::int64_t id : outcome.removed)
      log_event(log_.log(), time_s, "removed", fmt::format("landmark {} is taken out of the map", id));
    if (outcome.lost != lost_)
      log_event(log_.log(), time_s, outcome.lost ? "lost" : "found",
                outcome.lost ? "the robot is lost" : "the robot knows again where it is");
    lost_ = outcome.lost;
    const bool same = outcome.added.empty() && outcome.removed.empty();
    if (same && (outcome.used == 0 || time_s < next_map_s_)) return;
    next_map_s_ = time_s + map_every_s;
    log_.log().append(topic::landmarks, time_s, message_of(slam.landmarks()));
  }

  /// Logs the final map and path, and returns the length of the path. If landmarks are identified by id,
  /// `truth` has true places.
  double settle(const LandmarkSlam& slam, const LandmarkMap& map, const std::map<std::int64_t, Vec2>& truth,
                bool by_id) {
    outrider_msgs::Landmarks landmarks = message_of(map);
    Box2 box;
    for (outrider_msgs::Landmark& landmark : landmarks.landmarks) {
      const Vec2 place = vec2_of(landmark.position);
      const auto known = by_id && truth.contains(landmark.id) ? std::optional(truth.at(landmark.id))
                         : by_id                              ? std::nullopt
                                                              : nearest(truth, place);
      if (known) landmark.truth = point_of(*known);
      box.include(place);
      if (known) box.include(*known);
    }
    log_.log().append(topic::landmarks, log_.end_s(), std::move(landmarks));
    std::vector<Pose2> poses = slam.trajectory();  // also those of an earlier run, and the start
    poses.erase(poses.begin(), poses.end() - static_cast<std::ptrdiff_t>(recording_.steps.size()));
    return log_.settle(poses, {}, box);
  }

  [[nodiscard]] double end_s() const { return log_.end_s(); }
  /// Returns the times of the steps in the run.
  [[nodiscard]] const std::vector<double>& times_s() const { return times_s_; }

 private:
  static std::optional<Vec2> nearest(const std::map<std::int64_t, Vec2>& truth, Vec2 place) {
    std::optional<Vec2> found;
    for (const auto& [id, there] : truth) {
      if (distance(there, place) <= (found ? distance(*found, place) : reach_m)) found = there;
    }
    return found;
  }

  [[nodiscard]] outrider_msgs::Landmarks message_of(const LandmarkMap& map) const {
    outrider_msgs::Landmarks message;
    for (const LandmarkEstimate& one : map) {
      const auto first = first_s_.find(one.id);
      outrider_msgs::Landmark landmark;
      landmark.id = one.id;
      landmark.first_seen = first == first_s_.end() ? 0.0 : first->second;
      landmark.sightings = static_cast<std::uint32_t>(one.sightings);
      set_place(landmark, one.position, one.covariance);
      message.landmarks.push_back(landmark);
    }
    return message;
  }

  const LandmarkLog& recording_;
  SlamLog log_;
  std::vector<double> times_s_;
  std::map<std::int64_t, double> first_s_;
  double next_map_s_ = 0.0;
  bool lost_ = false;
};

Outcome<LandmarkSlam> begin(const SlamJob& job, const LandmarkSlamOptions& options, const Pose2& start) {
  if (job.scenario.resume.empty()) return LandmarkSlam::begin(options, start);
  if (auto ok = LandmarkSlam::begin(options, start); !ok) return ok;
  const auto state = read_file(job.scenario.resume);
  if (!state) return pass_on(state);
  auto begun = LandmarkSlam::load(*state);
  if (!begun) return bad_input(begun.error().sentence, job.scenario.resume);
  return begun;
}

/// Returns a robot that replays the log, without the ids if they must not be used.
RecordedRobot replay_of(const LandmarkLog& log, bool unknown_ids) {
  std::vector<Observation> records;
  for (const LogStep& step : log.steps) {
    Observation record;
    record.time_s = step.time_s;
    record.landmarks = step;
    if (unknown_ids) {
      for (LandmarkSighting& sighting : record.landmarks->sightings) sighting.id.reset();
    }
    records.push_back(std::move(record));
  }
  return RecordedRobot(std::move(records));
}

/// Maps the log. If the run is stopped, only the mapped steps remain in the log.
Outcome<LandmarkMission> run_log(const SlamJob& job, const LandmarkSlamOptions& options, LandmarkLog& log,
                                 LandmarkRecorder& recorder, const RunWatch& watch) {
  auto begun = begin(job, options, log.start);
  if (!begun) return pass_on(begun);
  LandmarkMission mission(std::move(*begun));
  mission.checks_landmarks = options.unknown_ids;
  RunSteps steps(watch, 1);
  if (auto ok = steps.next("mapping"); !ok) return pass_on(ok);
  const RunWatch inner = steps.inner();
  RecordedRobot robot = replay_of(log, options.unknown_ids);
  run_mission(mission, robot, watch.stop, [&](const Observation&, const Command*) {
    if (!mission.newest) return;
    const std::size_t mapped = mission.times_s.size();
    recorder.note(mission.slam, mapped - 1, *mission.newest, mission.odometry.back());
    inner.part(static_cast<double>(mapped) / static_cast<double>(log.steps.size()));
  });
  if (mission.fault) {
    return bad_input(fmt::format("step {}: {}", mission.times_s.size(), mission.fault->sentence),
                     job.scenario.log);
  }
  log.steps.resize(mission.times_s.size());
  const double since_s = wall_s();
  mission.slam.settle();
  mission.times_s.push_back(wall_s() - since_s);
  return mission;
}

/// Returns options for a log with reliable ids: no gate and no patience, unless they were set.
LandmarkSlamOptions options_of(const SlamJob& job, const LandmarkLog& log) {
  LandmarkSlamOptions options = job.scenario.landmarks;
  if (!log.told_apart || options.unknown_ids) return options;
  if (!job.given.contains("slam.gate")) options.gate = 1.0;
  if (!job.given.contains("slam.patience")) options.patience = 1;
  return options;
}

/// Corrects a truth in which two ids are exchanged.
std::string undo_exchange(LandmarkLog& log, const LandmarkMap& map) {
  const auto exchanged = exchanged_ids(map, log.true_landmarks);
  if (!exchanged) return {};
  std::swap(log.true_landmarks[exchanged->first], log.true_landmarks[exchanged->second]);
  return fmt::format("the truth has landmarks {} and {} exchanged; they are taken for each other",
                     exchanged->first, exchanged->second);
}

Metrics metrics_of(const LandmarkMission& run, std::size_t landmarks, const MapError& error) {
  const auto number = [](auto value) { return static_cast<double>(value); };
  return {{"landmark_rmse_m", known(error.rmse_m)},
          {"landmark_rmse_aligned_m", known(error.aligned_rmse_m)},
          {"ate_m", known(std::nullopt)},
          {"cost", run.slam.cost()},
          {"chi2_per_dof", chi2_per_dof(run.slam)},
          {"steps", number(run.times_s.size() - 1)},
          {"landmarks", number(landmarks)},
          {"landmarks_compared", number(error.landmarks)},
          {"sightings_used", number(run.used)},
          {"sightings_refused", number(run.refused)},
          {"landmarks_removed", number(run.removed)},
          {"steps_lost", number(run.lost)}};
}

/// Returns what is unknown of the size of a map whose poses are settled and whose landmarks have ids.
/// Sightings that do not fit are left out.
SystematicErrors size_of(const LandmarkLog& log, const LandmarkMission& run, const LandmarkMap& map,
                         const LandmarkSlamOptions& options) {
  constexpr double most_squared = 25.0;
  constexpr double least_variance = 1e-12;  // m^2, rad^2: where odometry is exact
  if (options.engine != "graph" || options.unknown_ids || map.empty()) return {};
  PoseGraph graph;
  std::vector<Pose2> poses = run.slam.trajectory();
  poses.erase(poses.begin(), poses.end() - static_cast<std::ptrdiff_t>(log.steps.size() + 1));
  graph.nodes.resize(poses.size());
  std::map<std::int64_t, std::uint32_t> points;
  for (const LandmarkEstimate& landmark : map) {
    points.emplace(landmark.id, static_cast<std::uint32_t>(poses.size()));
    poses.push_back({landmark.position, 0.0});
    graph.nodes.push_back({"", {}, true});
  }
  for (std::uint32_t i = 0; i < log.steps.size(); ++i) {
    const LogStep& step = log.steps[i];
    Eigen::Matrix3d covariance = step.covariance;
    covariance.diagonal() = covariance.diagonal().cwiseMax(least_variance);
    graph.edges.push_back({EdgeKind::pose, i, i + 1, step.odometry, covariance.inverse()});
    for (const LandmarkSighting& sighting : step.sightings) {
      const auto point = sighting.id ? points.find(*sighting.id) : points.end();
      if (point == points.end()) continue;
      GraphEdge edge{EdgeKind::point, i + 1, point->second, {sighting.position, 0.0}};
      edge.information.topLeftCorner<2, 2>() = sighting.covariance.inverse();
      const Vec2 off = poses[i + 1].to_local(poses[point->second].position) - sighting.position;
      const Eigen::Vector2d residual(off.x, off.y);
      if (residual.dot(edge.information.topLeftCorner<2, 2>() * residual) <= most_squared)
        graph.edges.push_back(edge);
    }
  }
  return find_systematic_errors(graph, poses);
}

Metrics times_of(const LandmarkMission& run) {
  std::vector<double> sorted = run.times_s;
  std::ranges::sort(sorted);
  double time_s = 0.0;
  for (const double step_s : sorted) time_s += step_s;
  return {{"time_s", time_s}, {"max_step_s", sorted.back()}, {"median_step_s", sorted[sorted.size() / 2]}};
}

std::vector<NamedContent> files_of(const LandmarkMission& run, const LandmarkMap& map) {
  return {{"track.csv", track_csv(run.slam.trajectory())},
          {"landmarks.csv", landmarks_csv(map)},
          {"state.txt", run.slam.state()}};
}

}  // namespace

Status map_landmark_log(const SlamJob& job, LandmarkLog log, Run& run, const RunWatch& watch) {
  const LandmarkSlamOptions options = options_of(job, log);
  const std::size_t logged = log.steps.size();
  LandmarkRecorder recorder(run.log, job.scenario, log);
  const auto mapped = run_log(job, options, log, recorder, watch);
  if (!mapped) return pass_on(mapped);
  const LandmarkMap map = mapped->slam.landmarks();
  const std::string warning = options.unknown_ids ? std::string() : undo_exchange(log, map);
  const MapError error = options.unknown_ids ? map_error_by_place(map, log.true_landmarks, reach_m)
                                             : map_error(map, log.true_landmarks);
  const auto truth = truth_in_map(log, error);
  if (!warning.empty()) run.report.warnings.push_back(warning);
  run.report.metrics = metrics_of(*mapped, map.size(), error);
  run.report.metrics.emplace_back("distance_m",
                                  recorder.settle(mapped->slam, map, truth, !options.unknown_ids));
  run.report.metrics.emplace_back("run_s", recorder.end_s());
  run.report.machine_times = times_of(*mapped);
  judge_landmarks(run.report, run.log, options, *mapped, size_of(log, *mapped, map, options),
                  recorder.times_s());
  if (log.steps.size() < logged) mark_cancelled(run.report, run.log, recorder.end_s());
  run.files = files_of(*mapped, map);
  return {};
}

}  // namespace outrider
