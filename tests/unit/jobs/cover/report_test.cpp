#include "outrider/jobs/cover/report.hpp"

#include <gtest/gtest.h>

#include "outrider/core/units.hpp"
#include "outrider/jobs/cover/mission/mission.hpp"
#include "outrider/log/messages/motion_messages.hpp"
#include "support/cover_areas.hpp"
#include "support/logged_run.hpp"
#include "support/random_cases.hpp"

namespace outrider {
namespace {

CoverRun run_of(const CoverProblem& problem, const char* method, std::uint64_t seed) {
  auto plan = find_cover_method(method)->plan(problem, testing::any_order(), {});
  if (!plan) throw std::runtime_error(to_string(plan.error()));
  auto proof = prove(*plan, problem);
  if (!proof) throw std::runtime_error(to_string(proof.error()));
  CoverRun run{std::move(*plan), std::move(*proof), {}, {}, {}};
  run.bound = time_bound(run.plan.track, problem.pace, problem.tracking_error_m, 1.0);
  run.drive =
      drive_track(run.plan.track, *run.plan.ground.ground, problem.pace, problem.tracking_error_m, seed);
  run.driven = coverage_of(run.drive.way, problem.radius_m(), run.plan.ground.reach);
  return run;
}

/// Two small areas and what was driven on them.
struct Case {
  CoverProblem problem;
  CoverRun run;
  Log log;
};

std::vector<Case> made_cases() {
  CoverProblem room;
  room.boundary = {{0, 0}, {1.5, 0}, {1.5, 1.5}, {0, 1.5}};
  room.tracking_error_m = 0.005;
  Rng rng(17);
  std::vector<CoverProblem> problems{room};
  for (int k = testing::cases(1); k > 0; --k) problems.push_back(testing::random_cover_problem(rng));
  std::vector<Case> cases;
  for (const CoverProblem& problem : problems) {
    CoverRun run = run_of(problem, cases.empty() ? "spiral" : "boustrophedon", 3);
    Log log;
    CoverLog logged(log, problem, run.plan, 3, "area");
    logged.note(run.drive);
    logged.finish(run.drive, run.driven);
    EXPECT_EQ(cover_report(problem, run, "area").status, "done");
    cases.push_back({problem, std::move(run), std::move(log)});
  }
  return cases;
}

const std::vector<Case>& all_cases() {
  static const std::vector<Case> cases = made_cases();
  return cases;
}

/// The way until then.
std::vector<Vec2> way_until(const std::vector<TimedPose>& track, double time_s) {
  std::vector<Vec2> way;
  for (std::size_t i = 0; i < track.size() && track[i].time_s <= time_s; ++i)
    way.push_back(track[i].pose.position);
  if (way.size() < track.size()) {
    const TimedPose &a = track[way.size() - 1], &b = track[way.size()];
    const double part = (time_s - a.time_s) / (b.time_s - a.time_s);
    way.push_back(a.pose.position + part * (b.pose.position - a.pose.position));
  }
  return way;
}

TEST(CoverReport, TheTrackIsTheDrive) {
  for (const auto& [problem, run, log] : all_cases()) {
    const auto& track = run.drive.track;
    const auto logged = testing::track_of(log);
    ASSERT_EQ(logged.size(), track.size());
    for (std::size_t i = 0; i < track.size(); ++i) {
      EXPECT_EQ(nanoseconds(logged[i].time_s), nanoseconds(track[i].time_s));
      EXPECT_EQ(logged[i].pose.position, track[i].pose.position);
      EXPECT_NEAR(wrap_angle(logged[i].pose.heading_rad - track[i].pose.heading_rad), 0.0, 1e-12);
    }
    EXPECT_EQ(track.front().time_s, 0.0);
    EXPECT_EQ(track.front().pose.position, run.drive.way.front());
    EXPECT_EQ(track.back().time_s, run.drive.time_s);
    EXPECT_EQ(track.back().pose.position, run.drive.way.back());
    double length = 0.0;
    for (std::size_t i = 1; i < track.size(); ++i)
      length += distance(track[i - 1].pose.position, track[i].pose.position);
    EXPECT_NEAR(length, run.drive.length_m, 1e-9 * length);
    std::size_t found = 0;  // every point of the way, at its time
    for (const TimedPose& sample : track) {
      if (found < run.drive.way.size() && sample.time_s == run.drive.times_s[found]) {
        EXPECT_EQ(sample.pose.position, run.drive.way[found]);
        ++found;
      }
    }
    EXPECT_EQ(found, run.drive.way.size());
  }
}

/// From the samples alone: no faster than the robot goes, no jump of the speed, and it looks where it goes.
TEST(CoverReport, TheTrackKeepsTheLimitsOfTheRobot) {
  for (const auto& [problem, run, log] : all_cases()) {
    const Pace& pace = problem.pace;
    const auto& track = run.drive.track;
    double speed_before = 0.0, rate_before = 0.0, span_before = 0.0;
    for (std::size_t i = 1; i < track.size(); ++i) {
      const TimedPose &a = track[i - 1], &b = track[i];
      const double span = b.time_s - a.time_s;
      ASSERT_GT(span, 0.0);
      const double way = distance(a.pose.position, b.pose.position), speed = way / span;
      const double turn = wrap_angle(b.pose.heading_rad - a.pose.heading_rad);
      const double rate = speed > 0.0 ? 0.0 : std::abs(turn) / span;
      EXPECT_LE(speed, pace.speed_mps * (1.0 + 1e-9));
      EXPECT_LE(rate, pace.turn_rate_radps * (1.0 + 1e-9));
      const double mean_span = 0.5 * (span + span_before);
      EXPECT_LE(std::abs(speed - speed_before), pace.acceleration_mps2 * mean_span * (1.0 + 1e-6) + 1e-9);
      EXPECT_LE(std::abs(rate - rate_before),
                pace.turn_acceleration_radps2 * mean_span * (1.0 + 1e-6) + 1e-9);
      if (way > 0.0) {
        const double goes = heading_of(b.pose.position - a.pose.position);
        EXPECT_LT(std::abs(wrap_angle(goes - a.pose.heading_rad)), radians(2.0)) << a.time_s;
      }
      speed_before = speed;
      rate_before = rate;
      span_before = span;
    }
  }
}

TEST(CoverReport, WhatIsCoveredByThenAgreesWithARaster) {
  for (const auto& [problem, run, log] : all_cases()) {
    const auto& rows = log.messages<outrider_msgs::Coverage>(topic::coverage);
    const double reach = area_of(run.plan.ground.reach);
    ASSERT_GE(rows.size(), 61U);
    for (std::size_t i = 1; i < rows.size(); ++i) {
      EXPECT_GT(rows[i].time_ns, rows[i - 1].time_ns);
      EXPECT_GE(rows[i].message.covered, rows[i - 1].message.covered - 1e-9 * reach);
      EXPECT_GE(rows[i].message.overlap, rows[i - 1].message.overlap - 1e-9 * reach);
    }
    EXPECT_NEAR(rows.back().message.covered, run.driven.covered_m2, 1e-4 * reach);
    EXPECT_NEAR(rows.back().message.overlap, run.driven.overlap_m2, 2e-3 * reach);
    const Box2 box = bounds_of(run.plan.ground.reach);
    const double cell = box.size().x / 120.0;
    for (const std::size_t i : {0U, 17U, 41U}) {
      const auto way = way_until(run.drive.track, rows[i].time_s());
      double covered = 0.0, overlap = 0.0;
      for (double x = box.low.x + 0.5 * cell; x < box.high.x; x += cell) {
        for (double y = box.low.y + 0.5 * cell; y < box.high.y; y += cell) {
          if (!contains(run.plan.ground.reach, {x, y})) continue;
          const int passes = way.size() > 1 ? testing::passes_over({x, y}, way, problem.radius_m())
                                            : norm(Vec2{x, y} - way[0]) <= problem.radius_m();
          covered += passes >= 1 ? cell * cell : 0.0;
          overlap += passes >= 2 ? cell * cell : 0.0;
        }
      }
      EXPECT_NEAR(rows[i].message.covered, covered, 0.005 * reach) << i;
      EXPECT_NEAR(rows[i].message.overlap, overlap, 0.007 * reach) << i;
    }
  }
}

TEST(CoverReport, PassesAndEventsTellTheWholeDrive) {
  for (const auto& [problem, run, log] : all_cases()) {
    const auto& passes = log.messages<outrider_msgs::CoveragePass>(topic::coverage_passes);
    EXPECT_EQ(passes.front().time_ns, 0);
    EXPECT_LT(passes.back().time_s(), run.drive.time_s);
    for (std::size_t i = 1; i < passes.size(); ++i) {
      EXPECT_GT(passes[i].time_ns, passes[i - 1].time_ns);
    }
    const auto with_role = [&](const char* role) {
      return static_cast<std::size_t>(
          std::ranges::count_if(passes, [&](const auto& pass) { return pass.message.role == role; }));
    };
    EXPECT_EQ(with_role("lap"), run.plan.laps);
    EXPECT_EQ(with_role("lane"), run.plan.lanes);
    for (const auto& [kind, many] : {std::pair{"lap", run.plan.laps}, {"cell", run.plan.cells}}) {
      EXPECT_EQ(events_of(log, kind).size(), many);
    }
    EXPECT_TRUE(testing::stamps_are_sorted(log));
    EXPECT_EQ(events_of(log).back().message.name, "done");
  }
}

}  // namespace
}  // namespace outrider
