// Runs that share their plans, as those of a sweep do: the same bytes as runs by themselves.
#include <gtest/gtest.h>

#include <string>

#include "outrider/job/plan_cache.hpp"
#include "outrider/job/run_job.hpp"
#include "outrider/jobs/catalog.hpp"
#include "support/run_bytes.hpp"

namespace outrider {
namespace {

class SharedPlans : public ::testing::Test {
 protected:
  /// Runs a bundled scenario with the changes, by itself and with the cache. Returns the status.
  std::string expect_same_run(const std::string& scenario, Changes changes) {
    changes.insert(changes.end(), common_.begin(), common_.end());
    const std::string path = std::string(OUTRIDER_SOURCE_DIR) + "/scenarios/" + scenario;
    auto alone = run_job(jobs(), path, changes);
    auto sharing = run_job(jobs(), path, changes, {.plans = &plans_});
    EXPECT_TRUE(alone.has_value() && sharing.has_value());
    if (!alone || !sharing) return "";
    EXPECT_EQ(test::bytes_of_run(*sharing), test::bytes_of_run(*alone));
    return alone->report.status;
  }
  Changes common_;
  PlanCache plans_;
};

TEST_F(SharedPlans, OfAYardHoldForOtherSeedsAndFaults) {
  const std::string yard = "driveby/driveby.yaml";
  common_ = {{"plan.resolution", "0.4"}, {"plan.iterations", "100"}, {"plan.refinements", "0"}};
  EXPECT_EQ(expect_same_run(yard, {{"seed", "1"}}), "done");
  expect_same_run(yard, {{"seed", "2"}, {"regions", "true"}});
  EXPECT_EQ(plans_.size(), 2U) << "regions are logged, and count as planning";
  EXPECT_EQ(expect_same_run(yard, {{"seed", "3"}, {"faults.jammed_at", "0"}}), "not_done");
  EXPECT_EQ(plans_.size(), 2U);
  expect_same_run(yard, {{"robot.radius", "0.3"}});
  EXPECT_EQ(plans_.size(), 3U);
}

TEST_F(SharedPlans, OfATeamHoldForOtherSeeds) {
  const std::string yard = "driveby/driveby.yaml";
  common_ = {{"plan.resolution", "0.4"}, {"plan.iterations", "100"}, {"plan.refinements", "0"}};
  for (const char* seed : {"1", "2"}) expect_same_run(yard, {{"seed", seed}, {"robots", "2"}});
  EXPECT_EQ(plans_.size(), 1U);
  expect_same_run(yard, {});
  EXPECT_EQ(plans_.size(), 2U) << "one robot has a plan of its own";
}

TEST_F(SharedPlans, OfTargetsThatSurviveHoldForOtherSeeds) {
  common_ = {{"plan.resolution", "0.5"}, {"plan.gap", "1"}};
  for (const char* seed : {"1", "2"}) expect_same_run("survivors/survivors.yaml", {{"seed", seed}});
  EXPECT_EQ(plans_.size(), 1U);
}

/// The seed draws who comes when, so each has a plan of its own.
TEST_F(SharedPlans, OfIntrudersHoldForOtherFaultsOnly) {
  const std::string yard = "arrivals/arrivals.yaml";
  common_ = {
      {"plan.resolution", "0.5"}, {"plan.iterations", "100"}, {"plan.gap", "1"}, {"arrivals.count", "6"}};
  expect_same_run(yard, {{"seed", "1"}});
  expect_same_run(yard, {{"seed", "1"}, {"faults.jammed_at", "20"}});
  EXPECT_EQ(plans_.size(), 1U);
  expect_same_run(yard, {{"seed", "2"}});
  EXPECT_EQ(plans_.size(), 2U);
}

TEST_F(SharedPlans, OfARoomHoldForOtherSeedsAndFaults) {
  const std::string room = "cover/cover_room.yaml";
  EXPECT_EQ(expect_same_run(room, {{"seed", "1"}}), "done");
  EXPECT_EQ(expect_same_run(room, {{"seed", "2"}}), "done");
  EXPECT_EQ(plans_.size(), 1U);
  common_ = {
      {"sim", "navigator"}, {"tracking_error", "0.01"}, {"overlap", "0.25"}, {"order.iterations", "200"}};
  expect_same_run(room, {{"seed", "1"}});
  expect_same_run(room, {{"seed", "2"}, {"faults.slip", "0.2"}});
  EXPECT_EQ(plans_.size(), 2U);
  expect_same_run(room, {{"width", "0.22"}});
  EXPECT_EQ(plans_.size(), 3U);
}

}  // namespace
}  // namespace outrider
