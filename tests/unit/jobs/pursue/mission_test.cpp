#include "outrider/jobs/pursue/mission.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <optional>
#include <vector>

#include "outrider/sim/simulated_team.hpp"
#include "support/pursuit_oracle.hpp"
#include "support/random_cases.hpp"
#include "support/smooth_pursuit.hpp"

namespace outrider {
namespace {

/// Every lap takes as long.
struct SteadyWatch final : StopWatch {
  double lap_s() override { return each_s; }
  void restart() override { ++restarts; }
  double each_s = 0.0;
  int restarts = 0;
};

/// A team that stays where it is in every second with an odd number.
class LateTeam final : public Robot {
 public:
  LateTeam(Cell start, std::vector<Cell> target) : team_({start}, std::move(target)), here_(start) {}
  Observation sense() override {
    Observation seen = team_.sense();
    here_ = seen.grid->robots.front();
    return seen;
  }
  void act(const Command& command) override {
    const auto to = std::get<StepToCell>(command);
    farthest_step = std::max({farthest_step, std::abs(to.cell.x - here_.x), std::abs(to.cell.y - here_.y)});
    team_.act(++second_ % 2 == 1 ? Command{StepToCell{0, here_}} : command);
  }
  int farthest_step = 0;

 private:
  SimulatedTeam team_;
  Cell here_;
  int second_ = 0;
};

/// The cells to which the robot is commanded.
std::vector<Cell> commanded(PursuitMission& mission, const PursuitProblem& problem) {
  SimulatedTeam team({problem.start}, problem.target);
  std::vector<Cell> cells;
  run_mission(mission, team, {}, [&](const Observation&, const Command* command) {
    if (command != nullptr) cells.push_back(std::get<StepToCell>(*command).cell);
  });
  return cells;
}

PursuitProblem corridor() {
  return testing::drawn_pursuit({"11111"}, {0, 0}, std::vector<Cell>(12, Cell{4, 0}));
}

TEST(PursuitMission, FreePlanningGoesAtOnce) {
  const PursuitRules rules;
  SteadyWatch watch;
  PursuitMission mission(corridor(), 12, rules, watch);
  EXPECT_EQ(commanded(mission, corridor()), (std::vector<Cell>{{1, 0}, {2, 0}, {3, 0}, {4, 0}}));
  EXPECT_TRUE(mission.run.state.caught);
  EXPECT_EQ(watch.restarts, 5) << "what passes between two steps is not charged";
}

TEST(PursuitMission, TheRobotWaitsWhileItsFirstAnswerIsThoughtOf) {
  PursuitRules rules;
  rules.clock = PursuitClock::wall;
  SteadyWatch watch;
  watch.each_s = 3.5;
  PursuitMission mission(corridor(), 12, rules, watch);
  const std::vector<Cell> cells = commanded(mission, corridor());
  ASSERT_GE(cells.size(), 2U);
  EXPECT_EQ(cells[0], (Cell{0, 0}));
  EXPECT_EQ(cells[1], (Cell{0, 0}));
  EXPECT_TRUE(mission.run.state.caught);
  EXPECT_EQ(mission.run.state.time_s, static_cast<int>(cells.size()));
}

TEST(PursuitMission, TheSearchIsKeptFromCallToCallWhileTheRobotGoesOn) {
  int most_calls = 0;
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    testing::SmoothPursuit of;
    of.side = 50;
    of.seconds = 900;
    of.seed = seed;
    const PursuitProblem problem = testing::smooth_pursuit(of);
    AnytimePursuit whole(problem);
    while (!whole.proven()) ASSERT_TRUE(whole.improve(Budget{}));

    PursuitRules rules;
    rules.clock = PursuitClock::wall;
    rules.budget.expansions = 2'800;  // of each call: enough for a first catch
    SteadyWatch watch;
    watch.each_s = 1.6;
    PursuitMission mission(problem, problem.target.size(), rules, watch);
    (void)commanded(mission, problem);
    EXPECT_TRUE(mission.run.state.caught);
    most_calls = std::max(most_calls, mission.run.calls);
    EXPECT_LE(mission.run.expansions, whole.counters().expansions * 3 / 2) << "it began again";
  }
  EXPECT_GT(most_calls, 2) << "it is no test if one call is enough";
}

/// The costs of the missions of one pursuit, with ever more thinking in each call; none where it is not
/// caught.
std::vector<std::optional<std::uint64_t>> costs_by_thinking(const PursuitProblem& problem, double lap_s) {
  std::vector<std::optional<std::uint64_t>> costs;
  for (std::uint64_t expansions = 500; expansions <= 2'000'000; expansions *= 2) {
    PursuitRules rules;
    rules.clock = PursuitClock::wall;
    rules.budget.expansions = expansions;
    SteadyWatch watch;
    watch.each_s = lap_s;
    PursuitMission mission(problem, problem.target.size(), rules, watch);
    (void)commanded(mission, problem);
    const PursuitState& state = mission.run.state;
    costs.push_back(state.caught ? std::optional(state.cost) : std::nullopt);
  }
  return costs;
}

TEST(PursuitMission, MoreThinkingIsNeverWorse) {
  int pursuits = 0, cheaper = 0;
  for (const auto walk : {testing::Walk::wander, testing::Walk::round, testing::Walk::late}) {
    for (const double lap_s : {0.1, 0.6, 1.6}) {
      for (int seed = 1; seed <= testing::cases(4); ++seed) {
        testing::SmoothPursuit of;
        of.side = 60;
        of.seconds = 900;
        of.walk = walk;
        of.seed = static_cast<std::uint64_t>(seed);
        const auto costs = costs_by_thinking(testing::smooth_pursuit(of), lap_s);
        const auto first = std::ranges::find_if(costs, [](const auto& cost) { return cost.has_value(); });
        ASSERT_NE(first, costs.end());
        for (auto next = first + 1; next < costs.end(); ++next) {
          ASSERT_TRUE(*next) << "caught with less thinking";
          EXPECT_LE(**next, *next[-1]) << seed << ", " << lap_s << " s a lap";
        }
        ++pursuits;
        cheaper += **first > *costs.back() ? 1 : 0;
      }
    }
  }
  EXPECT_GT(cheaper, pursuits / 2) << "it is no test if the first catch is the cheapest";
}

TEST(PursuitMission, ARobotThatIsLateIsSentOnFromWhereItIs) {
  for (const PursuitClock clock : {PursuitClock::free_planning, PursuitClock::wall}) {
    PursuitRules rules;
    rules.clock = clock;
    SteadyWatch watch;
    watch.each_s = 2.5;
    PursuitMission mission(corridor(), 12, rules, watch);
    LateTeam team({0, 0}, corridor().target);
    run_mission(mission, team, {}, [](const Observation&, const Command*) {});
    EXPECT_LE(team.farthest_step, 1);
    EXPECT_TRUE(mission.run.state.caught || clock == PursuitClock::wall);
    EXPECT_TRUE(mission.run.state.caught || mission.run.state.time_s == 11);
  }
}

TEST(PursuitMission, AFaultOfTheFirstCallEndsItWithoutACommand) {
  const auto problem = testing::drawn_pursuit({"1#1"}, {0, 0}, std::vector<Cell>(3, Cell{2, 0}));
  const PursuitRules rules;
  SteadyWatch watch;
  PursuitMission mission(problem, 3, rules, watch);
  EXPECT_TRUE(commanded(mission, problem).empty());
  ASSERT_TRUE(mission.fault);
  EXPECT_EQ(mission.fault->code, FaultCode::no_path);
}

}  // namespace
}  // namespace outrider
