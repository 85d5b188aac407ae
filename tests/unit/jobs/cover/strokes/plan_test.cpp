#include "outrider/jobs/cover/strokes/plan.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "outrider/core/units.hpp"
#include "outrider/jobs/cover/bounds/time_bound.hpp"
#include "support/cover_areas.hpp"
#include "support/random_cases.hpp"

namespace outrider {
namespace {

CoverProblem room(double edge_m) {
  CoverProblem problem;
  problem.boundary = {{0, 0}, {edge_m, 0}, {edge_m, edge_m}, {0, edge_m}};
  problem.width_m = 0.2;
  problem.overlap = 1.0 - 1.0 / 1.1;  // strips cover 110 %
  return problem;
}

CoverPlan planned(const CoverProblem& problem, std::string_view method) {
  const auto row = find_cover_method(method);
  auto plan = row->plan(problem, {}, {});
  if (!plan) throw std::runtime_error(to_string(plan.error()));
  return std::move(*plan);
}

/// Smallest distance between the track and an edge, at points of it no farther apart than a thousandth of
/// the width; with the centre of the robot where the polygons allow it.
double sampled_clearance(const CoverPlan& plan, const CoverProblem& problem) {
  double least = std::numeric_limits<double>::infinity();
  const auto look_at = [&](const std::vector<Vec2>& ring, Vec2 p) {
    for (std::size_t i = 0; i < ring.size(); ++i) {
      least = std::min(least, distance(p, Segment{ring[i], ring[(i + 1) % ring.size()]}));
    }
  };
  const auto points = points_along(plan.track.start.position, plan.track.pieces, radians(2.0));
  for (std::size_t i = 1; i < points.size(); ++i) {
    const int steps = 1 + static_cast<int>(distance(points[i - 1], points[i]) / (0.05 * problem.width_m));
    for (int k = 0; k <= steps; ++k) {
      const Vec2 p = points[i - 1] + (static_cast<double>(k) / steps) * (points[i] - points[i - 1]);
      look_at(problem.boundary, p);
      for (const auto& hole : problem.holes) look_at(hole, p);
    }
  }
  return least;
}

TEST(CoverPlan, TheRoomByEveryMethod) {
  for (const double edge : {1.5, 1.7}) {
    for (const CoverMethod& method : cover_methods()) {
      const CoverProblem problem = room(edge);
      const CoverPlan plan = planned(problem, method.name);
      const auto proof = prove(plan, problem);
      ASSERT_TRUE(proof) << to_string(proof.error());
      EXPECT_GE(proof->planned.fraction, 0.995) << method.name;
      EXPECT_NEAR(proof->clearance_m, 0.1, 1e-8);
      EXPECT_LT(plan.sums.time_s, 176.0) << "the reference takes 176 s";
      EXPECT_NEAR(area_of(plan.ground.reach), edge * edge - (4.0 - pi) * 0.01, 1e-4);
    }
  }
}

TEST(CoverPlan, TheSpiralOfASquareIsTheReports) {
  CoverProblem problem = room(1.7);  // its outermost lap is a square with an edge of 1.5 m
  const CoverPlan plan = planned(problem, "spiral");
  EXPECT_EQ(plan.laps, 5U);
  double laps = 0.0;
  for (std::size_t i = 0; i < plan.roles.size(); ++i) {
    if (plan.roles[i] == PieceRole::lap) laps += length_of(plan.track.pieces[i]);
  }
  EXPECT_NEAR(laps, squares_length_m(1.5, problem.stride_m(), 5), 1e-9);
}

TEST(CoverPlan, ATrackingErrorWithinTheOverlapLeavesOnlyTheRimUncovered) {
  for (const CoverMethod& method : cover_methods()) {
    CoverProblem problem = room(1.5);
    problem.tracking_error_m = 0.009;
    const CoverPlan plan = planned(problem, method.name);
    const auto proof = prove(plan, problem);
    ASSERT_TRUE(proof) << to_string(proof.error());
    EXPECT_GE(proof->inner_fraction, 1.0 - problem.uncovered - 1e-3) << method.name;
    EXPECT_LT(proof->sure_fraction, proof->planned.fraction);
    EXPECT_LT(plan.sums.time_s, 176.0) << method.name;
  }
}

/// Random areas with holes: covered against a raster of exact disks, the track clear of every edge.
TEST(CoverPlan, RandomAreasAgainstARaster) {
  Rng rng(23);
  for (int k = 0; k < testing::cases(2); ++k) {
    const CoverProblem problem = testing::random_cover_problem(rng);
    const std::string_view method = cover_methods()[rng.below(2)].name;
    const CoverPlan plan = planned(problem, method);
    const auto proof = prove(plan, problem);
    ASSERT_TRUE(proof) << k << ": " << to_string(proof.error());
    EXPECT_GE(proof->planned.fraction, 0.995) << k;
    EXPECT_GE(sampled_clearance(plan, problem), problem.radius_m() * (1.0 - 2e-4)) << k;
    const auto way = points_along(plan.track.start.position, plan.track.pieces, radians(2.0));
    const double cell = 0.1 * problem.width_m;
    double reach = 0.0, covered = 0.0, overlap = 0.0;
    for (double x = -6.0; x < 6.0; x += cell) {
      for (double y = -6.0; y < 6.0; y += cell) {
        if (!contains(plan.ground.reach, {x, y})) continue;
        const int passes = testing::passes_over({x, y}, way, problem.radius_m());
        reach += cell * cell;
        covered += passes >= 1 ? cell * cell : 0.0;
        overlap += passes >= 2 ? cell * cell : 0.0;
      }
    }
    EXPECT_NEAR(area_of(plan.ground.reach) / reach, 1.0, 0.01) << k;
    EXPECT_NEAR(proof->planned.covered_m2 / reach, covered / reach, 0.01) << k;
    EXPECT_NEAR(proof->planned.overlap_m2 / reach, overlap / reach, 0.015) << k;
  }
}

TEST(CoverPlan, BeginsWhereTheRobotStandsAndLeavesOtherRoomsAlone) {
  CoverProblem problem;
  problem.boundary = {{0, 0}, {9, 0}, {9, 4}, {0, 4}};
  problem.holes = {{{4, 0}, {5, 0}, {5, 4}, {4, 4}}};  // a wall between two rooms
  problem.width_m = 0.5;
  problem.start = Pose2{{7.0, 2.0}, 0.3};
  const CoverPlan plan = planned(problem, "boustrophedon");
  EXPECT_EQ(plan.track.start, *problem.start);
  EXPECT_NEAR(area_of(plan.ground.reach), 16.0 - (4.0 - pi) * 0.0625, 1e-3);
  for (const PathPiece& piece : plan.track.pieces) EXPECT_GT(piece.to.x, 5.0);
  EXPECT_TRUE(prove(plan, problem));
}

/// Two fields 4 m apart, a hole in the first; the straight way between them is free.
CoverProblem two_fields() {
  CoverProblem problem;
  problem.boundary = {{0, 0}, {8, 0}, {8, 3}, {3, 3}, {3, 8}, {0, 8}};  // an L
  problem.holes = {{{1, 4}, {2, 4}, {2, 5}, {1, 5}}};
  problem.others = {{{{12, 0}, {16, 0}, {16, 5}, {12, 5}}, {}}};
  problem.width_m = 0.5;
  problem.transfers = true;
  return problem;
}

TEST(CoverPlan, AreasApartAreCoveredInOneTrackWithTransfers) {
  const CoverProblem problem = two_fields();
  for (const char* method : {"boustrophedon", "spiral"}) {
    const CoverPlan plan = planned(problem, method);
    const auto proof = prove(plan, problem);
    ASSERT_TRUE(proof) << method << ": " << to_string(proof.error());
    ASSERT_EQ(proof->fields.size(), 2U);
    for (const FieldProof& field : proof->fields) EXPECT_GE(field.planned_fraction, 0.997) << method;
    EXPECT_NEAR(area_of(plan.ground.area), 39.0 - 1.0 + 20.0, 1e-4);
    double transfers = 0.0;
    for (std::size_t i = 0; i < plan.roles.size(); ++i) {
      const PathPiece& piece = plan.track.pieces[i];
      const bool within = contains(plan.ground.area, piece.from) && contains(plan.ground.area, piece.to) &&
                          contains(plan.ground.area, 0.5 * (piece.from + piece.to));
      if (plan.roles[i] == PieceRole::transfer) transfers += length_of(piece);
      if (plan.roles[i] != PieceRole::transfer) {
        EXPECT_TRUE(within) << method << ", piece " << i << " leaves its area";
      }
    }
    EXPECT_GE(transfers, 4.5 - 1e-6) << "each field once, from one room of the centre to the other";
    EXPECT_LT(transfers, 15.0);
  }
}

TEST(CoverPlan, TransfersKeepAwayFromHolesAndMayBeginOutside) {
  CoverProblem problem = two_fields();
  problem.start = Pose2{{10.0, 7.0}, 0.0};  // outside of both
  CoverPlan plan = planned(problem, "boustrophedon");
  EXPECT_TRUE(prove(plan, problem));
  EXPECT_EQ(plan.track.start, *problem.start);
  // A leg through the hole, called a transfer, is refused.
  plan.track.pieces.push_back({plan.track.pieces.back().to, {1.5, 4.5}, {}, 0.0});
  plan.roles.push_back(PieceRole::transfer);
  EXPECT_FALSE(prove(plan, problem));
}

TEST(CoverPlan, AFieldThatIsLeftOutIsNoticed) {
  const CoverProblem problem = two_fields();
  CoverPlan plan = planned(problem, "boustrophedon");
  std::size_t far = plan.track.pieces.size();
  while (far > 0 && plan.roles[far - 1] != PieceRole::transfer) --far;
  ASSERT_GT(far, 0U);
  plan.track.pieces.resize(far - 1);
  plan.roles.resize(far - 1);
  EXPECT_FALSE(prove(plan, problem));
}

TEST(CoverPlan, TouchingAreasAreOne) {
  CoverProblem problem;
  problem.boundary = {{0, 0}, {4, 0}, {4, 4}, {0, 4}};
  problem.others = {{{{4, 0}, {8, 0}, {8, 4}, {4, 4}}, {}}};
  problem.width_m = 0.5;
  const CoverPlan plan = planned(problem, "boustrophedon");
  EXPECT_EQ(plan.ground.fields.size(), 1U);
  EXPECT_EQ(plan.laps, 1U);
  EXPECT_TRUE(prove(plan, problem));
}

TEST(CoverPlan, SameProblemSameTrack) {
  Rng rng(3);
  const CoverProblem problem = testing::random_cover_problem(rng);
  for (const char* method : {"boustrophedon", "spiral"}) {
    EXPECT_EQ(planned(problem, method).track.pieces, planned(problem, method).track.pieces);
  }
}

/// No order that a longer search with another seed finds is quicker than the bound that is stated.
TEST(CoverPlan, NoOrderIsQuickerThanItsBound) {
  Rng rng(77);
  for (int k = 0; k < testing::cases(2); ++k) {
    const CoverProblem problem = testing::random_cover_problem(rng);
    const CoverMethod method = *find_cover_method("spiral");
    CoverOptions hasty, thorough;
    hasty.order.iterations = 50;
    hasty.order.gap = 1.0;
    thorough.order.iterations = 20'000;
    thorough.order.seed = 2;
    const auto bounded = method.plan(problem, hasty, {}), best = method.plan(problem, thorough, {});
    ASSERT_TRUE(bounded && best);
    EXPECT_LE(bounded->order_bound_s, best->sums.time_s + 1e-6) << k;
    EXPECT_LE(best->order_bound_s, best->sums.time_s + 1e-6) << k;
  }
}

TEST(CoverPlan, TheJudgeRefusesWhatIsWrong) {
  const CoverProblem problem = room(1.5);
  const CoverPlan plan = planned(problem, "boustrophedon");
  CoverPlan gap = plan;
  gap.track.pieces.erase(gap.track.pieces.begin() + 5);
  gap.roles.erase(gap.roles.begin() + 5);
  EXPECT_FALSE(prove(gap, problem));
  CoverPlan half = plan;
  half.track.pieces.resize(half.track.pieces.size() / 2);
  half.roles.resize(half.track.pieces.size());
  EXPECT_FALSE(prove(half, problem));
  CoverPlan outside = plan;
  outside.track.pieces.push_back({outside.track.pieces.back().to, {0.75, 2.0}, {}, 0.0});
  outside.roles.push_back(PieceRole::transfer);
  EXPECT_FALSE(prove(outside, problem));
  CoverPlan bare = plan;
  bare.roles.pop_back();
  const auto judged = prove(bare, problem);
  ASSERT_FALSE(judged);
  EXPECT_NE(judged.error().sentence.find("pieces and roles of"), std::string::npos);
}

void expect_refused(const CoverProblem& problem, const std::string& where, const std::string& says) {
  const auto ground = cover_ground(problem);
  ASSERT_FALSE(ground) << says;
  EXPECT_EQ(ground.error().where, where);
  EXPECT_NE(ground.error().sentence.find(says), std::string::npos) << ground.error().sentence;
}

/// Hopeless areas are refused before memory is taken, with the number of strips and their length.
TEST(CoverPlan, HopelessAreasAreRefusedWithTheEstimate) {
  CoverProblem field = room(9000.0);
  field.overlap = 0.1;
  for (const CoverMethod& method : cover_methods()) {
    const auto plan = method.plan(field, {}, {});
    ASSERT_FALSE(plan) << method.name;
    EXPECT_EQ(plan.error().code, FaultCode::bad_input);
    EXPECT_EQ(plan.error().where, "area");
    for (const char* part : {"9000 x 9000 m", "50000 strips", "0.18 m apart", "4.5e+05 km"})
      EXPECT_NE(plan.error().sentence.find(part), std::string::npos) << plan.error().sentence;
  }
  field.width_m = 20.0;
  EXPECT_TRUE(cover_ground(field)) << "500 strips are not many";
  field.turning_radius_m = 500.0;
  const auto curves = cover_ground(field);
  ASSERT_FALSE(curves) << "curves that are many strips wide make them hopeless";
  EXPECT_NE(curves.error().sentence.find("curves are 27.8 strips wide"), std::string::npos)
      << curves.error().sentence;
  field.turning_radius_m = 40.0;
  EXPECT_TRUE(cover_ground(field));
}

TEST(CoverPlan, EveryMethodHearsAStop) {
  std::stop_source source;
  source.request_stop();
  Budget stopped;
  stopped.stop = source.get_token();
  CoverProblem curves = room(6.0), bar = room(6.0);
  curves.turning_radius_m = 0.4;
  bar.tool = {.shape = "bar", .width_m = 0.4, .length_m = 0.1, .forward_m = 0.2};
  for (const CoverMethod& method : cover_methods()) {
    for (const CoverProblem& problem : {room(3.0), curves, bar}) {
      if (method.name == "spiral" && problem.bar()) continue;  // not planned
      const auto plan = method.plan(problem, {}, stopped);
      ASSERT_FALSE(plan) << method.name;
      EXPECT_EQ(plan.error().code, FaultCode::cancelled) << method.name << ": " << to_string(plan.error());
    }
  }
  const CoverProblem problem = room(3.0);
  const auto proof = prove(planned(problem, "boustrophedon"), problem, stopped);
  ASSERT_FALSE(proof);
  EXPECT_EQ(proof.error().code, FaultCode::cancelled) << to_string(proof.error());
}

TEST(CoverPlan, BadInputIsRefusedInASentence) {
  CoverProblem wide = room(1.5);
  wide.width_m = 2.0;
  expect_refused(wide, "width", "the widest that does has 1.5 m");
  for (const double width : {0.0, -1.0}) {
    CoverProblem none = room(1.5);
    none.width_m = width;
    expect_refused(none, "width", "give 0.002 to");
  }
  CoverProblem crossed = room(1.5);
  std::swap(crossed.boundary[1], crossed.boundary[2]);
  expect_refused(crossed, "boundary", "cross");
  CoverProblem out = room(1.5);
  out.holes = {{{0.5, 0.5}, {0.6, 0.5}, {0.6, 0.6}}, {{1.4, 0.5}, {1.8, 0.5}, {1.8, 0.8}}};
  expect_refused(out, "hole 2", "outside the boundary");
  CoverProblem loose = room(1.5);
  loose.tracking_error_m = 0.02;
  expect_refused(loose, "tracking_error", "an overlap of at least 0.2");
  loose.tracking_error_m = 0.1;
  expect_refused(loose, "tracking_error",
                 "an overlap of 0.9 with a width of at least 0.2223 m; at this width no");
  loose.width_m = 0.2223;
  loose.overlap = 0.9;
  EXPECT_TRUE(cover_ground(loose)) << "the remedy is one";
  CoverProblem blocked = room(1.5);
  blocked.start = Pose2{{0.05, 0.05}, 0.0};
  expect_refused(blocked, "start", "cannot stand");
  blocked.start = Pose2{{-1.0, 0.05}, 0.0};
  expect_refused(blocked, "start", "outside");
  CoverProblem apart = two_fields();
  apart.transfers = false;
  expect_refused(apart, "transfers", "2 areas lie apart; allow transfers");
  apart.transfers = true;
  apart.others = {{{{1.2, 4.2}, {1.8, 4.2}, {1.8, 4.8}, {1.2, 4.8}}, {}}};
  apart.width_m = 0.2;
  expect_refused(apart, "area", "lies in a hole of another");
  CoverProblem hasty = room(1.5);
  hasty.pace.slowest_speed_mps = 1.0;
  expect_refused(hasty, "pace.slowest_speed", "above the speed");
}

}  // namespace
}  // namespace outrider
