#include "outrider/job/plan_cache.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "outrider/core/parallel.hpp"

namespace outrider {
namespace {

TEST(PlanCache, FindsWhatWasKeptUnderItsKeyAndType) {
  PlanCache plans;
  EXPECT_EQ(plans.find<int>("a"), nullptr);
  const auto kept = keep_plan(&plans, "a", 3);
  EXPECT_EQ(plans.find<int>("a"), kept);  // the same one, not a copy
  EXPECT_EQ(plans.find<int>("b"), nullptr);
  EXPECT_EQ(plans.find<double>("a"), nullptr);
  keep_plan(&plans, "a", 4);
  EXPECT_EQ(*plans.find<int>("a"), 4);
  EXPECT_EQ(*kept, 3);
  EXPECT_EQ(plans.size(), 1U);
}

TEST(PlanCache, LetsGoOfThePlanThatWasUsedLongestAgo) {
  PlanCache plans(2);
  keep_plan(&plans, "a", 1);
  keep_plan(&plans, "b", 2);
  ASSERT_NE(plans.find<int>("a"), nullptr);
  keep_plan(&plans, "c", 3);
  EXPECT_NE(plans.find<int>("a"), nullptr);
  EXPECT_EQ(plans.find<int>("b"), nullptr);
  EXPECT_NE(plans.find<int>("c"), nullptr);
  EXPECT_EQ(plans.size(), 2U);
}

TEST(PlanCache, WithoutOneAPlanIsMadeAndNotFound) {
  EXPECT_EQ(*keep_plan(nullptr, "a", 5), 5);
  EXPECT_EQ(find_plan<int>(nullptr, "a"), nullptr);
}

TEST(PlanCache, IsUsedByManyThreads) {
  PlanCache plans(3);
  parallel_for(2000, {}, [&](std::size_t i) {
    const std::string key = std::to_string(i % 5);
    auto plan = find_plan<std::string>(&plans, key);
    if (!plan) plan = keep_plan(&plans, key, key);
    EXPECT_EQ(*plan, key);
  });
}

struct Settings {
  double angle_rad = 0.5;
  double speed = 1.0;
  std::int64_t seed = 1;
  std::string world = "a.sdf";
  bool noisy = false;

  [[nodiscard]] std::vector<OptionGroup> groups() {
    return {{"", "", {{"seed", "", 0, 9, "", &seed}, {"world", "", 0, 0, "", &world}}},
            {"robot", "", {{"turn", "deg", 0, 90, "", &angle_rad}, {"speed", "m/s", 0, 9, "", &speed}}},
            {"faults", "", {{"noisy", "", 0, 0, "", &noisy}}}};
  }
  std::string key() { return plan_key(groups(), {"seed", "faults"}); }
};

TEST(PlanKey, DependsOnEachOptionButThoseLeftOut) {
  const std::string key = Settings().key();
  EXPECT_EQ(key, (Settings{.seed = 7, .noisy = true}.key()));
  EXPECT_NE(key, (Settings{.speed = 1.5}.key()));
  EXPECT_NE(key, (Settings{.world = "b.sdf"}.key()));
  // Angles are written to nine digits elsewhere.
  EXPECT_NE(key, (Settings{.angle_rad = std::nextafter(0.5, 1.0)}.key()));
  EXPECT_NE(plan_key(Settings().groups(), {}), (plan_key(Settings{.seed = 7}.groups(), {})));
}

/// A name that is left out stands for a top-level option or a group, not for an option in a group.
TEST(PlanKey, KeepsOptionsOfGroupsThatHaveTheNameOfOneLeftOut) {
  Settings fast{.speed = 2.0};
  EXPECT_NE(plan_key(Settings().groups(), {"speed"}), plan_key(fast.groups(), {"speed"}));
}

}  // namespace
}  // namespace outrider
