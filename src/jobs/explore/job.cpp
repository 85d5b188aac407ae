#include "outrider/jobs/explore/job.hpp"

#include "outrider/io/log/trajectory.hpp"
#include "outrider/io/map/map_server.hpp"
#include "outrider/jobs/explore/run.hpp"
#include "summary.hpp"

namespace outrider {
namespace {

/// Wheels that count right, and are believed.
void make_pose_perfect(ExploreSetup& setup) {
  setup.task.slam.trust_odometry = true;
  setup.sim.wheels.scale_error = 0.0;
  setup.sim.wheels.noise_m = 0.0;
}

}  // namespace

Outcome<Warnings> ExploreJob::load() {
  auto loaded = load_explore(scenario);
  if (!loaded) return pass_on(loaded);
  setup = std::move(*loaded);
  if (scenario.perfect_pose) make_pose_perfect(*setup);
  return std::exchange(setup->warnings, {});
}

Status ExploreJob::run(Run& run, const RunWatch& watch) {
  RunSteps steps(watch, 1);
  if (auto ok = steps.next("exploring"); !ok) return ok;
  auto explored = run_explore(setup->world, setup->task, setup->sim,
                              static_cast<std::uint64_t>(scenario.seed), run.log, steps.inner());
  if (!explored) return pass_on(explored);
  run.report = std::move(explored->report);
  auto map = map_server_text({explored->map, 0.0}, "map.pgm");
  if (!map) return pass_on(map);
  run.files = {{"track.csv", track_csv(explored->track)},
               {"map.pgm", std::move(map->image)},
               {"map.yaml", std::move(map->yaml)}};
  return {};
}

Job explore_job() {
  return {
      .name = "explore",
      .sentence = "Map an unknown world to the last reachable cell, then come home.",
      .example = "explore scenarios/explore/office.yaml --out out",
      .blank = [] { return std::make_unique<ExploreJob>(); },
      .file_option = "world",
      .file_sentence = "world to explore: SDF, map_server YAML, PGM or PNG image, slices CSV; or a scenario",
      .aliases = {{"planner", "explore.strategy"}},
      .summary = explore_summary};
}

}  // namespace outrider
