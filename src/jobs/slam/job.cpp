#include "outrider/jobs/slam/job.hpp"

#include "input.hpp"
#include "recordings.hpp"
#include "slam_log.hpp"
#include "summary.hpp"

namespace outrider {

struct SlamJob::Input {
  SlamInput value;
};

SlamJob::SlamJob() : JobTask("slam") {}
SlamJob::~SlamJob() = default;

Outcome<Warnings> SlamJob::load() {
  if (auto ok = check(scenario); !ok) return pass_on(ok);
  auto input = load_slam_input(scenario.log, scenario.truth, scenario.noise, scenario.carmen);
  if (!input) return pass_on(input);
  input_ = std::make_unique<Input>(Input{std::move(*input)});
  return Warnings{};
}

Status SlamJob::run(Run& run, const RunWatch& watch) {
  SlamInput& input = input_->value;
  run.report.status = "done";
  run.report.world_name = name_of(scenario);
  if (auto* graph = std::get_if<GraphInput>(&input)) return solve_graph(*this, *graph, run, watch);
  if (const auto* log = std::get_if<LaserLog>(&input)) return map_laser_log(*this, *log, run, watch);
  return map_landmark_log(*this, std::get<LandmarkLog>(input), run, watch);
}

Job slam_job() {
  return {.name = "slam",
          .sentence = "Localise and map from a recorded log, or solve a pose graph.",
          .example = "slam scenarios/slam/yard.g2o --out out",
          .blank = [] { return std::make_unique<SlamJob>(); },
          .file_option = "log",
          .file_sentence =
              "laser log, landmark log, g2o graph or PyFG graph, may be gzip-compressed, or a "
              "scenario; docs/jobs/slam.md",
          .summary = slam_summary};
}

}  // namespace outrider
