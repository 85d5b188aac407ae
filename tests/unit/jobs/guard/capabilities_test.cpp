#include "outrider/jobs/guard/capabilities.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "outrider/jobs/guard/catalog.hpp"
#include "outrider/jobs/guard/job.hpp"
#include "outrider/jobs/guard/run/robot.hpp"
#include "support/random_terrain.hpp"
#include "support/random_yard.hpp"

namespace outrider {
namespace {

/// Another planner, as programs add them.
[[maybe_unused]] const bool added = [] {
  add_guard_planner({"best_tour_again", "The same under another name.", "none", plan_guard});
  return true;
}();

constexpr std::size_t all = static_cast<std::size_t>(Capability::proof) + 1;
constexpr auto first = static_cast<std::size_t>(Capability::arrivals);  // of those that a scenario asks for

Capability at(std::size_t index) { return static_cast<Capability>(index); }

const Clash* clash_of(Capability a, Capability b) {
  for (const Clash& clash : clashes()) {
    if ((clash.one == a && clash.other == b) || (clash.one == b && clash.other == a)) return &clash;
  }
  return nullptr;
}

TEST(Capabilities, TheTablesAreComplete) {
  ASSERT_EQ(capabilities().size(), all);
  std::set<std::string_view> keys, nouns;
  for (std::size_t i = 0; i < all; ++i) {
    const CapabilityRow& row = capabilities()[i];
    EXPECT_EQ(row.capability, at(i));
    EXPECT_EQ(row.key.empty(), i < first) << row.noun;
    EXPECT_TRUE(row.key.empty() || row.key == "sim" || keys.insert(row.key).second) << row.key;
    EXPECT_TRUE(nouns.insert(row.noun).second) << row.noun;
    EXPECT_FALSE(row.noun.empty());
  }
  std::set<std::pair<Capability, Capability>> pairs;
  for (const Clash& clash : clashes()) {
    EXPECT_LT(static_cast<int>(clash.one), static_cast<int>(clash.other)) << clash.why;
    EXPECT_TRUE(pairs.emplace(clash.one, clash.other).second) << clash.why << " is there twice";
    EXPECT_FALSE(clash.why.empty());
  }
}

TEST(Capabilities, EachIsAskedForByAKeyThatExists) {
  GuardScenario scenario;
  std::set<std::string> known;
  for (const OptionGroup& group : describe(scenario)) {
    known.insert(group.name);
    for (const Option& option : group.options) {
      known.insert(group.name.empty() ? option.name : group.name + "." + option.name);
    }
  }
  for (const CapabilityRow& row : capabilities())
    EXPECT_TRUE(row.key.empty() || known.contains(std::string(row.key))) << row.key;
}

TEST(Capabilities, ARefusalNamesBothKeysAndTheReason) {
  EXPECT_TRUE(check_capabilities({}));
  for (std::size_t i = 0; i < all; ++i) {
    EXPECT_TRUE(check_capabilities({at(i)})) << capabilities()[i].key;
    for (std::size_t k = i + 1; k < all; ++k) {
      const CapabilityRow& one = capabilities()[i];
      const CapabilityRow& other = capabilities()[k];
      const Clash* const clash = clash_of(at(i), at(k));
      for (const auto& asked : {std::vector{at(i), at(k)}, std::vector{at(k), at(i)}}) {
        const auto checked = check_capabilities(asked);
        EXPECT_EQ(checked.has_value(), clash == nullptr) << one.key << " and " << other.key;
        if (checked || clash == nullptr) continue;
        EXPECT_EQ(checked.error().code, FaultCode::bad_input);
        EXPECT_EQ(checked.error().where, other.key);
        for (const std::string_view part : {one.noun, other.noun, one.key, other.key, clash->why}) {
          EXPECT_NE(checked.error().sentence.find(part), std::string::npos)
              << checked.error().sentence << " does not say " << part;
        }
      }
    }
  }
}

/// A room of 4 x 3 m with a low wall and two targets, coarse enough for a mission in milliseconds.
void fill_in(GuardScenario& scenario) {
  using testing::box_at;
  GuardProblem& problem = scenario.problem;
  problem.world.name = "room";
  problem.world.solids = {
      testing::floor_at(0),
      box_at("south", {2, -0.05, 0.5}, {4.2, 0.1, 1}),
      box_at("north", {2, 3.05, 0.5}, {4.2, 0.1, 1}),
      box_at("west", {-0.05, 1.5, 0.5}, {0.1, 3.2, 1}),
      box_at("east", {4.05, 1.5, 0.5}, {0.1, 3.2, 1}),
      box_at("bench", {2.1, 1.6, 0.2}, {0.6, 0.1, 0.4}),
  };
  problem.world.bounds = {{0, 0}, {4, 3}};
  problem.start = {{0.9, 0.8}, 0.0};
  problem.errors.position_m = 0.02;
  problem.targets = {{"cat", {3.2, 0.7, 0}, {0.4, 0.3, 0.4}}, {"fox", {3.1, 2.4, 0}, {0.4, 0.3, 0.4}}};
  problem.tries = 2;
  scenario.options.resolution_m = 0.3;
  scenario.options.pitch_step_rad = radians(7.5);
  scenario.options.stops = 20;
  scenario.options.refinements = 0;
  scenario.options.iterations = 20;
}

void ask_for(GuardScenario& scenario, Capability capability) {
  GuardProblem& problem = scenario.problem;
  switch (capability) {
    case Capability::arrivals:
      scenario.arrivals.count = 3;
      scenario.arrivals.rate_hz = 0.3;
      scenario.intruders = draw_arrivals(problem, {{"gate", {0.3, 2.7}}}, scenario.arrivals, 1).value();
      break;
    case Capability::survivors: scenario.arrivals.leave = 0.7; break;
    case Capability::walkers:
      scenario.wander.speed_mps = 0.4;
      scenario.wander.rest_s = 3.0;
      scenario.wander.chance = 0.3;
      scenario.preferences = {1.0, 1.0};
      break;
    case Capability::supplies:
      problem.supplies.tank = 1.0;
      problem.supplies.battery_wh = 2.0;
      problem.supplies.stations = {{"pump", {0.9, 1.6}, true, true}};
      break;
    case Capability::terrain: {
      const auto slope = [](Vec2 p) { return 0.06 * p.x; };
      problem.world = problem.world.on(
          std::make_shared<const HeightField>(testing::terrain_of({-1, -1}, {0.5, 0.5}, 13, 11, slope)));
      for (Target& target : problem.targets) target.base.z = slope(xy(target.base));
      break;
    }
    case Capability::air: problem.air = {0.02, 0.5, 1.0}; break;
    case Capability::unknown: scenario.scout.unknown = true; break;
    case Capability::rigid: scenario.sim = "physics"; break;
    case Capability::navigated: scenario.sim = "navigator"; break;
    case Capability::blocking: problem.targets_block = true; break;
    case Capability::faults: scenario.faults.position_ratio = 1.5; break;
    case Capability::held_up: scenario.faults.way.kidnapping = {1.0, 0.3, 0.5}; break;
    case Capability::team: scenario.robots = 2; break;
    case Capability::planner: scenario.options.planner = "best_tour_again"; break;
    case Capability::proof: scenario.options.prove = true; break;
    case Capability::own_robot:
    case Capability::topics: FAIL() << "no simulated mission";
  }
}

/// Every pair that is not in the table, and each capability alone, really runs to an honest end.
TEST(Capabilities, WhatIsAcceptedRuns) {
  int runs = 0;
  for (std::size_t i = first; i + 1 < all; ++i) {
    for (std::size_t k = i; k + 1 < all; ++k) {
      if (i != k && clash_of(at(i), at(k)) != nullptr) continue;
      SCOPED_TRACE(std::string(capabilities()[i].key) + " and " + std::string(capabilities()[k].key));
      GuardJob job;
      fill_in(job.scenario);
      ask_for(job.scenario, at(i));
      if (i != k) ask_for(job.scenario, at(k));
      ASSERT_EQ(requested_capabilities(job.scenario),
                i == k ? std::vector{at(i)} : (std::vector{at(i), at(k)}));
      if (job.scenario.sim == "physics" && !make_rigid_world(rigid_scene(job.scenario.problem)))
        continue;  // no engine
      outrider::Run run;
      const auto done = job.run(run, {});
      ASSERT_TRUE(done) << to_string(done.error());
      ++runs;
      const Report& report = run.report;
      EXPECT_TRUE(report.status == "done" || (report.status == "not_done" && !report.reason.empty()))
          << report.status << ": " << report.reason;
      EXPECT_GT(metric(report, "reached"), 0.0) << report.reason;
      const Table& targets = table_named(report, "targets");
      EXPECT_EQ(targets.rows.size(), at(i) == Capability::arrivals ? 3U : 2U);
      for (const auto& values : targets.rows) {
        const TableRow target{targets, values};
        const std::string& status = target.text("status");
        EXPECT_TRUE(status == "reached" || status == "failed" || status == "unreachable")
            << target.text("name") << " is " << status;
      }
    }
  }
  EXPECT_GE(runs, 25);
}

}  // namespace
}  // namespace outrider
