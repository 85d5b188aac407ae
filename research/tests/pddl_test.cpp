// Plans as text and back, what a reader refuses, and what a domain talks about.
#include "research/guard/pddl.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <regex>

#include "support/random_cases.hpp"
#include "unit/tour/supply/random_supply.hpp"

namespace outrider {
namespace {

/// A target seen from one stop, water for one shot, and a station.
SupplyProblem small() {
  SupplyProblem problem;
  problem.table.goals = 1;
  problem.table.turning = {1.0, 1.0};
  problem.table.services = {{}, {{0, 1.0, 0.2, 0.5}}, {}};
  problem.table.drives.assign(9, {2.0, 0.0, 0.0});
  problem.lengths_m.assign(9, 1.0);
  problem.water = 1.0;
  problem.stations = {{2, Store::water, 3.0, 0.5}};
  return problem;
}

TEST(Pddl, PlansReadBackAsTheyWere) {
  int written = 0;
  for (int seed = 0; seed < testing::cases(60); ++seed) {
    const auto supplies = random_supply(3, 4, static_cast<std::uint64_t>(seed));
    const auto tour = solve_supplied(supplies, {}, {});
    ASSERT_TRUE(tour);
    if (!tour->dropped.empty()) continue;
    const auto problem = temporal_problem(supplies);
    ASSERT_TRUE(problem);
    const auto actions = temporal_actions(*problem, tour->steps);
    ASSERT_TRUE(actions);
    const auto read = pddl_plan_from_text(pddl_plan(*problem, *actions), "plan.txt", *problem);
    ASSERT_TRUE(read) << to_string(read.error());
    ASSERT_EQ(read->actions.size(), actions->size());
    const TemporalVerdict verdict = judge(*problem, read->actions, 1e-6);
    EXPECT_TRUE(verdict.valid()) << seed << ": " << verdict.reason;
    EXPECT_NEAR(verdict.makespan_s, tour->cost_s, 1e-6 * tour->cost_s);
    written += static_cast<int>(actions->size());
  }
  EXPECT_GT(written, 200);
}

TEST(Pddl, ReadsCommentsBlanksAndCapitals) {
  const auto problem = temporal_problem(small());
  ASSERT_TRUE(problem);
  const auto plan = pddl_plan_from_text(
      "; Time 0.1\n\n 0.000 : ( DRIVE P0-0  p1-0 ) [ 2.0 ]\r\n2.001: (shoot p1-0 t0 direct) [0.9]; ok\n",
      "plan", *problem);
  ASSERT_TRUE(plan) << to_string(plan.error());
  ASSERT_EQ(plan->actions.size(), 2U);
  EXPECT_EQ(plan->lines, (std::vector<std::size_t>{3, 4}));
  EXPECT_EQ(plan->phrases.front(), "(drive p0-0 p1-0)");
  EXPECT_EQ(judge(*problem, plan->actions, 1e-3).reason,
            "it lasts 0.900000 s, but takes at least 1.500000 s that way round");
}

TEST(Pddl, RefusesLinesBySentence) {
  const auto problem = temporal_problem(small());
  ASSERT_TRUE(problem);
  for (const auto& [line, word] : std::vector<std::pair<std::string, std::string>>{
           {"drive p0-0 p1-0", "TIME: (ACTION WORDS) [DURATION]"},
           {"0: (drive p0-0 p1-0)", "TIME: (ACTION WORDS) [DURATION]"},
           {"x: (drive p0-0 p1-0) [2]", "'x: (drive p0-0 p1-0) [2]'"},
           {"-1: (drive p0-0 p1-0) [2]", "times in s"},
           {"0: (drive p0-0 p1-0) [nan]", "times in s"},
           {"0: (drive p0-0 p1-0) [1e10]", "times in s"},
           {"0: (drive p0-0 p1-0) [2] 3", "times in s"},
           {"0: () [2]", "is no action here"},
           {"0: (fly p0-0 p1-0) [2]", "is no action here"},
           {"0: (drive p0-0) [2]", "is no action here"},
           {"0: (shoot p1-0 t0 sideways) [2]", "is no action here"},
           {"0: (drive p0-0 p9-0) [2]", "'p9-0' is no name that (drive ...) takes there"},
           {"0: (drive p9-0 p0-0) [2]", "'p9-0'"},
           {"0: (shoot p1-0 t1 direct) [2]", "'t1'"},
           {"0: (fill-charge f0 p2-0) [2]", "'f0'"},
           {"0: (fill-water f1 p2-0) [2]", "'f1'"},
           {"0: (fill-water f0 p7-7) [2]", "'p7-7'"}}) {
    const auto plan = pddl_plan_from_text("; one\n" + line + "\n", "their.txt", *problem);
    ASSERT_FALSE(plan) << line;
    EXPECT_EQ(plan.error().where, "their.txt:2");
    EXPECT_NE(plan.error().sentence.find(word), std::string::npos) << plan.error().sentence;
  }
}

/// Parentheses are balanced, and closed only at the end.
bool is_one_expression(const std::string& text) {
  const std::string code = std::regex_replace(text, std::regex(";[^\n]*"), "");
  int depth = 0;
  bool closed = false;
  for (const char c : code) {
    if (closed && std::isspace(static_cast<unsigned char>(c)) == 0) return false;
    depth += c == '(' ? 1 : c == ')' ? -1 : 0;
    if (depth < 0) return false;
    closed = closed || (c == ')' && depth == 0);
  }
  return depth == 0 && closed;
}

TEST(Pddl, DomainsTalkOfWhatEndsOnly) {
  SupplyProblem supplies = small();
  const auto with = temporal_problem(supplies);
  supplies.water = std::numeric_limits<double>::infinity();
  supplies.stations.clear();
  const auto without = temporal_problem(supplies);
  ASSERT_TRUE(with && without);
  const PddlNotes notes{"yard; (with) \n words", {{}, {}, {}}, {"fox\n("}, {}, {"hen"}};
  for (const auto& problem : {*with, *without}) {
    EXPECT_TRUE(is_one_expression(pddl_domain(problem)));
    EXPECT_TRUE(is_one_expression(pddl_problem(problem, notes)));
    EXPECT_EQ(pddl_domain(problem).find("charge"), std::string::npos);
  }
  EXPECT_NE(pddl_domain(*with).find("fill-water"), std::string::npos);
  EXPECT_NE(pddl_problem(*with, notes).find("(gives-water f0 p2-0)"), std::string::npos);
  EXPECT_EQ(pddl_domain(*without).find("water)"), std::string::npos);
  EXPECT_NE(pddl_problem(*without, notes).find("no stations"), std::string::npos);
  EXPECT_NE(pddl_problem(*without, notes).find("hen is left out"), std::string::npos);
}

TEST(Pddl, NumbersHaveNoExponent) {
  SupplyProblem supplies = small();
  supplies.table.services[1][0].duration_s = 1e-7;
  supplies.lengths_m[1] = 1e20;
  supplies.charge_per_metre = 1.0;
  supplies.charge = 1e21;
  const auto problem = temporal_problem(supplies);
  ASSERT_TRUE(problem);
  const std::string text = pddl_problem(*problem, {"yard", {}, {}, {}, {}});
  EXPECT_FALSE(std::regex_search(text, std::regex("[0-9]e[-+]?[0-9]")));
  EXPECT_NE(text.find("(= (flight-time p1-0 t0) 0.0000001)"), std::string::npos);
}

}  // namespace
}  // namespace outrider
