// The claims of a drive about its stops against the true poses, under faults that it must notice.
#include <gtest/gtest.h>

#include <cmath>

#include "outrider/core/units.hpp"
#include "outrider/jobs/drive/run.hpp"
#include "support/costly_cases.hpp"
#include "support/drive_faults.hpp"
#include "support/logged_run.hpp"
#include "support/random_cases.hpp"

namespace outrider {
namespace {

/// Two tags are in view at each stop.
DriveTask two_tags_in_view() {
  DriveTask task;
  task.world.name = "open ground";
  task.world.bounds = {{-50, -50}, {50, 50}};
  task.tags.tags = {upright_tag(1, {2.5, 0.5, 0.2}, pi), upright_tag(2, {2.5, -0.5, 0.2}, pi),
                    upright_tag(3, {2.5, 0.0, 0.2}, pi)};
  task.waypoints = {{{{0.5, 0}, 0}}, {{{0.5, 0.4}, 0}}, {{{0, 0}, 0}}};
  return task;
}

Run driven_unseen(const DriveTask& task, const DriveSimParams& params, std::uint64_t seed) {
  auto run = testing::logged_run(
      {}, [&](Log& log) -> Outcome<Report> { return run_drive(task, params, false, seed, log); });
  return std::move(run.value());
}

double number(const Run& run, std::size_t waypoint, std::string_view column) {
  const Table& table = table_named(run.report, "waypoints");
  return TableRow{table, table.rows.at(waypoint)}.number(column);
}

std::size_t events_named(const Run& run, std::string_view name) {
  const auto events = events_of(run.log);
  return static_cast<std::size_t>(
      std::ranges::count_if(events, [&](const auto& event) { return event.message.name == name; }));
}

/// Every stop that is called reached is within the tolerance, and "done" needs all of them. Returns how many
/// are called reached.
std::size_t expect_true_claims(const Run& run) {
  const double most_m = metric(run, "tolerance_m"), most_rad = metric(run, "tolerance_rad");
  EXPECT_GT(most_m, 0.0);
  std::size_t reached = 0;
  const std::size_t stops = table_named(run.report, "waypoints").rows.size();
  for (std::size_t i = 0; i < stops; ++i) {
    if (std::isnan(number(run, i, "reached_s"))) continue;
    ++reached;
    EXPECT_LE(std::hypot(number(run, i, "dx"), number(run, i, "dy")), most_m) << "waypoint " << i + 1;
    EXPECT_LE(std::abs(number(run, i, "dtheta")), most_rad) << "waypoint " << i + 1;
  }
  EXPECT_EQ(metric(run, "false_arrivals"), 0.0);
  if (reached < stops) {
    EXPECT_NE(run.report.status, "done");
    EXPECT_FALSE(run.report.reason.empty());
  }
  return reached;
}

TEST(DriveClaims, WithoutTagsNoStopIsReached) {
  DriveTask task = two_tags_in_view();
  task.tags = {};
  const auto run = driven_unseen(task, testing::usual_faults(), 1);
  EXPECT_EQ(run.report.status, "unconfirmed");
  EXPECT_NE(run.report.reason.find("3 of 3 stops unconfirmed"), std::string::npos) << run.report.reason;
  EXPECT_EQ(expect_true_claims(run), 0U);
  EXPECT_EQ(events_named(run, "unconfirmed"), 3U) << "it went to each of them";
}

/// In the open loop nothing tells the robot that it is off, and it claims every stop.
TEST(DriveClaims, FalseClaimsAreCounted) {
  DriveTask task = two_tags_in_view();
  task.closed_loop = false;
  const auto run = driven_unseen(task, testing::usual_faults(), 1);
  double off = 0.0;
  for (std::size_t i = 0; i < task.waypoints.size(); ++i) {
    const double error_m = std::hypot(number(run, i, "dx"), number(run, i, "dy"));
    const double turned_rad = std::abs(number(run, i, "dtheta"));
    off += error_m > metric(run, "tolerance_m") || turned_rad > metric(run, "tolerance_rad") ? 1.0 : 0.0;
  }
  EXPECT_GT(off, 0.0);
  EXPECT_EQ(metric(run, "false_arrivals"), off);
}

TEST(DriveClaims, AKidnappedRobotReachesNothing) {
  for (int seed = 1; seed <= testing::costly_cases(6); ++seed) {
    Rng rng(static_cast<std::uint64_t>(seed));
    DriveSimParams params = testing::usual_faults();
    params.kidnapping = {rng.uniform(0.5, 10.0), 30.0, rng.uniform(-pi, pi)};
    const auto run = driven_unseen(two_tags_in_view(), params, static_cast<std::uint64_t>(seed));
    EXPECT_GT(norm(poses_of(run.log).back().position), 20.0) << "it was kidnapped";
    EXPECT_LT(expect_true_claims(run), 3U);
  }
}

TEST(DriveClaims, ARobotThatIsMovedWhileItSettlesComesBackFirst) {
  DriveTask task = two_tags_in_view();
  task.rules.tags_move = false;  // three tags 2.5 m ahead tell no second opinion in time
  for (int seed = 1; seed <= testing::costly_cases(6); ++seed) {
    const auto number_of = static_cast<std::uint64_t>(seed);
    Rng rng(number_of);
    const auto undisturbed = driven_unseen(task, testing::usual_faults(), number_of);
    ASSERT_EQ(undisturbed.report.status, "done") << undisturbed.report.reason;
    const std::size_t stop = rng.below(3);
    DriveSimParams params = testing::usual_faults();
    const double nudged_s = number(undisturbed, stop, "reached_s") - rng.uniform(0.02, 0.45);
    params.kidnapping = {nudged_s, seed % 2 == 0 ? 0.2 : -0.2, 0.0};
    const auto run = driven_unseen(task, params, number_of);
    EXPECT_EQ(expect_true_claims(run), 3U) << run.report.reason;
    EXPECT_EQ(run.report.status, "done");
    EXPECT_EQ(events_named(run, "relocalised"), 1U);
    EXPECT_GE(number(run, stop, "reached_s"), nudged_s + task.rules.settle_s);
  }
}

TEST(DriveClaims, TagsInSightFindAKidnappedRobotAgain) {
  DriveSimParams params = testing::usual_faults();
  params.kidnapping = {4.0, 0.8, 0.0};
  const auto run = driven_unseen(two_tags_in_view(), params, 1);
  EXPECT_GT(metric(run, "belief_error_m"), 0.7) << "it was kidnapped";
  EXPECT_EQ(run.report.status, "done") << run.report.reason;
  EXPECT_EQ(expect_true_claims(run), 3U);
  EXPECT_EQ(events_named(run, "relocalised"), 1U);
}

TEST(DriveClaims, TheBeliefCoversTheErrorsOfWheelsAndSlip) {
  for (int seed = 1; seed <= testing::costly_cases(6); ++seed) {
    for (const bool wheel : {true, false}) {
      DriveSimParams params = testing::usual_faults();
      if (wheel) params.wheels.gains[static_cast<std::size_t>(seed) % 4] += seed % 2 == 0 ? 0.1 : -0.1;
      if (!wheel) params.wheels.strafe_slip = 0.5;
      params.sight.missed = 0.5;
      const auto run = driven_unseen(two_tags_in_view(), params, static_cast<std::uint64_t>(seed));
      expect_true_claims(run);
      EXPECT_LE(metric(run, "belief_error_ratio"), 6.0) << seed;
    }
  }
}

/// At most stops of this course one tag is in view.
TEST(DriveClaims, ATagThatHangsElsewhereConfirmsNoWrongStop) {
  DriveTask task = two_tags_in_view();
  task.tags.tags = {upright_tag(1, {2, 1, 0.2}, pi), upright_tag(2, {1, 2.5, 0.2}, -pi / 2),
                    upright_tag(3, {0, 2, 0.2}, 0)};
  task.waypoints = {{{{0, 0}, 0}}, {{{1, 0}, 0}}, {{{1, 2}, pi}}, {{{0, 0}, 0}}};
  for (int seed = 1; seed <= testing::costly_cases(4); ++seed) {
    for (const Tag& tag : task.tags.tags) {
      DriveSimParams params = testing::usual_faults();
      params.moved_tag = {tag.id, seed % 2 == 0 ? 0.1 : -0.1};
      const auto run = driven_unseen(task, params, static_cast<std::uint64_t>(seed));
      EXPECT_LT(expect_true_claims(run), 4U) << "seed " << seed << ", tag " << tag.id;
      EXPECT_GE(events_named(run, "relocalised"), 1U) << "the tag contradicts the belief";
    }
  }
}

TEST(DriveClaims, NoisierCornersThanExpectedAreNoticed) {
  for (int seed = 1; seed <= testing::costly_cases(6); ++seed) {
    DriveSimParams params = testing::usual_faults();
    params.sight.corner_sigma_px = 1.0;
    expect_true_claims(driven_unseen(two_tags_in_view(), params, static_cast<std::uint64_t>(seed)));
  }
}

/// The course on which at most stops one tag is in view.
DriveTask one_tag_in_view() {
  DriveTask task = two_tags_in_view();
  task.tags.tags = {upright_tag(1, {2, 1, 0.2}, pi), upright_tag(2, {1, 2.5, 0.2}, -pi / 2),
                    upright_tag(3, {0, 2, 0.2}, 0)};
  task.waypoints = {{{{0, 0}, 0}}, {{{1, 0}, 0}}, {{{1, 2}, pi}}, {{{0, 0}, 0}}};
  return task;
}

TEST(DriveClaims, ATagThatIsMovedOnTheWayConfirmsNoWrongStop) {
  for (int seed = 1; seed <= testing::costly_cases(8); ++seed) {
    for (const char* follower : {"pid", "time_optimal"}) {
      Rng rng(static_cast<std::uint64_t>(seed));
      DriveTask task = one_tag_in_view();
      task.follow.follower = follower;
      DriveSimParams params = testing::usual_faults();
      params.moved_tag = {1 + static_cast<std::int64_t>(rng.below(3)),
                          (seed % 2 == 0 ? 1.0 : -1.0) * rng.uniform(0.02, 0.4), rng.uniform(2.0, 50.0)};
      expect_true_claims(driven_unseen(task, params, static_cast<std::uint64_t>(seed)));
    }
  }
}

/// A tag that hangs about as far off as a stop may be teaches the robot that turns displace it, so that its
/// place by another tag, seen before the turn back, seems to agree.
TEST(DriveClaims, ATagThatHangsAFewCentimetresElsewhereConfirmsNoWrongStop) {
  for (int seed = 1; seed <= testing::costly_cases(20); ++seed) {
    Rng rng(static_cast<std::uint64_t>(seed));
    DriveSimParams params = testing::usual_faults();
    params.moved_tag = {1 + static_cast<std::int64_t>(rng.below(3)),
                        (seed % 3 == 0 ? 1.0 : -1.0) * rng.uniform(0.025, 0.045)};
    expect_true_claims(driven_unseen(one_tag_in_view(), params, static_cast<std::uint64_t>(seed)));
  }
}

/// One tag is in view at most stops, so the robot looks round for another, which agrees.
TEST(DriveClaims, ARobotThatSeesOneTagLooksRoundForAnother) {
  constexpr double most_look_s = 15.0;  // two turns and images in between, seldom twice
  for (int seed = 1; seed <= testing::costly_cases(4); ++seed) {
    DriveTask task = one_tag_in_view();
    const auto looks = driven_unseen(task, testing::usual_faults(), static_cast<std::uint64_t>(seed));
    task.rules.tags_move = false;
    const auto trusts = driven_unseen(task, testing::usual_faults(), static_cast<std::uint64_t>(seed));
    EXPECT_EQ(trusts.report.status, "done") << trusts.report.reason;
    EXPECT_EQ(looks.report.status, "done") << looks.report.reason;
    EXPECT_GT(metric(looks, "turned_rad"), metric(trusts, "turned_rad") + 1.0) << "it looked round";
    EXPECT_LE(metric(looks, "time_s"), metric(trusts, "time_s") + 3 * most_look_s) << "at three stops";
    EXPECT_LE(metric(looks, "driven_m"), 1.05 * metric(trusts, "driven_m"));
  }
}

TEST(DriveClaims, TagsOfAWrongSizeConfirmNoWrongStop) {
  for (int seed = 1; seed <= testing::costly_cases(8); ++seed) {
    for (const char* follower : {"pid", "time_optimal"}) {
      Rng rng(static_cast<std::uint64_t>(seed));
      DriveTask task = one_tag_in_view();
      task.follow.follower = follower;
      DriveSimParams params = testing::usual_faults();
      params.tag_scale = 1.0 + (seed % 2 == 0 ? 1.0 : -1.0) * rng.uniform(0.03, 0.1);
      expect_true_claims(driven_unseen(task, params, static_cast<std::uint64_t>(seed)));
    }
  }
}

/// One map, several worlds: tags are missing, exchanged or elsewhere.
TEST(DriveClaims, TagsOfAnotherWorldConfirmNoWrongStop) {
  for (int seed = 1; seed <= testing::costly_cases(8); ++seed) {
    Rng rng(static_cast<std::uint64_t>(seed));
    DriveTask task = one_tag_in_view();
    DriveSimParams params = testing::usual_faults();
    TagMap world;
    for (Tag tag : task.tags.tags) {
      const std::uint64_t change = rng.below(4);
      if (change == 1) continue;
      if (change == 2) tag.id += 100;
      if (change == 3)
        tag.world_T_tag.position =
            tag.world_T_tag.position + rng.uniform(0.1, 1.0) * tag.world_T_tag.rotation.axes[0];
      world.tags.push_back(tag);
    }
    params.tags = world;
    expect_true_claims(driven_unseen(task, params, static_cast<std::uint64_t>(seed)));
  }
}

/// Images that come late are fused at their own time: the drive is as good as with images that come at once.
TEST(DriveClaims, LateImagesCorrectTheBeliefOfTheirTime) {
  for (int seed = 1; seed <= testing::costly_cases(4); ++seed) {
    DriveTask task = two_tags_in_view();
    task.eye.latency_s = 0.3;
    task.rules.tags_move = false;  // three tags 2.5 m ahead tell no second opinion in time
    const auto run = driven_unseen(task, testing::usual_faults(), static_cast<std::uint64_t>(seed));
    EXPECT_EQ(run.report.status, "done") << run.report.reason;
    EXPECT_EQ(expect_true_claims(run), 3U);
    EXPECT_LE(metric(run, "belief_error_ratio"), 5.0);
  }
}

/// A waypoint that is no stop says how near the robot came to it, and one that was never next is not passed.
TEST(DriveClaims, APassedWaypointSaysHowNear) {
  DriveTask task = two_tags_in_view();
  task.waypoints = {{{{0.5, 0}, 0}, false}, {{{0.5, 0.4}, 0}}};
  const auto run = driven_unseen(task, testing::usual_faults(), 1);
  const Table& table = table_named(run.report, "waypoints");
  EXPECT_EQ((TableRow{table, table.rows[0]}.text("outcome")), "passed");
  EXPECT_LE(number(run, 0, "nearest_m"), task.follow.pass_m);
  task.rules.patience_s = 1.0;
  const auto cut = driven_unseen(task, testing::usual_faults(), 1);
  const Table& early = table_named(cut.report, "waypoints");
  EXPECT_EQ((TableRow{early, early.rows[0]}.text("outcome")), "not reached");
  EXPECT_GT(number(cut, 0, "nearest_m"), 0.1);
}

/// Behind a corner of 135 degrees the robot once waited for ever beside the waypoint that it had passed.
TEST(DriveClaims, EveryFollowerPassesASharpCorner) {
  for (const char* follower : {"pid", "pure_pursuit", "time_optimal"}) {
    for (int seed = 1; seed <= testing::costly_cases(2); ++seed) {
      DriveTask task = two_tags_in_view();
      task.follow.follower = follower;
      task.rules.tags_move = false;  // its times are those of the way, not of looking round
      task.waypoints = {{{{1, 0}, 0}, false}, {{{0, 1}, 0}}};
      const auto run = driven_unseen(task, testing::usual_faults(), static_cast<std::uint64_t>(seed));
      EXPECT_EQ(run.report.status, "done") << follower << ' ' << seed << ": " << run.report.reason;
      EXPECT_LE(number(run, 0, "nearest_m"), task.follow.pass_m);
      EXPECT_LE(metric(run, "time_s"), 20.0);
      EXPECT_LE(metric(run, "driven_m"), 1.05 * metric(run, "ideal_m"));
    }
  }
}

/// A waypoint behind the robot that it did not come near enough to is not called passed.
TEST(DriveClaims, AWaypointThatIsNotNearedIsMissed) {
  DriveTask task = two_tags_in_view();
  task.waypoints = {{{{0.5, 0}, 0}, false}, {{{0.5, 0.4}, 0}}};
  task.follow.pass_m = 0.001;
  const auto run = driven_unseen(task, testing::usual_faults(), 1);
  const Table& table = table_named(run.report, "waypoints");
  EXPECT_EQ((TableRow{table, table.rows[0]}.text("outcome")), "missed");
  EXPECT_GT(number(run, 0, "nearest_m"), task.follow.pass_m);
  EXPECT_EQ(run.report.status, "not_done");
  EXPECT_NE(run.report.reason.find("waypoint 1 was missed by 0."), std::string::npos) << run.report.reason;
}

}  // namespace
}  // namespace outrider
