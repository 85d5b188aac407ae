#include "outrider/jobs/guard/yard/firing_map.hpp"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <limits>
#include <queue>

#include "outrider/jobs/guard/plan/plan.hpp"
#include "support/guard_yard.hpp"
#include "support/random_cases.hpp"

namespace outrider {
namespace {

using testing::box_at;
using testing::cases;
using testing::random_guard_problem;

/// True when samples every 4 mm of the segment keep that clearance.
bool sampled_free(const CollisionMap& ground, Vec2 a, Vec2 b, double clearance_m) {
  const int n = static_cast<int>(distance(a, b) / 0.004) + 1;
  for (int i = 0; i <= n; ++i) {
    if (ground.clearance(a + static_cast<double>(i) / n * (b - a), 1.0) < clearance_m) return false;
  }
  return true;
}

/// A flood over the cells whose steps are decided by samples.
std::vector<std::uint8_t> flood(const FiringMap& firing_map, Vec2 start, double clearance_m) {
  const GridFrame& frame = firing_map.frame;
  std::vector<std::uint8_t> seen(frame.size(), 0);
  std::queue<Cell> open;
  const auto visit = [&](Vec2 from, Cell c) {
    if (!frame.contains(c) || seen[frame.index(c)] != 0) return;
    if (!sampled_free(firing_map.ground, from, frame.centre(c), clearance_m)) return;
    seen[frame.index(c)] = 1;
    open.push(c);
  };
  const Cell home = frame.cell_at(start);
  for (int k = 0; k < 25; ++k) visit(start, {home.x + k % 5 - 2, home.y + k / 5 - 2});
  while (!open.empty()) {
    const Cell c = open.front();
    open.pop();
    for (int k = 0; k < 9; ++k) visit(frame.centre(c), {c.x + k % 3 - 1, c.y + k / 3 - 1});
  }
  return seen;
}

TEST(Survey, ReachesWhatASampledFloodReaches) {
  Rng rng(61);
  std::size_t reached = 0;
  std::size_t shut = 0;
  for (int i = 0; i < cases(8); ++i) {
    const auto problem = random_guard_problem(rng, 14, 0, 2.0);
    GuardOptions options;
    options.resolution_m = 0.12 + 0.02 * (i % 4);
    const auto firing_map = build_firing_map(problem, options);
    ASSERT_TRUE(firing_map.has_value()) << firing_map.error().sentence;
    const double radius = problem.robot.radius_m;
    // Between samples the clearance changes by less than the first margin.
    const auto surely = flood(*firing_map, problem.start.position, radius + 2.1e-3);
    const auto perhaps = flood(*firing_map, problem.start.position, radius - 1e-9);
    for (std::size_t c = 0; c < firing_map->frame.size(); ++c) {
      const Vec2 p = firing_map->frame.centre(firing_map->frame.cell(c));
      EXPECT_EQ(firing_map->standable[c] != 0, firing_map->ground.clearance(p, 1.0) >= radius);
      if (surely[c] != 0) {
        EXPECT_EQ(firing_map->reachable[c], 1);
      }
      if (firing_map->reachable[c] == 0) {
        shut += firing_map->standable[c];
        continue;
      }
      ++reached;
      EXPECT_EQ(perhaps[c], 1);
      EXPECT_EQ(firing_map->standable[c], 1);
      // The way home: every step swept free, and an end that the start sees.
      std::size_t at = c;
      std::size_t steps = 0;
      while (firing_map->homeward[at] != at && ++steps < firing_map->frame.size()) {
        const std::size_t next = firing_map->homeward[at];
        ASSERT_EQ(firing_map->reachable[next], 1);
        at = next;
      }
      EXPECT_LT(steps, firing_map->frame.size());
      EXPECT_TRUE(firing_map->ground.segment_free(
          {problem.start.position, firing_map->frame.centre(firing_map->frame.cell(at))}, radius));
    }
  }
  EXPECT_GT(reached, 500U);
  EXPECT_GT(shut, 0U) << "no yard has a place that is shut off";
}

/// A board 0.21 m above the floor with a cat on it, in the middle of a yard.
GuardProblem cat_on_a_table() {
  GuardProblem problem;
  problem.world.name = "table";
  problem.world.bounds = {{-3.0, -3.0}, {3.0, 3.0}};
  problem.world.solids = {testing::floor_at(0.0), box_at("board", {0.0, 0.0, 0.22}, {2.0, 2.0, 0.02})};
  problem.start = {{0.0, -2.5}, radians(90.0)};
  problem.targets.push_back({"cat", {0.0, 0.0, 0.23}, {0.3, 0.3, 0.3}, 0.0});
  return problem;
}

/// The body would fit under the board, which is 0.21 m high; the barrel would be in it.
TEST(Survey, LeavesRoomForTheBarrel) {
  const GuardProblem problem = cat_on_a_table();
  ASSERT_LT(problem.robot.height_m, 0.21);
  ASSERT_GT(barrel_top(problem.gun), 0.23);
  const auto firing_map = build_firing_map(problem, {});
  ASSERT_TRUE(firing_map.has_value()) << firing_map.error().sentence;
  EXPECT_GT(firing_map->regions[0].hits, 100U);
  for (std::size_t c = 0; c < firing_map->frame.size(); ++c) {
    const Vec2 p = firing_map->frame.centre(firing_map->frame.cell(c));
    if (std::max(std::abs(p.x), std::abs(p.y)) >= 1.0 + problem.robot.radius_m) continue;
    if (std::hypot(std::max(0.0, std::abs(p.x) - 1.0), std::max(0.0, std::abs(p.y) - 1.0)) >=
        problem.robot.radius_m)
      continue;
    EXPECT_EQ(firing_map->reachable[c], 0) << p.x << " " << p.y;
    EXPECT_EQ(firing_map->regions[0].pitch[c], FiringRegion::no_shot);
  }
  GuardProblem low = problem;  // a barrel that never rises above the body passes under it
  low.gun.pitch_high_rad = radians(5.0);
  ASSERT_LT(barrel_top(low.gun), 0.2);
  const auto under = build_firing_map(low, {});
  ASSERT_TRUE(under.has_value()) << under.error().sentence;
  EXPECT_EQ(under->reachable[under->frame.index(under->frame.cell_at({0.0, 0.0}))], 1);
}

TEST(Survey, FindsTheRegionsOfTheReachableGroundWhateverTheThreads) {
  Rng rng(62);
  for (int i = 0; i < cases(4); ++i) {
    const auto problem = random_guard_problem(rng, 10, 5, 2.0);
    const auto firing_map = build_firing_map(problem, {.resolution_m = 0.2});
    ASSERT_TRUE(firing_map.has_value()) << firing_map.error().sentence;
    const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
    const auto again = build_firing_map(problem, {.resolution_m = 0.2});
    for (std::size_t t = 0; t < problem.targets.size(); ++t) {
      EXPECT_EQ(firing_map->regions[t].pitch, again->regions[t].pitch);
      EXPECT_EQ(firing_map->regions[t].error_ratio, again->regions[t].error_ratio);
      const auto& region = firing_map->regions[t];
      for (std::size_t c = 0; c < firing_map->frame.size(); ++c) {
        if (region.pitch[c] != FiringRegion::no_shot) {
          EXPECT_EQ(firing_map->reachable[c], 1);
        }
      }
      EXPECT_EQ(region.hits == 0, firing_map->no_shots[t].exhausted.has_value());
    }
  }
}

GuardProblem plain() {
  GuardProblem problem;
  problem.world.bounds = {{-2, -2}, {2, 2}};
  problem.world.solids = {testing::floor_at(0)};
  problem.start = {{0, -1.5}, 0.0};
  problem.targets = {{"cat", {0, 1, 0}, {0.5, 0.2, 0.4}, 0.0}};
  return problem;
}

void expect_refused(const GuardProblem& problem, const GuardOptions& options, FaultCode code,
                    const std::string& where, const std::string& says) {
  const auto firing_map = build_firing_map(problem, options);
  ASSERT_FALSE(firing_map.has_value()) << where << " " << says;
  EXPECT_EQ(firing_map.error().code, code) << firing_map.error().sentence;
  EXPECT_EQ(firing_map.error().where, where) << firing_map.error().sentence;
  EXPECT_NE(firing_map.error().sentence.find(says), std::string::npos) << firing_map.error().sentence;
}

TEST(Survey, RefusesAStartThatIsBlockedOrOutside) {
  GuardProblem problem = plain();
  problem.start.position = {3, 0};
  expect_refused(problem, {}, FaultCode::outside_map, "start", "outside the yard");
  problem.start.position = {-1.9, 0};
  expect_refused(problem, {}, FaultCode::start_blocked, "start", "0.1 m from an obstacle");
  problem = plain();
  problem.world.solids.push_back(box_at("box", {0, -1.5, 0.1}, {0.2, 0.2, 0.2}));
  expect_refused(problem, {}, FaultCode::start_blocked, "start", "start elsewhere");
}

TEST(Survey, RefusesATargetInsideASolidByName) {
  GuardProblem problem = plain();
  problem.world.solids.push_back(box_at("shed", {0, 1, 0.5}, {1, 1, 1}));
  expect_refused(problem, {}, FaultCode::bad_input, "targets", "cat at (0, 1, 0) is inside shed");
}

TEST(Survey, RefusesGridsThatAreEmptyOrTooFine) {
  GuardProblem problem = plain();
  expect_refused(problem, {.resolution_m = 0.005, .memory_mib = 1}, FaultCode::bad_input, "plan.resolution",
                 "1 MiB");
  problem.world.bounds = {{-1e5, -1e5}, {1e5, 1e5}};
  expect_refused(problem, {}, FaultCode::bad_input, "plan.resolution", "MiB");
  problem.world.bounds = {{-1e200, -1e200}, {1e200, 1e200}};
  EXPECT_FALSE(build_firing_map(problem, {}).has_value());
  for (const Box2 none : {Box2{}, Box2{{0, 0}, {0, 0}}, Box2{{1, 1}, {-1, -1}}}) {
    problem.world.bounds = none;
    expect_refused(problem, {}, FaultCode::bad_input, "bounds", "no bounds");
  }
}

/// The centre of a mast of 100 m is out of reach.
TEST(Survey, RefusesToTryAllWhereThatTakesDays) {
  GuardProblem problem = plain();
  problem.targets[0] = {"mast", {0, 1, 0}, {0.5, 0.5, 100.0}, 0.0};
  const GuardOptions fine = {.resolution_m = 0.01, .pitch_step_rad = radians(0.5), .aim_step_m = 0.005};
  expect_refused(problem, fine, FaultCode::bad_input, "plan.aim_step", "e+13 flights");
  expect_refused(problem, fine, FaultCode::bad_input, "plan.aim_step", "1.6e+05 places");
  EXPECT_TRUE(build_firing_map(problem, fine, {}, RegionSearch::centres_only));
  EXPECT_TRUE(build_firing_map(problem, {.resolution_m = 0.2}));
}

TEST(Survey, RefusesNumbersThatAreNoneOrOutOfRange) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double inf = std::numeric_limits<double>::infinity();
  for (const double bad : {nan, inf, -inf}) {
    GuardProblem problem = plain();
    problem.start.position.x = bad;
    EXPECT_FALSE(build_firing_map(problem, {}).has_value());
    problem = plain();
    problem.start.heading_rad = bad;
    EXPECT_FALSE(build_firing_map(problem, {}).has_value());
    problem = plain();
    problem.targets[0].base.z = bad;
    EXPECT_FALSE(build_firing_map(problem, {}).has_value());
    problem = plain();
    problem.targets[0].yaw_rad = bad;
    EXPECT_FALSE(build_firing_map(problem, {}).has_value());
    problem = plain();
    problem.world.gravity_mps2 = bad;
    EXPECT_FALSE(build_firing_map(problem, {}).has_value());
    problem = plain();
    problem.world.bounds.high.x = bad;
    EXPECT_FALSE(build_firing_map(problem, {}).has_value());
    problem = plain();
    problem.robot.radius_m = bad;
    expect_refused(problem, {}, FaultCode::bad_input, "robot.radius", "expected a number");
    problem = plain();
    problem.gun.muzzle_speed_mps = bad;
    expect_refused(problem, {}, FaultCode::bad_input, "gun.muzzle_speed", "expected a number");
    EXPECT_FALSE(build_firing_map(plain(), {.resolution_m = bad}).has_value());
    EXPECT_FALSE(build_firing_map(plain(), {.pitch_step_rad = bad}).has_value());
  }
  GuardProblem problem = plain();
  problem.robot.radius_m = 0.2;
  expect_refused(problem, {}, FaultCode::bad_input, "robot.radius", "0.2584 m from the yaw axis");
  problem = plain();
  problem.targets[0].size.y = 0.0;
  EXPECT_FALSE(build_firing_map(problem, {}).has_value());
  problem = plain();
  problem.world.gravity_mps2 = 0.0;
  EXPECT_FALSE(build_firing_map(problem, {}).has_value());
  EXPECT_FALSE(build_firing_map(plain(), {.resolution_m = 0.0}).has_value());
  EXPECT_FALSE(build_firing_map(plain(), {.resolution_m = -0.1}).has_value());
  EXPECT_FALSE(build_firing_map(plain(), {.aim_step_m = 0.0}).has_value());
  EXPECT_TRUE(build_firing_map(plain(), {}).has_value());
}

TEST(GuardOptionsText, DescribeEveryMemberWithinItsRange) {
  GuardOptions options;
  ExecutionErrors errors;
  EXPECT_EQ(describe(options).size(), 12U);
  EXPECT_EQ(describe(errors).size(), 5U);
  for (const auto& list : {describe(options), describe(errors)}) {
    for (const Option& option : list) EXPECT_TRUE(assign(option, value_text(option))) << option.name;
  }
}

/// A cat behind another one can be hit only when targets do not block.
TEST(Survey, TargetsBlockShotsAndDrivingOnlyWhenTold) {
  GuardProblem problem = plain();
  problem.targets[0] = {"hidden", {0, 1.6, 0}, {0.2, 0.2, 0.3}, 0.0};
  for (const double x : {-0.25, 0.25}) {
    problem.targets.push_back({"side", {x, 1.6, 0}, {0.28, 0.7, 3.0}, 0.0});
  }
  problem.targets.push_back({"front", {0, 1.0, 0}, {0.8, 0.2, 3.0}, 0.0});
  problem.targets.push_back({"back", {0, 1.9, 0}, {0.8, 0.1, 3.0}, 0.0});
  const auto open = build_firing_map(problem, {.resolution_m = 0.2});
  ASSERT_TRUE(open.has_value());
  problem.targets_block = true;
  const auto blocked = build_firing_map(problem, {.resolution_m = 0.2});
  ASSERT_TRUE(blocked.has_value()) << blocked.error().sentence;
  EXPECT_GT(open->regions[0].hits, 0U);
  EXPECT_EQ(blocked->regions[0].hits, 0U);
  EXPECT_GT(blocked->regions[3].hits, 0U) << "a target does not block itself";
  const Cell on_front = open->frame.cell_at({0.1, 1.1});
  EXPECT_EQ(open->standable[open->frame.index(on_front)], 1);
  EXPECT_EQ(blocked->standable[open->frame.index(on_front)], 0);
  EXPECT_EQ(blocked->spaces.size(), problem.targets.size());
  problem.start.position = {0.0, 0.7};
  EXPECT_EQ(build_firing_map(problem, {}).error().code, FaultCode::start_blocked);
}

/// A quicker survey leaves out the exhaustive search and what it finds, and nothing else.
TEST(Survey, WithoutProofsHasTheSameRegionsOfCentres) {
  Rng rng(95);
  int left_out = 0;
  for (int i = 0; i < testing::cases(3); ++i) {
    GuardProblem problem = testing::random_guard_problem(rng, 6, 4, 2.0);
    problem.targets[0].base.z = 8.0;
    if (i == 0) problem.air = {0.02, 1.0, 0.5};
    GuardOptions options = testing::quick();
    options.resolution_m = 0.4;
    options.pitch_step_rad = radians(7.5);
    const auto proven = build_firing_map(problem, options);
    const auto centres = build_firing_map(problem, options, {}, RegionSearch::centres_only);
    const auto none = build_firing_map(problem, options, {}, RegionSearch::none);
    ASSERT_TRUE(proven && centres && none);
    EXPECT_EQ(proven->reachable, none->reachable);
    EXPECT_EQ(proven->standable, none->standable);
    ASSERT_EQ(none->regions.size(), problem.targets.size());
    for (std::size_t t = 0; t < problem.targets.size(); ++t) {
      EXPECT_EQ(none->regions[t].hits, 0U);
      EXPECT_FALSE(centres->no_shots[t].exhausted.has_value());
      if (centres->regions[t].hits == 0) {
        ++left_out;
        continue;
      }
      EXPECT_EQ(proven->regions[t].pitch, centres->regions[t].pitch);
      EXPECT_EQ(proven->regions[t].error_ratio, centres->regions[t].error_ratio);
      EXPECT_FALSE(proven->no_shots[t].exhausted.has_value());
    }
    EXPECT_TRUE(proven->no_shots[0].exhausted.has_value());
  }
  EXPECT_GT(left_out, 0);
}

}  // namespace
}  // namespace outrider
