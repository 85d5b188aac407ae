#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <set>

#include "outrider/jobs/guard/run/run.hpp"
#include "outrider/log/topics.hpp"
#include "outrider/tour/sequence.hpp"
#include "support/guard_runs.hpp"
#include "support/logged_targets.hpp"
#include "support/planned_yard.hpp"
#include "support/random_cases.hpp"
#include "support/run_bytes.hpp"

namespace outrider {
namespace {

using testing::ArrivalsYard;
using testing::cases;
using testing::quick;
using testing::random_arrivals_yard;
using testing::random_guard_problem;

/// A random yard in which everybody can be hit.
ArrivalsYard yard_without_loss(Rng& rng, std::size_t targets, bool with_errors) {
  for (;;) {
    ArrivalsYard yard = random_arrivals_yard(rng, 6, targets, with_errors);
    const auto& reachable = yard.precomputed.reachable;
    if (std::ranges::all_of(reachable, [](char r) { return r != 0; })) return yard;
  }
}

Run survivors_run(const ArrivalsYard& yard, std::uint64_t seed) {
  const auto watch = arrival_yard(yard.problem, yard.firing_map, settled_intruders(yard.problem));
  const ReplanPolicy policy = replan_policies()[seed % 3];
  return testing::run_arrivals({watch, yard.precomputed, policy, ArrivalObjective::makespan, 3, 10}, quick(),
                               seed, {yard.options.leave, yard.options.walk_mps});
}

TEST(Survivors, AreHitUntilTheyLeaveAndRepeat) {
  Rng rng(61);
  std::size_t survived = 0;
  for (int y = 0; y < cases(4); ++y) {
    ArrivalsYard yard = random_arrivals_yard(rng, 6, 5, true, y % 2 != 0);
    yard.options.leave = 0.5;
    for (std::uint64_t seed = 1; seed <= 2; ++seed) {
      auto run = survivors_run(yard, seed);
      const auto& shots = testing::shots_of(run.log);
      const auto hits = static_cast<std::size_t>(
          std::ranges::count_if(shots, [](const auto& shot) { return shot.message.hit; }));
      const std::size_t survivals = events_of(run.log, "survive").size();
      survived += survivals;
      EXPECT_EQ(metric(run, "survived"), static_cast<double>(survivals));
      std::size_t ended_after_a_hit = 0;
      for (const testing::LoggedTarget& target : testing::targets_of(run.log)) {
        const auto moves = target.moves();
        EXPECT_NE(target.status, "waiting");
        std::size_t own = 0;
        for (const auto& shot : shots) {
          if (shot.message.target != target.name) continue;
          if (shot.message.hit) ++own;
          // Nobody is hit on its way: where a shot is fired at it, it has been at rest since the last hit.
          for (std::size_t i = 2; i < moves.size(); i += 2) {
            const bool walks =
                shot.time_s() > moves[i - 1].time_s + 1e-9 && shot.time_s() < moves[i].time_s - 1e-9;
            EXPECT_FALSE(walks);
          }
        }
        const std::size_t moved = (moves.size() - 1) / 2;
        EXPECT_EQ(own, moved + (target.status == "reached" ? 1 : 0)) << target.name;
        ended_after_a_hit += own;
      }
      EXPECT_EQ(ended_after_a_hit, hits);
      EXPECT_EQ(test::bytes_of_run(run), test::bytes_of_run(survivors_run(yard, seed)));
    }
  }
  EXPECT_GT(survived, 8U);
}

/// Two places and one intruder: the times of all missions are a geometric series.
TEST(Survivors, AtTwoPlacesTakeTheSumOfTheSeries) {
  Rng rng(62);
  for (int y = 0; y < cases(4); ++y) {
    ArrivalsYard yard = yard_without_loss(rng, 2, false);
    const double p = 0.6 + 0.1 * (y % 4);
    yard.options.leave = p;
    yard.options.walk_mps = y % 2 == 0 ? 0.0 : 0.4;
    StopTable one = yard.precomputed;  // the second place is empty at first: it counts as served by the plan
    const TourProblem& table = one.table;
    const ReplanPolicy policy = replan_policies().front();

    // All missions of both intruders with at most 12 survivals between them, by hand.
    struct State {
      std::vector<PendingTarget> pending;
      RobotState from;
    };
    constexpr double least = 1e-4;
    double mean = 0.0, cut = 0.0;
    const auto walk_s = [&](std::uint32_t a, std::uint32_t b) {
      const double way = distance(xy(yard.problem.targets[a].base), xy(yard.problem.targets[b].base));
      return yard.options.walk_mps > 0.0 ? way / yard.options.walk_mps : 0.0;
    };
    const StopTable& precomputed = one;
    const std::function<void(State, std::vector<std::pair<std::size_t, std::size_t>>, double, bool, int)>
        go_through = [&](State state, std::vector<std::pair<std::size_t, std::size_t>> hits,
                         double probability, bool somebody_new, int depth) {
          if (state.pending.empty() || probability < least) {
            mean += probability * state.from.time_s;
            cut += state.pending.empty() ? 0.0 : probability;
            return;
          }
          if (hits.empty() || (somebody_new && policy.name == "each_arrival")) {
            const bool still = depth == 0;
            const std::size_t group = std::min<std::size_t>(
                state.pending.size(), policy.name == "groups" ? 3 : state.pending.size());
            const std::vector<PendingTarget> first(
                state.pending.begin(), state.pending.begin() + static_cast<std::ptrdiff_t>(group));
            hits.clear();
            for (const Visit& v : sequence_beside(precomputed.tour, table, first, state.from,
                                                  ArrivalObjective::makespan, 10, still)
                                      .visits) {
              for (const std::uint32_t who : v.goals) hits.emplace_back(v.stop, who);
            }
          }
          const auto [stop, who] = hits.front();
          hits.erase(hits.begin());
          state.from = after_hit(table, state.pending[who], state.from, stop);
          const PendingTarget now_hit = state.pending[who];
          state.pending.erase(state.pending.begin() + static_cast<std::ptrdiff_t>(who));
          for (auto& hit : hits) hit.second -= hit.second > who ? 1 : 0;
          go_through(state, hits, probability * p, false, depth + 1);
          const std::uint32_t other = 1 - now_hit.goal;
          state.pending.push_back({other, state.from.time_s + walk_s(now_hit.goal, other)});
          go_through(state, hits, probability * (1.0 - p), true, depth + 1);
        };
    RobotState start;
    start.heading_rad = table.heading_rad;
    start.drives.assign(table.drives.begin(),
                        table.drives.begin() + static_cast<std::ptrdiff_t>(table.services.size()));
    go_through({{{0, 0.0}, {1, 0.0}}, start}, {}, 1.0, false, 0);

    const auto watch = arrival_yard(yard.problem, yard.firing_map, settled_intruders(yard.problem));
    const RollingPlan plan{watch, one, policy, ArrivalObjective::makespan, 3, 10};
    const ExpectedTime expected = expected_time(plan, yard.options, 1000);
    EXPECT_NEAR(expected.mean_s, mean, 4.0 * expected.error_s + cut * mean) << "p = " << p;
  }
}

/// Missions take on average the time that the plan expects; they are simulated by other code.
TEST(Survivors, TakeOnAverageWhatIsExpected) {
  Rng rng(63);
  for (int y = 0; y < cases(1); ++y) {
    ArrivalsYard yard = yard_without_loss(rng, 4, false);
    yard.options.leave = 0.6;
    const ReplanPolicy policy = find_replan_policy("each_arrival").value();
    const auto watch = arrival_yard(yard.problem, yard.firing_map, settled_intruders(yard.problem));
    const RollingPlan plan{watch, yard.precomputed, policy, ArrivalObjective::makespan, 3, 10};
    const ExpectedTime expected = expected_time(plan, yard.options, 100);
    constexpr int missions = 60;
    double sum = 0.0, squares = 0.0;
    for (std::uint64_t seed = 1; seed <= missions; ++seed) {
      const auto run = testing::run_arrivals(plan, quick(), seed, {0.6, yard.options.walk_mps});
      EXPECT_EQ(run.report.status, "done");
      const double time = metric(run, "makespan_s");
      sum += time;
      squares += time * time;
    }
    const double mean = sum / missions;
    const double error = std::sqrt((squares / missions - mean * mean) / missions);
    EXPECT_NEAR(mean, expected.mean_s, 3.5 * std::hypot(error, expected.error_s) + 0.01 * mean);
  }
}

/// When all leave, it is the mission of the still yard, to the last byte but for what is said of it and the
/// markers, which are of intruders as well as of the places that they come to.
TEST(Survivors, ThatThereAreNoneIsTheStillYard) {
  Rng rng(65);
  for (int y = 0; y < cases(3); ++y) {
    ArrivalsYard yard = yard_without_loss(rng, 5, true);
    const auto watch = arrival_yard(yard.problem, yard.firing_map, settled_intruders(yard.problem));
    const auto policy = find_replan_policy("each_arrival");
    const RollingPlan plan{watch, yard.precomputed, *policy, ArrivalObjective::makespan, 3, 30};
    auto run = testing::run_arrivals(plan, quick(), 7, {1.0, 1.0});
    auto still = testing::run_still(yard.problem, yard.firing_map, yard.plan, quick(), 7);
    EXPECT_EQ(run.report.status, still.report.status);
    const std::string scene(topic::scene);
    EXPECT_TRUE(test::bytes_of_log(run.log, scene) == test::bytes_of_log(still.log, scene));
  }
}

TEST(Survivors, GoElsewhereUniformly) {
  Rng rng(66);
  std::vector<int> seen(5, 0);
  for (int i = 0; i < 8000; ++i) ++seen[elsewhere(2, 5, rng)];
  EXPECT_EQ(seen[2], 0);
  for (const int place : {0, 1, 3, 4}) EXPECT_NEAR(seen[static_cast<std::size_t>(place)], 2000, 160);
}

TEST(Survivors, AreRefusedWhereTheyCannotBe) {
  Rng rng(67);
  GuardProblem problem = random_guard_problem(rng, 2, 2, 2.5);
  ArrivalOptions options;
  options.leave = 0.0;
  EXPECT_EQ(check_survivors(problem, options).error().where, "arrivals.leave");
  options.leave = 0.5;
  EXPECT_TRUE(check_survivors(problem, options).has_value());
  problem.targets.resize(1);
  EXPECT_EQ(check_survivors(problem, options).error().where, "arrivals.leave");
  options.leave = 1.0;
  EXPECT_TRUE(check_survivors(problem, options).has_value());
}

}  // namespace
}  // namespace outrider
