// Whole missions: the yard that comes with the project, and the two of the reference report.
#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>

#include "outrider/job/run_job.hpp"
#include "outrider/jobs/guard/job.hpp"
#include "outrider/jobs/guard/run/run.hpp"
#include "support/costly_cases.hpp"
#include "support/fine_flight.hpp"
#include "support/guard_runs.hpp"
#include "support/logged_targets.hpp"
#include "support/run_bytes.hpp"

namespace outrider {
namespace {

struct Mission {
  GuardScenario scenario;
  std::optional<FiringMap> firing_map;
  GuardPlan plan;

  [[nodiscard]] Run run(std::uint64_t seed) const {
    return testing::run_still(scenario.problem, *firing_map, plan, scenario.options, seed);
  }
};

Mission prepared(GuardScenario scenario) {
  Mission mission{std::move(scenario), {}, {}};
  auto warnings = load_problem(mission.scenario);
  EXPECT_TRUE(warnings.has_value()) << to_string(warnings.error());
  mission.scenario.options.gap = 1.0;  // the bound of the tour has tests of its own
  auto firing_map = build_firing_map(mission.scenario.problem, mission.scenario.options);
  EXPECT_TRUE(firing_map.has_value()) << to_string(firing_map.error());
  auto plan = plan_guard(mission.scenario.problem, *firing_map, mission.scenario.options, {});
  EXPECT_TRUE(plan.has_value()) << to_string(plan.error());
  mission.firing_map = std::move(*firing_map);
  mission.plan = std::move(*plan);
  return mission;
}

/// The bundled yard; 0: on ground as fine as the scenario has it.
Mission our_yard(double resolution_m = 0.0) {
  GuardJob job;
  const auto read = read_scenario(job, std::string(OUTRIDER_SOURCE_DIR) + "/scenarios/yard/yard.yaml");
  EXPECT_TRUE(read.has_value()) << to_string(read.error());
  if (resolution_m > 0.0) job.scenario.options.resolution_m = resolution_m;
  return prepared(std::move(job.scenario));
}

/// Flies every shot of a run again, in small steps; the contact must be where the log says.
void expect_replays(const Mission& mission, const Run& run) {
  const GuardProblem& problem = mission.scenario.problem;
  for (const auto& [time_ns, shot] : testing::shots_of(run.log)) {
    const auto target = std::find_if(problem.targets.begin(), problem.targets.end(),
                                     [&](const Target& t) { return t.name == shot.target; });
    ASSERT_NE(target, problem.targets.end());
    const auto index = static_cast<std::size_t>(target - problem.targets.begin());
    const Solid box = solid_of(*target);
    const auto& solids = mission.firing_map->space(index).solids();
    const auto end = testing::fly_fine(testing::vec3_of(shot.muzzle), testing::vec3_of(shot.velocity),
                                       problem.world.gravity_mps2, problem.gun.ball_radius_m, solids, &box,
                                       problem.world.floor_z_m - 1.0);
    EXPECT_EQ(end.hit, shot.hit) << shot.target;
    EXPECT_EQ(shot.contact, end.hit ? shot.target : solids[end.solid.value()].name);
    // A step is 0.2 mm; along a face that is grazed it takes a few more.
    EXPECT_LT(norm(end.position - testing::vec3_of(shot.contact_point)), 2e-3) << shot.target;
  }
  // The robot fitted wherever it was.
  for (const Pose2& pose : poses_of(run.log)) {
    ASSERT_GE(mission.firing_map->ground.clearance(pose.position, 1.0), problem.robot.radius_m - 2e-9);
  }
}

void expect_counts(const Run& run, double reached, double unreachable) {
  EXPECT_EQ(metric(run, "reached"), reached);
  EXPECT_EQ(metric(run, "failed"), 0.0);
  EXPECT_EQ(metric(run, "unreachable"), unreachable);
  EXPECT_EQ(run.report.status, "done");
  EXPECT_EQ(testing::targets_of(run.log).size(), static_cast<std::size_t>(reached + unreachable));
  EXPECT_LE(metric(run, "lower_bound_s"), metric(run, "expected_s") + 1e-9);
}

TEST(OurYard, IsGuardedButForTheCatInTheShed) {
  const Mission mission = our_yard();
  const auto run = mission.run(static_cast<std::uint64_t>(mission.scenario.seed));
  expect_counts(run, 23, 1);
  expect_replays(mission, run);
  for (const testing::LoggedTarget& target : testing::targets_of(run.log)) {
    EXPECT_EQ(target.status == "unreachable", target.name == "schroedi") << target.name;
    if (target.name == "schroedi") {
      EXPECT_NE(target.reason.find("shed"), std::string::npos) << target.reason;
    }
  }
}

TEST(OurYard, GivesTheSameBytesWithOneThreadAndTwo) {
  if (!testing::in_full()) GTEST_SKIP() << "two missions like the one above, on coarser ground";
  const auto bytes_with = [](std::size_t most_threads) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, most_threads);
    return test::bytes_of_run(our_yard(0.2).run(7));
  };
  EXPECT_EQ(bytes_with(1), bytes_with(2));
}

class ReferenceWorld : public ::testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(Worlds, ReferenceWorld, ::testing::Values("by_small", "by_small2"),
                         [](const auto& world) { return std::string(world.param); });

TEST_P(ReferenceWorld, LosesNoTargetWhateverTheSeed) {
  const char* const given = std::getenv("OUTRIDER_DATA");
  const std::string data = given != nullptr ? given : std::string(OUTRIDER_SOURCE_DIR) + "/../shared/data";
  GuardScenario scenario;
  scenario.world = data + "/guard/worlds/" + GetParam() + ".sdf";
  scenario.targets = data + "/guard/goals_params.txt";
  scenario.start = "0,-9.5,90";
  if (!std::filesystem::exists(scenario.world))
    GTEST_SKIP() << "no " << scenario.world << "; set OUTRIDER_DATA";
  const Mission mission = prepared(scenario);
  EXPECT_TRUE(mission.plan.unreachable.empty());
  for (int seed = 1; seed <= testing::costly_cases(2); ++seed) {
    const auto run = mission.run(static_cast<std::uint64_t>(seed));
    expect_counts(run, 24, 0);
    expect_replays(mission, run);
    RecordProperty("mission_s_" + std::to_string(seed), std::to_string(metric(run, "mission_s")));
  }
}

}  // namespace
}  // namespace outrider
