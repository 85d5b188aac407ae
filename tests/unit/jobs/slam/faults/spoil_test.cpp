// Faults that spoil recordings: each changes what it says and nothing else, and the same seed the same.
#include "faults/spoil.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "graph/graph_log.hpp"

namespace outrider {
namespace {

/// 20 scans of 8 beams, one each second; beam b of scan i reads 1 + i + b / 10 m.
LaserLog laser_log() {
  LaserLog log;
  for (int i = 0; i < 20; ++i) {
    LaserScan scan{100.0 + i, 0.0, 0.1, 0.01, 50.0, {}};
    for (int beam = 0; beam < 8; ++beam)
      scan.ranges_m.push_back(1.0F + static_cast<float>(i) + 0.1F * static_cast<float>(beam));
    log.steps.push_back({Pose2{{0.2, 0.0}, 0.1}, scan});
    log.reference.push_back(Pose2{{0.2 * i, 0.0}, 0.0});
  }
  return log;
}

/// 20 steps, one each second, each of which sights the landmarks 3 and 7.
LandmarkLog landmark_log() {
  LandmarkLog log;
  log.timed = true;
  for (int i = 0; i < 20; ++i) {
    LogStep step{100.0 + i, Pose2{{0.5, 0.0}, 0.0}, 0.01 * (1 + i) * Eigen::Matrix3d::Identity(), {}};
    step.sightings = {sighted(3, 2.0 + 0.1 * i, 0.1, 0.1, 0.1), sighted(7, 4.0, -0.2, 0.1, 0.1)};
    log.steps.push_back(step);
  }
  return log;
}

Rng rng() { return Rng(1); }

Spoiled<LaserLog> spoiled_scans(const RecordingFaults& faults) {
  auto result = spoiled(laser_log(), faults, rng());
  EXPECT_TRUE(result.has_value()) << result.error().sentence;
  EXPECT_EQ(result->recording.reference.size(), result->recording.steps.size());
  return std::move(*result);
}

Spoiled<LandmarkLog> spoiled_sightings(const RecordingFaults& faults) {
  auto result = spoiled(landmark_log(), faults, rng());
  EXPECT_TRUE(result.has_value()) << result.error().sentence;
  return std::move(*result);
}

bool same_scan(const LaserLogStep& a, const LaserLogStep& b) {
  return a.motion == b.motion && a.scan.time_s == b.scan.time_s && a.scan.ranges_m == b.scan.ranges_m;
}

TEST(SpoilLaser, WithoutFaultsNothingChanges) {
  const auto result = spoiled_scans({});
  EXPECT_EQ(result.changes, 0U);
  EXPECT_TRUE(std::ranges::equal(result.recording.steps, laser_log().steps, same_scan));
}

TEST(SpoilLaser, ABlindLaserHasNoReadingForAWhile) {
  RecordingFaults faults;
  faults.blind_from_s = 5.0;
  faults.blind_for_s = 3.0;
  const auto result = spoiled_scans(faults);
  EXPECT_EQ(result.changes, 3U);
  ASSERT_EQ(result.recording.steps.size(), 20U);
  for (std::size_t i = 0; i < 20; ++i) {
    const bool blind = std::isnan(result.recording.steps[i].scan.ranges_m.front());
    EXPECT_EQ(blind, i >= 5 && i < 8) << i;
  }
}

TEST(SpoilLaser, TheMotionOfAScanThatIsLostIsKept) {
  RecordingFaults faults;
  faults.missed = 0.5;
  const auto result = spoiled_scans(faults);
  ASSERT_GT(result.changes, 3U);
  ASSERT_EQ(result.recording.steps.size(), 20U - result.changes);
  double turned_rad = 0.0;
  for (const LaserLogStep& step : result.recording.steps) turned_rad += step.motion.heading_rad;
  const double last_s = result.recording.steps.back().scan.time_s;
  EXPECT_NEAR(turned_rad, 0.1 * (last_s - 99.0), 1e-9);
}

TEST(SpoilLaser, BiasOutliersAndFrozenRanges) {
  RecordingFaults bias, outliers, frozen;
  bias.bias_m = -0.3;
  outliers.outliers = 0.25;
  frozen.frozen_from_s = 10.0;
  EXPECT_NEAR(spoiled_scans(bias).recording.steps[4].scan.ranges_m[2], 4.9, 1e-5);
  std::size_t other = 0;
  const auto with_outliers = spoiled_scans(outliers).recording;
  for (std::size_t i = 0; i < 20; ++i) {
    for (std::size_t beam = 0; beam < 8; ++beam)
      other += with_outliers.steps[i].scan.ranges_m[beam] != laser_log().steps[i].scan.ranges_m[beam] ? 1 : 0;
  }
  EXPECT_NEAR(static_cast<double>(other), 0.25 * 160, 20);
  const auto froze = spoiled_scans(frozen);
  EXPECT_EQ(froze.changes, 10U);
  EXPECT_EQ(froze.recording.steps.back().scan.ranges_m, laser_log().steps[9].scan.ranges_m);
  EXPECT_EQ(froze.recording.steps.back().scan.time_s, 119.0);
}

TEST(SpoilLaser, ALateScanIsRecordedWhereTheRobotIsThen) {
  RecordingFaults faults;
  faults.latency_s = 2.5;
  const auto result = spoiled_scans(faults);
  ASSERT_EQ(result.recording.steps.size(), 17U);
  EXPECT_EQ(result.recording.steps.front().scan.time_s, 103.0);
  EXPECT_EQ(result.recording.steps.front().scan.ranges_m, laser_log().steps.front().scan.ranges_m);
  EXPECT_NEAR(result.recording.reference.front().position.x, 0.6, 1e-12);
  EXPECT_NEAR(result.recording.steps.front().motion.heading_rad, 0.4, 1e-12);
}

TEST(SpoilLaser, WheelsThatSlipOrStick) {
  RecordingFaults slips, stuck;
  slips.slip = 0.2;
  stuck.stuck_from_s = 4.0;
  stuck.stuck_for_s = 2.0;
  EXPECT_NEAR(spoiled_scans(slips).recording.steps[3].motion.position.x, 0.25, 1e-12);
  const auto stood = spoiled_scans(stuck);
  EXPECT_EQ(stood.changes, 2U);
  EXPECT_EQ(stood.recording.steps[4].motion, Pose2{});
  EXPECT_NE(stood.recording.steps[6].motion, Pose2{});
}

TEST(SpoilLaser, AKidnappingLeavesNoPauseAndNoMotion) {
  RecordingFaults faults;
  faults.kidnapped_at_s = 5.0;
  faults.kidnapped_for_s = 4.0;
  const auto result = spoiled_scans(faults);
  EXPECT_EQ(result.changes, 4U);
  ASSERT_EQ(result.recording.steps.size(), 16U);
  EXPECT_EQ(result.recording.steps[5].scan.time_s, 105.0);
  EXPECT_EQ(result.recording.steps[5].scan.ranges_m, laser_log().steps[9].scan.ranges_m);
  EXPECT_EQ(result.recording.steps[5].motion, laser_log().steps[9].motion);
  faults.kidnapped_for_s = 1e9;  // the recording ends sooner, and nobody is carried
  EXPECT_EQ(spoiled_scans(faults).changes, 0U);
  faults.kidnapped_at_s = 0.0;
  EXPECT_FALSE(spoiled(laser_log(), faults, rng()).has_value());
}

TEST(SpoilLandmarks, WithoutFaultsNothingChanges) {
  const auto result = spoiled_sightings({});
  EXPECT_EQ(result.changes, 0U);
  EXPECT_EQ(result.recording.steps, landmark_log().steps);
}

TEST(SpoilLandmarks, SightingsAreLostLateOrRepeated) {
  RecordingFaults blind, missed, late, frozen;
  blind.blind_from_s = 5.0;
  missed.missed = 0.5;
  late.latency_s = 1.5;
  frozen.frozen_from_s = 10.0;
  EXPECT_TRUE(spoiled_sightings(blind).recording.steps[5].sightings.empty());
  std::size_t left = 0;
  for (const LogStep& step : spoiled_sightings(missed).recording.steps) left += step.sightings.size();
  EXPECT_GT(left, 8U);
  EXPECT_LT(left, 32U);
  const auto delayed = spoiled_sightings(late).recording.steps;
  EXPECT_TRUE(delayed[1].sightings.empty());
  EXPECT_EQ(delayed[2].sightings, landmark_log().steps[0].sightings);
  const auto froze = spoiled_sightings(frozen).recording.steps;
  EXPECT_EQ(froze[19].sightings, landmark_log().steps[9].sightings);
  EXPECT_EQ(froze[19].odometry, landmark_log().steps[19].odometry);
}

TEST(SpoilLandmarks, RangesOutliersAndIds) {
  RecordingFaults bias, outliers, ids;
  bias.bias_m = 0.5;
  outliers.outliers = 1.0;
  ids.wrong_ids = 1.0;
  EXPECT_NEAR(norm(spoiled_sightings(bias).recording.steps[0].sightings[1].position), 4.5, 1e-12);
  for (const LogStep& step : spoiled_sightings(outliers).recording.steps) {
    EXPECT_TRUE(check(step).has_value());
    for (const LandmarkSighting& sighting : step.sightings) EXPECT_LE(norm(sighting.position), 4.0 + 1e-9);
  }
  EXPECT_NE(spoiled_sightings(outliers).recording.steps[0].sightings, landmark_log().steps[0].sightings);
  const auto sightings = spoiled_sightings(ids).recording.steps[0].sightings;
  EXPECT_EQ(sightings[0].id, 7);
  EXPECT_EQ(sightings[1].id, 3);
  LandmarkLog one = landmark_log();
  for (LogStep& step : one.steps) step.sightings.pop_back();
  const auto refused = spoiled(one, ids, rng());
  ASSERT_FALSE(refused.has_value());
  EXPECT_EQ(refused.error().where, "faults.wrong_ids");
}

TEST(SpoilLandmarks, OdometryThatSticksIsAsSureAsAtRest) {
  RecordingFaults faults;
  faults.stuck_from_s = 4.0;
  const LogStep step = spoiled_sightings(faults).recording.steps[10];
  EXPECT_EQ(step.odometry, Pose2{});
  EXPECT_EQ(step.covariance, landmark_log().steps[0].covariance);
}

/// A square of four poses with two loops between poses and two points.
PoseGraph graph() {
  PoseGraph graph;
  for (int i = 0; i < 6; ++i) graph.nodes.push_back({std::to_string(i), {}, i >= 4});
  const auto add = [&](EdgeKind kind, std::uint32_t from, std::uint32_t to, Vec2 measured) {
    Eigen::Matrix3d information = Eigen::Matrix3d::Identity();
    if (kind == EdgeKind::point) information(2, 2) = 0.0;
    graph.edges.push_back({kind, from, to, {measured, 0.0}, information});
  };
  for (std::uint32_t i = 0; i < 3; ++i) add(EdgeKind::pose, i, i + 1, {1.0, 0.0});
  add(EdgeKind::pose, 0, 2, {2.0, 0.0});
  add(EdgeKind::pose, 0, 3, {3.0, 0.0});
  for (std::uint32_t i = 0; i < 3; ++i) {
    add(EdgeKind::point, i, 4, {2.0, 1.0});
    add(EdgeKind::point, i, 5, {4.0, -1.0});
  }
  return graph;
}

TEST(SpoilGraph, EachFaultChangesItsEdges) {
  RecordingFaults slips, bias, outliers, ids;
  slips.slip = 0.5;
  bias.bias_m = 0.1;
  outliers.outliers = 1.0;
  ids.wrong_ids = 1.0;
  const PoseGraph before = graph();
  const auto changed = [&](const RecordingFaults& faults, auto is_right) {
    const auto result = spoiled(before, faults, rng());
    ASSERT_TRUE(result.has_value()) << result.error().sentence;
    EXPECT_GT(result->changes, 0U);
    for (std::size_t i = 0; i < before.edges.size(); ++i)
      EXPECT_TRUE(is_right(before.edges[i], result->recording.edges[i])) << i;
  };
  const auto is_odometry = [](const GraphEdge& edge) {
    return edge.kind == EdgeKind::pose && edge.to == edge.from + 1;
  };
  changed(slips, [&](const GraphEdge& was, const GraphEdge& is) {
    return is_odometry(was) ? is.measured.position == 2.0 * was.measured.position : is == was;
  });
  changed(bias, [&](const GraphEdge& was, const GraphEdge& is) {
    const double longer_m = norm(is.measured.position) - norm(was.measured.position);
    return was.kind == EdgeKind::point ? std::abs(longer_m - 0.1) < 1e-12 : is == was;
  });
  changed(outliers, [&](const GraphEdge& was, const GraphEdge& is) {
    if (was.kind == EdgeKind::point) return is.to == was.to && !(is.measured == was.measured);
    return is_odometry(was) ? is == was : is.to != was.to && is.to != is.from;
  });
  changed(ids, [&](const GraphEdge& was, const GraphEdge& is) {
    return was.kind == EdgeKind::point ? is.to == (was.to == 4 ? 5U : 4U) : is == was;
  });
  EXPECT_EQ(spoiled(before, {}, rng())->changes, 0U);
}

TEST(SpoilGraph, WhatHasNoSuchEdgesIsRefused) {
  PoseGraph chain = graph();
  chain.edges.resize(3);
  chain.nodes.resize(4);
  RecordingFaults bias, outliers, ids;
  bias.bias_m = 0.1;
  outliers.outliers = 0.1;
  ids.wrong_ids = 0.1;
  const std::pair<RecordingFaults, const char*> cases[] = {
      {bias, "faults.bias"}, {outliers, "faults.outliers"}, {ids, "faults.wrong_ids"}};
  for (const auto& [faults, key] : cases) {
    const auto refused = spoiled(chain, faults, rng());
    ASSERT_FALSE(refused.has_value());
    EXPECT_EQ(refused.error().where, key);
  }
}

TEST(RecordingFaults, WhatAKindOfRecordingCannotHaveIsRefused) {
  RecordingFaults late, ids;
  late.latency_s = 0.1;
  ids.wrong_ids = 0.1;
  EXPECT_FALSE(RecordingFaults{}.any());
  EXPECT_TRUE(late.any());
  EXPECT_EQ(check(late, RecordingKind::graph).error().where, "faults.latency");
  EXPECT_EQ(check(ids, RecordingKind::laser).error().where, "faults.wrong_ids");
  EXPECT_TRUE(check(late, RecordingKind::laser).has_value());
  EXPECT_TRUE(check(late, RecordingKind::landmarks).has_value());
  EXPECT_TRUE(check(ids, RecordingKind::graph).has_value());
}

TEST(RecordingFaults, TheSameSeedGivesTheSameFaults) {
  RecordingFaults faults;
  faults.outliers = 0.3;
  faults.missed = 0.2;
  const auto one = spoiled(laser_log(), faults, Rng(5)), same = spoiled(laser_log(), faults, Rng(5)),
             other = spoiled(laser_log(), faults, Rng(6));
  EXPECT_TRUE(std::ranges::equal(one->recording.steps, same->recording.steps, same_scan));
  EXPECT_FALSE(std::ranges::equal(one->recording.steps, other->recording.steps, same_scan));
}

}  // namespace
}  // namespace outrider
