#include "outrider/jobs/slam/job.hpp"

#include "faults/spoil.hpp"
#include "faults/truth.hpp"
#include "input.hpp"
#include "outrider/io/log/log_file.hpp"
#include "recordings.hpp"
#include "slam_log.hpp"
#include "summary.hpp"

namespace outrider {
namespace {

RecordingKind kind_of(const SlamInput& input) {
  if (std::holds_alternative<LaserLog>(input)) return RecordingKind::laser;
  return std::holds_alternative<LandmarkLog>(input) ? RecordingKind::landmarks : RecordingKind::graph;
}

/// Spoils a log, and returns the number of changes.
template <class Recording>
Outcome<std::size_t> spoil(Recording& recording, const SlamScenario& scenario) {
  auto result = spoiled(recording, scenario.faults, Rng(static_cast<std::uint64_t>(scenario.seed)));
  if (!result) return pass_on(result);
  recording = std::move(result->recording);
  return result->changes;
}

/// Spoils a graph. If nothing is known of its true poses, they are those that it gives without the faults.
template <class Pose>
Outcome<std::size_t> spoil(GraphInput<Pose>& input, const SlamScenario& scenario) {
  if (input.truth.empty()) {
    auto solution = optimise(input.graph, scenario.graph, {});
    if (!solution) return pass_on(solution);
    input.truth = std::move(solution->poses);
  }
  return spoil(input.graph, scenario);
}

}  // namespace

struct SlamJob::Input {
  SlamInput value = {};
  TopicsInput topics = {};  ///< a log of ROS topics instead
  bool has_topics = false;
  std::optional<KnownMap> map = {};
  LaserLog recorded = {};   ///< a laser log as it was before the faults, if there are some
  std::size_t changes = 0;  ///< that the faults made
};

SlamJob::SlamJob() : JobTask("slam") {}
SlamJob::~SlamJob() = default;

void SlamJob::take_mount(const std::optional<Pose2>& robot_T_laser) {
  const bool is_given = given.contains("laser.laser_x") || given.contains("laser.laser_y") ||
                        given.contains("laser.laser_heading");
  if (!is_given) scenario.laser.robot_T_laser = robot_T_laser.value_or(scenario.laser.robot_T_laser);
}

Outcome<Warnings> SlamJob::load() {
  if (auto ok = check(scenario); !ok) return pass_on(ok);
  if (is_log_file(scenario.log)) {
    if (scenario.faults.any()) {
      return bad_input("a log of ROS is mapped while it is read and is not spoiled; leave the section out",
                       "faults");
    }
    auto topics = open_laser_topics(scenario.log, scenario.topics);
    if (!topics) return pass_on(topics);
    take_mount((*topics)->robot_T_laser());
    input_ = std::make_unique<Input>(Input{.topics = std::move(*topics), .has_topics = true});
    return load_map();
  }
  auto input = load_slam_input(scenario);
  if (!input) return pass_on(input);
  if (const auto* log = std::get_if<LaserLog>(&*input)) take_mount(log->robot_T_laser);
  input_ = std::make_unique<Input>(Input{.value = std::move(*input)});
  if (auto ok = spoil_input(); !ok) return pass_on(ok);
  return load_map();
}

Status SlamJob::spoil_input() {
  if (!scenario.faults.any()) return {};
  SlamInput& input = input_->value;
  if (auto ok = check(scenario.faults, kind_of(input)); !ok) return ok;
  if (const auto* log = std::get_if<LaserLog>(&input)) input_->recorded = *log;
  const bool ignores_ids = std::holds_alternative<LandmarkLog>(input) && scenario.landmarks.unknown_ids;
  if (ignores_ids && scenario.faults.wrong_ids > 0.0)
    return bad_input("slam.unknown_ids ignores the ids; leave out one of the two", "faults.wrong_ids");
  auto changes = std::visit([&](auto& recording) { return spoil(recording, scenario); }, input);
  if (!changes) return pass_on(changes);
  input_->changes = *changes;
  return {};
}

Outcome<Warnings> SlamJob::load_map() {
  if (scenario.map.empty()) return Warnings{};
  auto map = load_known_map(scenario.map);
  if (!map) return pass_on(map);
  if (!input_->has_topics && !std::holds_alternative<LaserLog>(input_->value))
    return bad_input("only the robot of a laser log is localised on a map; leave it out", "map");
  input_->map = std::move(*map);
  return Warnings{};
}

Status SlamJob::run(Run& run, const RunWatch& watch) {
  auto done = map_or_localise(run, watch);
  if (done && scenario.faults.any()) judge_by_truth(run.report, input_->changes);
  return done;
}

Status SlamJob::map_or_localise(Run& run, const RunWatch& watch) {
  SlamInput& input = input_->value;
  run.report.status = "done";
  run.report.world_name = name_of(scenario);
  if (input_->has_topics) {
    return input_->map ? localise_laser_topics(*this, std::move(input_->topics), *input_->map, run, watch)
                       : map_laser_topics(*this, std::move(input_->topics), run, watch);
  }
  if (const auto* graph = std::get_if<GraphInput<Pose2>>(&input))
    return solve_graph(*this, *graph, run, watch);
  if (const auto* graph = std::get_if<GraphInput<Pose3>>(&input))
    return solve_graph(*this, *graph, run, watch);
  if (const auto* log = std::get_if<LaserLog>(&input)) {
    return input_->map ? localise_laser_log(*this, *log, *input_->map, run, watch)
                       : map_laser_log(*this, *log, input_->recorded, run, watch);
  }
  return map_landmark_log(*this, std::get<LandmarkLog>(input), run, watch);
}

Job slam_job() {
  return {.name = "slam",
          .sentence = "Map from a recorded log, localise on a known map, or solve a pose graph.",
          .example = "slam scenarios/slam/yard.g2o --out out",
          .blank = [] { return std::make_unique<SlamJob>(); },
          .file_option = "log",
          .file_sentence =
              "ROS bag or MCAP, laser log, landmark log, g2o, TORO or PyFG graph, may be gzip-compressed, or "
              "a scenario; docs/jobs/slam.md",
          .summary = slam_summary};
}

}  // namespace outrider
