#include "outrider/pursuit/check.hpp"

#include <gtest/gtest.h>

#include "support/pursuit_oracle.hpp"

namespace outrider {
namespace {

/// Two seconds along a corridor under a wall; the cheapest catch is the only one.
PursuitProblem corridor() {
  return testing::drawn_pursuit({"##99", "2345"}, {0, 0}, {{3, 1}, {3, 1}, {2, 0}, {3, 0}});
}

PursuitPlan good_plan() {
  PursuitPlan plan;
  plan.path = {{0, 0}, {1, 0}, {2, 0}};
  plan.catch_time_s = 2;
  plan.cost = plan.lower_bound = 5;
  plan.earliest_catch_s = 2;
  return plan;
}

void expect_refused(const PursuitPlan& plan, const std::string& part) {
  const Status judged = check(plan, corridor());
  ASSERT_FALSE(judged) << part;
  EXPECT_NE(judged.error().sentence.find(part), std::string::npos) << judged.error().sentence;
}

TEST(CheckPursuit, TakesAGoodPlan) {
  EXPECT_TRUE(check(good_plan(), corridor()));
  EXPECT_TRUE(certify(good_plan(), corridor(), {}));
}

TEST(CheckPursuit, RefusesEveryLie) {
  PursuitPlan plan = good_plan();
  plan.cost = 4;
  plan.lower_bound = 4;
  expect_refused(plan, "add up to 5");
  plan = good_plan();
  plan.lower_bound = 6;
  expect_refused(plan, "lower bound 6");
  plan = good_plan();
  plan.earliest_catch_s = 3;
  expect_refused(plan, "before the earliest catch at 3");
  plan = good_plan();
  plan.catch_time_s = 3;
  expect_refused(plan, "the catch is at second 3");
  plan = good_plan();
  plan.path = {{1, 0}, {1, 0}, {2, 0}};
  expect_refused(plan, "begin with the robot");
  plan.path = {{0, 0}, {0, 0}, {2, 0}};
  expect_refused(plan, "from (1, 1) to (3, 1), which are no neighbours");
  plan.path = {{0, 0}, {1, 1}, {2, 0}};
  expect_refused(plan, "in the wall (2, 2)");
  plan.path = {{0, 0}, {0, -1}, {2, 0}};
  expect_refused(plan, "off the map");
  plan.path = {{0, 0}, {1, 0}, {1, 0}};
  expect_refused(plan, "has not caught");
  plan.path = {{0, 0}, {1, 0}, {2, 0}, {3, 0}};
  plan.catch_time_s = 3;
  expect_refused(plan, "catches the target at second 2, and goes on");
  plan.path = {{0, 0}};
  plan.catch_time_s = 0;
  expect_refused(plan, "no second that counts");
}

TEST(CheckPursuit, CertifyRefusesABoundTooHighAndACatchTooLate) {
  PursuitProblem problem = testing::drawn_pursuit({"999", "111"}, {0, 0}, {{2, 1}, {2, 0}, {2, 0}, {2, 0}});
  PursuitPlan plan;
  plan.path = {{0, 0}, {1, 1}, {2, 0}};
  plan.catch_time_s = 2;
  plan.cost = plan.lower_bound = 10;
  plan.earliest_catch_s = 2;
  ASSERT_TRUE(check(plan, problem));
  EXPECT_FALSE(certify(plan, problem, {}));
  plan.lower_bound = 2;
  EXPECT_TRUE(certify(plan, problem, {}));
  plan.earliest_catch_s = 1;
  EXPECT_FALSE(certify(plan, problem, {}));
}

TEST(CheckPursuit, ProblemsThatCannotBeAsked) {
  const auto code = [](const PursuitProblem& problem) {
    const Status asked = check(problem);
    return asked ? std::string("good") : std::string(to_string(asked.error().code));
  };
  EXPECT_EQ(code(corridor()), "good");
  EXPECT_EQ(code(PursuitProblem{}), "bad_input");
  PursuitProblem problem = corridor();
  problem.start = {1, 1};
  EXPECT_EQ(code(problem), "start_blocked");
  problem.start = {4, 0};
  EXPECT_EQ(code(problem), "outside_map");
  problem = corridor();
  problem.target[1] = {0, 2};
  EXPECT_EQ(code(problem), "bad_input");
  problem = corridor();
  problem.target.clear();
  EXPECT_EQ(code(problem), "bad_input");
  problem = corridor();
  problem.start_s = 4;
  EXPECT_EQ(code(problem), "bad_input");
  CostGrid short_grid = *problem.costs;
  short_grid.cells.pop_back();
  problem = corridor();
  problem.costs = std::make_shared<const CostGrid>(short_grid);
  EXPECT_EQ(code(problem), "bad_input");
}

}  // namespace
}  // namespace outrider
