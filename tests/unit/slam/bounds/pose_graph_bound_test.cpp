#include "outrider/slam/bounds/pose_graph_bound.hpp"

#include <gtest/gtest.h>

#include "random_graphs.hpp"

namespace outrider {
namespace {

using testing::random_graph;
using testing::shaken;

/// A random graph without ranges whose information differs between directions by a factor of some; without
/// terms that couple position and rotation, if wanted.
template <class Pose>
PoseGraphOf<Pose> moderate_graph(std::size_t poses, std::size_t points, double error, bool coupled,
                                 Rng& rng) {
  constexpr int D = dimension<Pose>, K = freedoms<Pose> - D;
  PoseGraphOf<Pose> graph = random_graph<Pose>(poses, points, error, rng);
  std::erase_if(graph.edges, [](const auto& edge) { return edge.kind == EdgeKind::range; });
  for (auto& edge : graph.edges) {
    const Eigen::Index rows = residual_rows<Pose>(edge.kind);
    edge.information.diagonal().head(rows).array() += 500.0;
    if (coupled || edge.kind == EdgeKind::point) continue;
    edge.information.template topRightCorner<D, K>().setZero();
    edge.information.template bottomLeftCorner<K, D>().setZero();
  }
  return graph;
}

/// The bound is below the cost of all poses that are tried, whatever poses it is made from.
template <class Pose>
void no_poses_cost_less() {
  Rng rng(1);
  double best_share = 0.0;
  for (int round = 0; round < testing::cases(30); ++round) {
    const PoseGraphOf<Pose> graph = moderate_graph<Pose>(6, 2, rng.uniform(0.01, 0.5), round % 2 == 0, rng);
    const std::vector<Pose> truth = poses_of(graph);
    const auto solution = optimise(graph, {}, {});
    ASSERT_TRUE(solution);
    for (const double away : {0.0, 0.01, 0.1, 1.0, 6.0}) {
      const auto bound = least_cost_bound(graph, shaken(solution->poses, graph, away, rng));
      ASSERT_TRUE(bound);
      EXPECT_GE(*bound, 0.0);
      EXPECT_LE(*bound, solution->cost * (1.0 + 1e-9));
      EXPECT_LE(*bound, cost(graph, truth));
      if (away == 0.0) best_share = std::max(best_share, *bound / solution->cost);
      for (int k = 0; k < 20; ++k) {
        EXPECT_LE(*bound, cost(graph, shaken(solution->poses, graph, rng.uniform(0.0, 0.1), rng)));
      }
    }
  }
  EXPECT_GT(best_share, 0.5) << "the premise: some bound says something";
}

TEST(PoseGraphBound, NoPosesCostLess) {
  no_poses_cost_less<Pose2>();
  no_poses_cost_less<Pose3>();
}

/// The bound made from the optimum reaches its cost when errors are moderate.
template <class Pose>
void proves_the_optimum(bool coupled) {
  Rng rng(2);
  for (int round = 0; round < testing::cases(20); ++round) {
    const PoseGraphOf<Pose> graph = moderate_graph<Pose>(12, 2, 0.01, coupled, rng);
    const auto solution = optimise(graph, {}, {});
    ASSERT_TRUE(solution);
    const auto bound = least_cost_bound(graph, solution->poses);
    ASSERT_TRUE(bound);
    EXPECT_GT(solution->cost, 0.1);
    EXPECT_GT(*bound, solution->cost * (1.0 - 0.02));
  }
}

TEST(PoseGraphBound, ProvesTheOptimum) {
  proves_the_optimum<Pose2>(true);
  proves_the_optimum<Pose2>(false);
  proves_the_optimum<Pose3>(false);
}

/// A ring of poses whose start winds once too often: a local minimum, which must not be proven.
TEST(PoseGraphBound, DoesNotProveALocalMinimum) {
  const PoseGraph ring = testing::winding_ring(24, 1), winding = testing::winding_ring(24, 2);
  const auto best = optimise(ring, {}, {});
  const auto local = optimise(winding, {.start = "given"}, {});
  ASSERT_TRUE(best && local && best->converged && local->converged);
  ASSERT_GT(local->cost, 2.0 * best->cost) << "the premise: it is another minimum";
  EXPECT_GT(*least_cost_bound(ring, best->poses), best->cost * (1.0 - 1e-3));
  EXPECT_LE(*least_cost_bound(winding, local->poses), best->cost);
}

TEST(PoseGraphBound, RefusesRanges) {
  Rng rng(3);
  const PoseGraph graph = random_graph(5, 1, 0.1, rng);
  const auto bound = least_cost_bound(graph, poses_of(graph));
  ASSERT_FALSE(bound);
  EXPECT_EQ(bound.error().sentence, "there is no bound for graphs with ranges");
}

}  // namespace
}  // namespace outrider
