#include "slam_command.hpp"

#include <algorithm>
#include <memory>

#include "commands.hpp"
#include "flags.hpp"
#include "outrider/io/scenario.hpp"
#include "scenario_words.hpp"
#include "slam_graph.hpp"
#include "slam_input.hpp"
#include "slam_landmarks.hpp"
#include "slam_laser.hpp"

namespace outrider::cli {
namespace {

OptionGroup describe_input(SlamJob& job) {
  return {"", "input", {{"resume", "", 0, 0, "state of an earlier run to continue from", &job.resume}}};
}

/// Which of the options that a log may choose for itself the file chooses.
Status note_choices(SlamJob& job) {
  if (job.scenario_path.empty()) return {};
  const auto keys = scenario_keys(job.scenario_path);
  if (!keys) return tl::unexpected<Fault>(keys.error());
  job.chose_gate |= std::ranges::count(*keys, "slam.gate") > 0;
  job.chose_patience |= std::ranges::count(*keys, "slam.patience") > 0;
  return {};
}

int finish(SlamJob& job) {
  if (auto ok = check(job.scenario); !ok) return say(ok.error(), job.json);
  if (auto ok = note_choices(job); !ok) return say(ok.error(), job.json);
  if (job.html) {
    if (auto ok = check_page("--html"); !ok) return say(ok.error(), job.json);
  }
  const SlamScenario& scenario = job.scenario;
  auto input = load_slam_input(scenario.log, scenario.truth, scenario.noise, scenario.carmen);
  if (!input) return say(input.error(), job.json);
  if (auto* graph = std::get_if<GraphInput>(&*input)) return solve_graph(job, std::move(*graph));
  if (const auto* log = std::get_if<LaserLog>(&*input)) return map_laser_log(job, *log);
  return map_landmark_log(job, std::move(std::get<LandmarkLog>(*input)));
}

int execute(SlamJob& job, const Command& flags) {
  tell_scenario_from_file(job.log, job.scenario_path, "slam");
  if (auto ok = read_job_words(flags, job); !ok) return say(ok.error(), flags.given("--json"));
  if (auto ok = apply_flags(flags, {describe_input(job)}); !ok) return say(ok.error(), job.json);
  if (!job.log.empty()) job.scenario.log = job.log;
  job.chose_gate = flags.given("--slam-gate");
  job.chose_patience = flags.given("--slam-patience");
  return finish(job);
}

}  // namespace

int run_slam_scenario(const std::string& path, const Command& flags) {
  SlamJob job;
  job.scenario_path = path;
  if (auto ok = read_run_words(flags, path, "slam", job); !ok) return say(ok.error(), flags.given("--json"));
  return finish(job);
}

void add_slam(Command& tool) {
  Command& slam = tool.add("slam", "localise and map from a recorded log, or solve a pose graph");
  auto job = std::make_shared<SlamJob>();
  slam.positional("file", &job->log,
                  "laser log, landmark log, g2o graph or PyFG graph, may be gzip-compressed, or a scenario; "
                  "docs/jobs/slam.md")
      .type("FILE");
  slam.option("--scenario", &job->scenario_path, "scenario file to start from; flags win over it")
      .type("FILE");
  std::vector<OptionGroup> groups = describe(job->scenario);
  groups.insert(groups.begin(), {describe_output(*job), describe_input(*job)});
  add_flags(slam, groups);
  slam.does([job](const Command& flags) { return execute(*job, flags); });
  slam.footer("\nExample: outrider slam scenarios/slam/yard.g2o --out out");
}

}  // namespace outrider::cli
