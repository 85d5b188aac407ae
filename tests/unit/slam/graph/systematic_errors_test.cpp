#include "outrider/slam/graph/systematic_errors.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <string_view>

#include "outrider/core/rng.hpp"
#include "outrider/core/units.hpp"
#include "outrider/slam/graph/pose_graph_doubt.hpp"
#include "outrider/slam/map_error.hpp"
#include "support/random_cases.hpp"

namespace outrider {
namespace {

constexpr double way_sd_m = 0.05, turn_sd_rad = 0.035, sight_sd_m = 0.05;

/// The errors that all measurements of a kind have in common.
struct Wrong {
  double ways = 0.0, turns = 0.0, range_m = 0.0, range_part = 0.0;
};

/// Two laps of a square of 6 m with posts at its sides, and its measurements.
struct Yard {
  PoseGraph graph;
  std::vector<Pose2> truth;

  Yard(Rng rng, const Wrong& wrong, double noise = 1.0) {
    for (int step = 0; step <= 24; ++step) {
      const Vec2 corners[] = {{0.0, 0.0}, {6.0, 0.0}, {6.0, 6.0}, {0.0, 6.0}};
      const auto side = static_cast<std::size_t>(step / 3 % 4);
      const Vec2 at = corners[side] + (step % 3 / 3.0) * (corners[(side + 1) % 4] - corners[side]);
      truth.push_back({at, wrap_angle(static_cast<double>(side) * 0.5 * pi)});
    }
    const std::size_t poses = truth.size();
    for (const Vec2 post : {Vec2{3.0, 3.2}, Vec2{7.5, 2.0}, Vec2{2.0, 7.5}, Vec2{-1.5, 4.0}})
      truth.push_back({post, 0.0});
    for (std::size_t i = 0; i < truth.size(); ++i) graph.nodes.push_back({"", {}, i >= poses});
    for (std::uint32_t i = 0; i < poses; ++i) {
      if (i > 0) add_odometry(i, wrong, noise, rng);
      for (std::uint32_t k = static_cast<std::uint32_t>(poses); k < truth.size(); ++k) {
        if (distance(truth[i].position, truth[k].position) < 4.5) add_sighting(i, k, wrong, noise, rng);
      }
    }
  }

  void add_odometry(std::uint32_t to, const Wrong& wrong, double noise, Rng& rng) {
    const Pose2 moved = relative_pose(truth[to - 1], truth[to]);
    GraphEdge edge;
    edge.from = to - 1;
    edge.to = to;
    edge.measured.position =
        (1.0 + wrong.ways) * moved.position + noise * way_sd_m * Vec2{rng.normal(), rng.normal()};
    edge.measured.heading_rad =
        (1.0 + wrong.turns) * wrap_angle(moved.heading_rad) + noise * turn_sd_rad * rng.normal();
    edge.information =
        Eigen::Vector3d(std::pow(way_sd_m, -2), std::pow(way_sd_m, -2), std::pow(turn_sd_rad, -2))
            .asDiagonal();
    graph.edges.push_back(edge);
  }
  void add_sighting(std::uint32_t from, std::uint32_t to, const Wrong& wrong, double noise, Rng& rng) {
    const Vec2 seen = truth[from].to_local(truth[to].position);
    GraphEdge edge;
    edge.kind = EdgeKind::point;
    edge.from = from;
    edge.to = to;
    edge.measured.position = (1.0 + wrong.range_part + wrong.range_m / norm(seen)) * seen +
                             noise * sight_sd_m * Vec2{rng.normal(), rng.normal()};
    edge.information.topLeftCorner<2, 2>() = Eigen::Matrix2d::Identity() * std::pow(sight_sd_m, -2);
    graph.edges.push_back(edge);
  }

