#include "outrider/report/growth.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "outrider/core/rng.hpp"
#include "outrider/report/json.hpp"
#include "sample_explore.hpp"
#include "sample_report.hpp"
#include "support/random_cases.hpp"

namespace outrider {
namespace {

/// Everything that a report may tell of, in one.
PageReport everything() {
  PageReport report = test::sample_report();
  report.explore = test::sample_explore().explore;
  ReportDrive& drive = report.drive.emplace();
  drive.loop = "closed";
  drive.tags = {{1, {0.0, 1.0}, 0.0, 0.1}};
  drive.stops = {{{{1.0, 1.0}, 0.0}, true, 3.0, {}, 0.0}};
  ReportSlam& slam = report.slam.emplace();
  slam.engine = "laser";
  slam.map = report.explore->map;
  ReportPursuit& pursuit = report.pursuit.emplace();
  pursuit.columns = pursuit.rows = 1;
  pursuit.cost_runs = {5.0, 1.0};
  pursuit.robots.resize(2);
  for (int i = 0; i < 9; ++i) {
    const Vec2 at{0.1 * i, 1.0};
    drive.beliefs.push_back({1.0 * i, {at, 0.0}, 0.1, 0.1, 0.0, 0.1, false});
    slam.beliefs.push_back(drive.beliefs.back());
    slam.odometry.push_back(at);
    slam.reference.push_back(at);
    slam.scans.push_back({1.0 * i, {at, at}});
    slam.loops.push_back({1.0 * i, at, {}});
    slam.landmarks.push_back({i, 1.0 * i, at, 0.1, 0.2, 0.0, i, {}});
    pursuit.target.push_back(at);
    for (auto& way : pursuit.robots) way.push_back(at);
    pursuit.paid.push_back(i);
    pursuit.bounds.push_back({1.0 * i, 1.0, 2.0, 1.0});
  }
  return report;
}

template <class T>
void cut(std::vector<T>& list, double part) {
  list.resize(static_cast<std::size_t>(part * static_cast<double>(list.size())));
}

/// The report when that part of it had happened; the targets stand as they end from the middle on.
PageReport at(PageReport report, double part) {
  cut(report.paths, part);
  cut(report.shots, part);
  cut(report.events, part);
  cut(report.track, part);
  if (part < 0.5) {
    for (ReportTarget& target : report.targets) target.status = "waiting";
  }
  if (report.supplies) cut(report.supplies->levels, part);
  cut(report.drive->beliefs, part);
  if (part < 0.5) report.drive->stops[0].time_s = std::numeric_limits<double>::quiet_NaN();
  cut(report.explore->beliefs, part);
  cut(report.explore->decisions, part);
  if (part < 0.5) report.explore->map = {};
  cut(report.slam->beliefs, part);
  cut(report.slam->odometry, part);
  cut(report.slam->reference, part);
  cut(report.slam->scans, part);
  cut(report.slam->loops, part);
  cut(report.slam->landmarks, part);
  if (part < 0.5) report.slam->map.reset();
  for (auto* list : {&report.pursuit->target, &report.pursuit->robots[0], &report.pursuit->robots[1]})
    cut(*list, part);
  cut(report.pursuit->paid, part);
  cut(report.pursuit->bounds, part);
  return report;
}

template <class T>
void append(std::vector<T>& to, const std::vector<T>& from) {
  to.insert(to.end(), from.begin(), from.end());
}

template <class T>
void replace(std::vector<T>& old, const std::vector<T>& by) {
  if (!by.empty()) old = by;
}

void join(PageReport& joined, const PageReport& delta) {
  append(joined.paths, delta.paths);
  append(joined.shots, delta.shots);
  append(joined.events, delta.events);
  append(joined.track, delta.track);
  replace(joined.targets, delta.targets);
  if (delta.supplies) append(joined.supplies->levels, delta.supplies->levels);
  append(joined.drive->beliefs, delta.drive->beliefs);
  replace(joined.drive->stops, delta.drive->stops);
  append(joined.explore->beliefs, delta.explore->beliefs);
  append(joined.explore->decisions, delta.explore->decisions);
  if (delta.explore->map.columns > 0) joined.explore->map = delta.explore->map;
  append(joined.slam->beliefs, delta.slam->beliefs);
  append(joined.slam->odometry, delta.slam->odometry);
  append(joined.slam->reference, delta.slam->reference);
  append(joined.slam->scans, delta.slam->scans);
  replace(joined.slam->loops, delta.slam->loops);
  replace(joined.slam->landmarks, delta.slam->landmarks);
  if (delta.slam->map) joined.slam->map = delta.slam->map;
  append(joined.pursuit->target, delta.pursuit->target);
  append(joined.pursuit->paid, delta.pursuit->paid);
  append(joined.pursuit->bounds, delta.pursuit->bounds);
  joined.pursuit->robots.resize(2);
  for (std::size_t i = 0; i < 2; ++i) append(joined.pursuit->robots[i], delta.pursuit->robots[i]);
}

TEST(ReportGrowth, PutTogetherInAnyPartsItIsTheReport) {
  const PageReport whole = everything();
  PageReport expected = whole;
  expected.status = "running";
  expected.reason.clear();
  expected.metrics.clear();
  Rng rng(7);
  for (int i = 0; i < testing::cases(20); ++i) {
    ReportGrowth growth;
    PageReport joined = growth.delta(at(whole, 0.0));
    EXPECT_EQ(joined.job, whole.job);
    EXPECT_EQ(joined.solids.size(), whole.solids.size());
    std::vector<double> parts(static_cast<std::size_t>(i % 7));
    for (double& part : parts) part = rng.uniform();
    std::ranges::sort(parts);
    parts.push_back(1.0);
    for (const double part : parts) {
      const PageReport delta = growth.delta(at(whole, part));
      EXPECT_EQ(delta.job, "");
      EXPECT_TRUE(delta.solids.empty());
      join(joined, delta);
    }
    EXPECT_EQ(to_json(joined), to_json(expected));
  }
}

TEST(ReportGrowth, WhatIsToldIsNotToldAgain) {
  ReportGrowth growth;
  growth.delta(everything());
  const PageReport nothing = growth.delta(everything());
  EXPECT_TRUE(nothing.track.empty() && nothing.events.empty() && nothing.shots.empty() &&
              nothing.paths.empty());
  EXPECT_TRUE(nothing.targets.empty() && nothing.drive->stops.empty() && nothing.drive->beliefs.empty());
  EXPECT_TRUE(nothing.explore->beliefs.empty() && nothing.explore->map.columns == 0);
  EXPECT_TRUE(nothing.pursuit->robots[0].empty() && nothing.pursuit->paid.empty() &&
              nothing.pursuit->cost_runs.empty());
  EXPECT_TRUE(nothing.slam->beliefs.empty() && nothing.slam->scans.empty() && !nothing.slam->map);
  EXPECT_EQ(to_json_line(nothing).find('\n'), std::string::npos);
}

TEST(ReportGrowth, AnotherJobBeginsAnewAndItsListsGoOn) {
  ReportGrowth growth;
  PageReport report = everything();
  report.job = "explore";
  growth.delta(at(report, 0.5));
  report.job = "guard";
  const PageReport delta = growth.delta(report);
  EXPECT_EQ(delta.job, "guard");
  EXPECT_EQ(delta.solids.size(), report.solids.size());
  EXPECT_EQ(delta.track.size(), report.track.size() - at(report, 0.5).track.size());
}

}  // namespace
}  // namespace outrider
