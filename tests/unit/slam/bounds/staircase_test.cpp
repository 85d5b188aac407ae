#include "bounds/staircase.hpp"

#include <gtest/gtest.h>

#include "random_graphs.hpp"

namespace outrider {
namespace {

using testing::random_graph;
using testing::random_pose;
using testing::shaken;

constexpr std::int64_t many = 1000;

/// Poses that wind twice around the ring are at a local minimum, from which no descent in the plane leads.
TEST(Staircase, LeavesALocalMinimum) {
  const PoseGraph ring = testing::winding_ring(24, 2);
  const auto best = optimise(ring, {}, {});
  const auto local = optimise(ring, {.start = "given"}, {});
  ASSERT_TRUE(best && local && local->converged);
  ASSERT_GT(local->cost, 2.0 * best->cost) << "the premise: it is another minimum";
  BudgetMeter meter(Budget{});
  const auto top = climb_staircase(ring, local->poses, many, meter);
  EXPECT_TRUE(top.proven);
  EXPECT_GT(top.rank, 2) << "there is no way down in the plane";
  EXPECT_LT(cost(ring, top.poses), 1.01 * best->cost);
  EXPECT_EQ(top.poses.front(), local->poses.front());
}

/// Random graphs of few loops whose information is one number for positions and one for rotations, so that
/// the staircase makes the cost itself least (in space; in the plane up to the difference of a^2 and
/// 2 - 2 cos a).
template <class Pose>
PoseGraphOf<Pose> isotropic_graph(std::size_t poses, std::size_t points, double error, Rng& rng) {
  constexpr int D = dimension<Pose>;
  PoseGraphOf<Pose> graph = random_graph<Pose>(poses, points, error, rng);
  std::erase_if(graph.edges, [](const auto& edge) {
    const bool loop = edge.kind == EdgeKind::pose && edge.to != edge.from + 1;
    return edge.kind == EdgeKind::range || (loop && edge.to % 8 != 0);
  });
  for (auto& edge : graph.edges) {
    const double position = rng.uniform(50.0, 500.0), rotation = rng.uniform(50.0, 500.0);
    edge.information.setZero();
    edge.information.diagonal().template head<D>().setConstant(position);
    if (edge.kind == EdgeKind::pose) {
      edge.information.diagonal().template tail<freedoms<Pose> - D>().setConstant(rotation);
    }
  }
  return graph;
}

/// From poses anywhere at all, the staircase is proven to end where no poses cost less.
template <class Pose>
void finds_the_least_from_anywhere() {
  Rng rng(5);
  int worse_without = 0;
  for (int round = 0; round < testing::cases(20); ++round) {
    PoseGraphOf<Pose> graph = isotropic_graph<Pose>(41, 3, 0.03, rng);
    const auto best = optimise(graph, {}, {});
    for (std::size_t i = 1; i < graph.nodes.size(); ++i) {
      const Pose anywhere = random_pose<Pose>(rng);
      if (graph.nodes[i].is_point) {
        graph.nodes[i].pose.position = anywhere.position;
      } else {
        graph.nodes[i].pose = anywhere;
      }
    }
    const auto descent = optimise(graph, {.start = "given"}, {});
    ASSERT_TRUE(best && descent);
    worse_without += descent->cost > 1.1 * best->cost ? 1 : 0;
    BudgetMeter meter(Budget{});
    const auto top = climb_staircase(graph, poses_of(graph), many, meter);
    EXPECT_TRUE(top.proven) << "round " << round;
    EXPECT_LT(cost(graph, top.poses), 1.01 * best->cost) << "round " << round;
    EXPECT_LT(top.iterations, many);
  }
  EXPECT_GT(worse_without, 0) << "the premise: some descents from there end elsewhere";
}

TEST(Staircase, FindsTheLeastFromAnywhere) {
  finds_the_least_from_anywhere<Pose2>();
  finds_the_least_from_anywhere<Pose3>();
}

TEST(Staircase, EndsWithTheBudget) {
  Rng rng(7);
  const PoseGraph graph = isotropic_graph<Pose2>(15, 3, 0.03, rng);
  std::vector<Pose2> poses = poses_of(graph);
  for (std::size_t i = 1; i < 15; ++i) poses[i] = random_pose<Pose2>(rng);
  Budget few;
  few.expansions = 3;
  BudgetMeter meter(few);
  const auto top = climb_staircase(graph, poses, many, meter);
  EXPECT_FALSE(top.proven);
  EXPECT_EQ(top.iterations, 3);
  BudgetMeter unlimited(Budget{});
  EXPECT_EQ(climb_staircase(graph, poses, 2, unlimited).iterations, 2);
}

TEST(Staircase, IsAStartOfOptimise) {
  const PoseGraph ring = testing::winding_ring(12, 1);
  const auto solution = optimise(ring, {.start = "staircase"}, {});
  ASSERT_TRUE(solution);
  EXPECT_EQ(solution->start, "staircase");
  EXPECT_TRUE(solution->converged);
  Rng rng(3);
  const auto refused = optimise(random_graph(5, 1, 0.1, rng), {.start = "staircase"}, {});
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().sentence, "the staircase knows no ranges; take another start");
}

}  // namespace
}  // namespace outrider
