#include "graph/graduated.hpp"

#include <gtest/gtest.h>

#include "outrider/slam/graph/pose_graph_doubt.hpp"
#include "random_graphs.hpp"

namespace outrider {
namespace {

using testing::largest_gap;
using testing::measurement;
using testing::random_pose;

/// A walk on a grid whose loops are honest, and `count` false edges at the end.
template <class Pose>
PoseGraphOf<Pose> walk_with_false_edges(std::size_t count, Rng& rng) {
  PoseGraphOf<Pose> graph;
  PoseVector<Pose> standard_deviation;
  standard_deviation.setConstant(0.02);
  standard_deviation.template head<dimension<Pose>>().setConstant(0.05);
  const PoseMatrix<Pose> information = standard_deviation.array().square().inverse().matrix().asDiagonal();
  const auto join = [&](std::size_t from, std::size_t to, const Pose& measured) {
    graph.edges.push_back({EdgeKind::pose, static_cast<std::uint32_t>(from), static_cast<std::uint32_t>(to),
                           measured, information});
  };
  constexpr std::size_t side = 8, poses = 4 * side * 3;  // three times around a square
  for (std::size_t i = 0; i < poses; ++i) {
    Pose pose;
    if (i > 0) {
      PoseVector<Pose> step = PoseVector<Pose>::Zero();
      step[0] = 1.0;
      Pose motion = retract(Pose{}, step);
      step.setZero();
      step[freedoms<Pose> - 1] = i % side == 0 ? 0.5 * pi : 0.0;
      motion = retract(motion, step);
      pose = graph.nodes[i - 1].pose;
      set_position(pose, position_of(pose) + rotation_of(pose) * position_of(motion));
      set_rotation(pose, rotation_of(pose) * rotation_of(motion));
    }
    graph.nodes.push_back({std::to_string(i), pose, false});
    const auto seen = [&](std::size_t from) {
      Pose measured = measurement(EdgeKind::pose, graph.nodes[from].pose, pose, 0.0, rng);
      PoseVector<Pose> noise;
      for (double& value : noise.reshaped()) value = rng.normal();
      return retract(measured, noise.cwiseProduct(standard_deviation));
    };
    if (i > 0) join(i - 1, i, seen(i - 1));
    if (i >= 4 * side) join(i - 4 * side, i, seen(i - 4 * side));
  }
  for (std::size_t k = 0; k < count; ++k) {
    const std::size_t from = rng.below(poses - 10), to = from + 5 + rng.below(poses - from - 5);
    join(from, to, random_pose<Pose>(rng));
  }
  return graph;
}

/// Returns the solution without the false edges, which no method had to find.
template <class Pose>
PoseGraphSolutionOf<Pose> oracle(PoseGraphOf<Pose> graph, std::size_t count) {
  graph.edges.resize(graph.edges.size() - count);
  return *optimise(graph, {}, {});
}

template <class Pose>
void refuses_false_edges() {
  Rng rng(1);
  double worst_plain = 0.0;
  for (const std::size_t count : {0U, 1U, 5U, 20U}) {
    for (int round = 0; round < testing::cases(3); ++round) {
      const PoseGraphOf<Pose> graph = walk_with_false_edges<Pose>(count, rng);
      const auto truth = oracle(graph, count);
      const auto robust = optimise(graph, {.robust = "gnc"}, {});
      const auto plain = optimise(graph, {.start = "chordal"}, {});
      ASSERT_TRUE(robust && plain);
      const GraphDoubt before = doubt_about(graph, plain->poses);
      EXPECT_EQ(before.edge.has_value(), count > 0);
      const PoseGraphOf<Pose> kept = without_edges(graph, robust->refused);
      EXPECT_EQ(kept.edges.size() + robust->refused.size(), graph.edges.size());
      const GraphDoubt after = doubt_about(kept, robust->poses);
      EXPECT_FALSE(after.cost || after.edge);
      EXPECT_TRUE(robust->converged);
      EXPECT_LT(largest_gap(robust->poses, truth.poses), 0.15) << count << " false edges";
      worst_plain = std::max(worst_plain, largest_gap(plain->poses, truth.poses));
      std::size_t found = 0, honest = 0;
      for (const std::uint32_t edge : robust->refused) {
        EXPECT_NE(graph.edges[edge].to, graph.edges[edge].from + 1) << "odometry is never refused";
        (edge >= graph.edges.size() - count ? found : honest) += 1;
      }
      EXPECT_EQ(found, count);
      EXPECT_LE(honest, 2U);
    }
  }
  EXPECT_GT(worst_plain, 1.0) << "the premise: false edges do harm";
}

TEST(Graduated, RefusesFalseEdges) {
  refuses_false_edges<Pose2>();
  refuses_false_edges<Pose3>();
}

/// Without noise, the limit would be that of rounding errors; honest edges stay in.
TEST(Graduated, KeepsExactEdges) {
  Rng rng(3);
  for (int round = 0; round < testing::cases(5); ++round) {
    PoseGraph graph = testing::random_graph(20, 3, 0.0, rng);
    EXPECT_TRUE(optimise(graph, {.robust = "gnc"}, {})->refused.empty());
    graph.edges.push_back(graph.edges[12]);
    ASSERT_EQ(graph.edges.back().kind, EdgeKind::pose);
    graph.edges.back().from = 2;
    graph.edges.back().to = 17;
    graph.edges.back().measured = random_pose<Pose2>(rng);
    const auto solution = optimise(graph, {.robust = "gnc"}, {});
    ASSERT_TRUE(solution);
    EXPECT_EQ(solution->refused,
              std::vector<std::uint32_t>{static_cast<std::uint32_t>(graph.edges.size() - 1)});
  }
}

/// The predicted change of the cost is what refusing or taking back an edge does, for a graph that is linear.
TEST(Graduated, CostChangesAreThoseOfSolvingAgain) {
  Rng rng(2);
  PoseGraph line;  // headings are held, so that positions are linear
  for (int i = 0; i < 8; ++i) line.nodes.push_back({std::to_string(i), {{1.0 * i, 0.0}, 0.0}, false});
  const auto join = [&](std::uint32_t from, std::uint32_t to) {
    GraphEdge edge{EdgeKind::pose, from, to, {}};
    edge.measured = {{to - from + 0.2 * rng.normal(), 0.2 * rng.normal()}, 0.0};
    edge.information = Eigen::Vector3d(20.0, 30.0, 1e9).asDiagonal();
    line.edges.push_back(edge);
  };
  for (std::uint32_t i = 1; i < 8; ++i) join(i - 1, i);
  for (std::uint32_t i = 2; i < 8; ++i) join(static_cast<std::uint32_t>(rng.below(i - 1)), i);
  std::vector<bool> refused(line.edges.size(), false);
  refused[9] = refused[11] = true;
  const auto solve = [&](const std::vector<bool>& without) {
    PoseGraph kept{line.nodes, {}};
    for (std::size_t i = 0; i < without.size(); ++i) {
      if (!without[i]) kept.edges.push_back(line.edges[i]);
    }
    return *optimise(kept, {.start = "given", .tolerance = 1e-14}, {});
  };
  const auto solution = solve(refused);
  const std::vector<double> changes = cost_changes(line, solution.poses, refused);
  for (std::size_t i = 0; i < refused.size(); ++i) {
    if (i < 7) {
      EXPECT_EQ(changes[i], 0.0) << "odometry";
      continue;
    }
    std::vector<bool> other = refused;
    other[i] = !other[i];
    const double change = solve(other).cost - solution.cost;
    EXPECT_NEAR(changes[i], refused[i] ? change : -change, 1e-4 * std::abs(change) + 1e-6) << i;
  }
}

TEST(Graduated, TheLargestPlausibleCostIsExceededOnceInAThousandTimes) {
  // quantiles of chi-square at 0.999
  for (const auto& [rows, quantile] :
       {std::pair(1, 10.828), std::pair(2, 13.816), std::pair(3, 16.266), std::pair(6, 22.458)}) {
    EXPECT_NEAR(largest_cost(rows), quantile, 0.04 * quantile);
  }
}

/// The staircase begins at the chordal relaxation, and so does the search for false edges before it.
TEST(Graduated, BeginsAtTheChordalRelaxationBelowAStaircase) {
  Rng rng(9);
  const PoseGraph graph = walk_with_false_edges<Pose2>(5, rng);
  const auto chordal = optimise(graph, {.start = "chordal", .robust = "gnc"}, {});
  const auto staircase = optimise(graph, {.start = "staircase", .robust = "gnc"}, {});
  ASSERT_TRUE(chordal && staircase);
  EXPECT_GE(staircase->refused.size(), 5U);
  EXPECT_EQ(staircase->refused, chordal->refused);
  EXPECT_NEAR(staircase->cost, chordal->cost, 1e-6 * chordal->cost);
}

}  // namespace
}  // namespace outrider
