#include "outrider/jobs/guard/yard/arrivals.hpp"

#include <gtest/gtest.h>

#include <map>

#include "outrider/jobs/guard/behaviour/policy.hpp"
#include "support/guard_yard.hpp"

namespace outrider {
namespace {

GuardProblem three_places() {
  Rng rng(1);
  return testing::random_guard_problem(rng, 0, 3, 2.5);
}

const std::vector<Entrance> doors = {{"gate", {0.0, -2.0}}, {"gap", {2.0, 1.0}}};

ArrivalOptions many() {
  ArrivalOptions options;
  options.count = 1000;
  options.rate_hz = 0.25;
  return options;
}

/// The mean of 1000 gaps with mean 4 s is within 4 standard errors, and so are the shares.
TEST(Arrivals, ComeAtTheRateByEveryDoorToEveryPlace) {
  const GuardProblem problem = three_places();
  const auto drawn = draw_arrivals(problem, doors, many(), 5);
  ASSERT_TRUE(drawn.has_value());
  ASSERT_EQ(drawn->size(), 1000U);
  EXPECT_NEAR(drawn->back().enters_s / 1000.0, 4.0, 4.0 * 4.0 / std::sqrt(1000.0));
  std::map<std::string, int> by_door;
  std::map<std::size_t, int> by_place;
  double above_mean = 0.0;
  double before = 0.0;
  for (const Intruder& one : *drawn) {
    ++by_door[one.entrance];
    ++by_place[one.place];
    EXPECT_GE(one.enters_s, before);
    above_mean += one.enters_s - before > 4.0 ? 1.0 : 0.0;
    before = one.enters_s;
    EXPECT_NEAR(one.settles_s - one.enters_s, distance(one.from, xy(problem.targets[one.place].base)), 1e-9);
  }
  EXPECT_NEAR(above_mean / 1000.0, std::exp(-1.0), 4.0 * 0.0153);  // of an exponential distribution
  EXPECT_NEAR(by_door["gate"], 500, 64);
  for (std::size_t place = 0; place < 3; ++place) EXPECT_NEAR(by_place[place], 333, 60) << place;
}

TEST(Arrivals, AreTheSameForASeedAndThePrefixOfMore) {
  const GuardProblem problem = three_places();
  const auto all = draw_arrivals(problem, doors, many(), 5);
  auto few = many();
  few.count = 10;
  const auto some = draw_arrivals(problem, doors, few, 5);
  ASSERT_EQ(some->size(), 10U);
  for (std::size_t i = 0; i < 10; ++i) {
    EXPECT_EQ((*some)[i].enters_s, (*all)[i].enters_s);
    EXPECT_EQ((*some)[i].place, (*all)[i].place);
    EXPECT_EQ((*some)[i].name, (*all)[i].name);
  }
  EXPECT_NE(draw_arrivals(problem, doors, few, 6)->front().enters_s, some->front().enters_s);
  few.rate_hz *= 2.0;  // the same arrivals, twice as fast
  EXPECT_NEAR(draw_arrivals(problem, doors, few, 5)->back().enters_s, 0.5 * some->back().enters_s, 1e-9);
  few.until_s = some->front().enters_s;
  const auto early = draw_arrivals(problem, doors, few, 5);
  for (const Intruder& one : *early) EXPECT_LE(one.enters_s, few.until_s);
}

TEST(Arrivals, HaveNamesOfTheirOwn) {
  GuardProblem problem = three_places();
  problem.targets[0].name = "fox";
  problem.targets[1].name = "fox_2";
  std::vector<Intruder> intruders;
  for (const std::size_t place : {0U, 0U, 1U, 0U}) intruders.push_back({"", place, "gate", {}, 1.0, 1.0});
  intruders.push_back({"", 2, "gate", {}, 0.5, 0.5});
  put_in_order(problem, intruders);
  std::vector<std::string> names;
  for (const Intruder& one : intruders) names.push_back(one.name);
  EXPECT_EQ(names, (std::vector<std::string>{"cat_2", "fox", "fox_3", "fox_2", "fox_4"}));
}

TEST(Arrivals, RefuseWhatCannotBe) {
  GuardProblem problem = three_places();
  EXPECT_EQ(draw_arrivals(problem, {}, many(), 1).error().where, "arrivals.entrances");
  auto crowd = many();
  crowd.count = 0;
  crowd.until_s = 1e5;
  const auto refused = draw_arrivals(problem, doors, crowd, 1);
  ASSERT_FALSE(refused.has_value());
  EXPECT_EQ(refused.error().where, "arrivals.rate");
  problem.targets.clear();
  EXPECT_EQ(draw_arrivals(problem, doors, many(), 1).error().where, "targets");
}

TEST(WatchPolicies, AreFoundByNameAndPlanWhenIdle) {
  for (const ReplanPolicy& policy : replan_policies()) {
    EXPECT_TRUE(find_replan_policy(policy.name).has_value());
    for (std::size_t inside = 1; inside < 9; ++inside) {
      EXPECT_GT(policy.take({inside, 0, true, 3}), 0U) << policy.name;
      EXPECT_LE(policy.take({inside, 0, true, 3}), inside) << policy.name;
      EXPECT_EQ(policy.take({inside, 0, false, 3}), 0U) << policy.name << " drops its plan for nothing";
    }
    EXPECT_EQ(policy.take({0, 0, true, 3}), 0U);
  }
  const auto wrong = find_replan_policy("group");
  ASSERT_FALSE(wrong.has_value());
  EXPECT_NE(wrong.error().sentence.find("did you mean 'groups'"), std::string::npos)
      << wrong.error().sentence;
}

}  // namespace
}  // namespace outrider