  [[nodiscard]] double landmark_error_m(const std::vector<Pose2>& poses) const {
    std::vector<Vec2> map, there;
    for (std::size_t i = 0; i < truth.size(); ++i) {
      if (!graph.nodes[i].is_point) continue;
      map.push_back(poses[i].position);
      there.push_back(truth[i].position);
    }
    return rms_distance(map, there, rigid_alignment(map, there)).value();
  }
};

std::vector<Pose2> solved(const PoseGraph& graph) { return optimise(graph, {}, {})->poses; }

TEST(SystematicErrors, AHealthyMapIsBelieved) {
  const Rng rng(1);
  const int maps = testing::cases(100);
  int doubted = 0;
  for (int i = 0; i < maps; ++i) {
    const Yard yard(rng.child(std::to_string(i)), {});
    const std::vector<Pose2> poses = solved(yard.graph);
    ASSERT_LT(yard.landmark_error_m(poses), 0.1);
    doubted += why_not_believed(find_systematic_errors(yard.graph, poses)).empty() ? 0 : 1;
  }
  EXPECT_LE(doubted, maps / 100) << "chance makes one in 200 at most";
}

/// Solves yards in which that is wrong, and expects doubt of those that are wrong and look plausible, but for
/// that part of them, which chance hides.
void expect_doubts(std::string_view what, const std::function<Wrong(Rng&)>& draw, double most_hidden) {
  Rng rng(2);
  int plausible = 0, hidden = 0;
  for (int i = 0; i < testing::cases(60); ++i) {
    const Yard yard(rng.child(std::to_string(i)), draw(rng));
    const std::vector<Pose2> poses = solved(yard.graph);
    const GraphDoubt other = doubt_about(yard.graph, poses);
    if (yard.landmark_error_m(poses) <= 0.1 || other.cost || other.edge) continue;
    ++plausible;
    hidden += why_not_believed(find_systematic_errors(yard.graph, poses)).empty() ? 1 : 0;
  }
  EXPECT_GT(plausible, 5) << what;
  EXPECT_LE(hidden, most_hidden * plausible) << what;
}

TEST(SystematicErrors, AMapOfAWrongSizeWhoseMeasurementsAgreeIsDoubted) {
  expect_doubts(
      "odometry and ranges of one sign",
      [](Rng& rng) {
        const double slip = rng.uniform(0.0, 0.1);
        return Wrong{slip / (1.0 - slip), slip / (1.0 - slip), rng.uniform(0.0, 0.3)};
      },
      0.1);
  expect_doubts(
      "ranges of a wrong scale",
      [](Rng& rng) { return Wrong{0.0, 0.0, 0.0, rng.uniform() < 0.5 ? -0.05 : 0.05}; }, 0.1);
}

/// The estimate moves the map to where it is without the error.
TEST(SystematicErrors, FindsATurnThatIsCountedTooLarge) {
  const Yard yard(Rng(3), {0.0, 0.02, 0.0}, 0.0);
  const SystematicErrors found = find_systematic_errors(yard.graph, solved(yard.graph));
  EXPECT_NEAR(found.odometry.estimate[1], 0.02, 0.004);
}

/// Ranges and odometry that are wrong alike leave no residual; the width along that direction stays.
TEST(SystematicErrors, AnErrorThatNoResidualShowsKeepsItsWidth) {
  const Yard yard(Rng(4), {}, 0.0);
  const MapShift points = find_systematic_errors(yard.graph, solved(yard.graph)).stated.points;
  EXPECT_LT(points.moved_m, 1e-6);
  EXPECT_GT(points.unseen_m, 0.015);
  EXPECT_GT(points.direction[0] * points.direction[4], 0.0) << "odometry and ranges of one sign";
}

TEST(SystematicErrors, AGraphOfPosesAloneIsNotJudged) {
  PoseGraph chain;
  chain.nodes = {{"0", {}}, {"1", {{1.0, 0.0}, 0.0}}};
  chain.edges = {{EdgeKind::pose, 0, 1, {{1.0, 0.0}, 0.0}, Eigen::Matrix3d::Identity()}};
  EXPECT_EQ(why_not_believed(find_systematic_errors(chain, {{}, {{1.0, 0.0}, 0.0}})), "");
}

}  // namespace
}  // namespace outrider
