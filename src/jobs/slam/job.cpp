#include "outrider/jobs/slam/job.hpp"

#include "input.hpp"
#include "outrider/io/log_file.hpp"
#include "recordings.hpp"
#include "slam_log.hpp"
#include "summary.hpp"

namespace outrider {

struct SlamJob::Input {
  SlamInput value = {};
  TopicsInput topics = {};  ///< a log of ROS topics instead
  bool has_topics = false;
  std::optional<KnownMap> map = {};
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
  return load_map();
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
                       : map_laser_log(*this, *log, run, watch);
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
