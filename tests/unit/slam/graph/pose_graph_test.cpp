#include "outrider/slam/graph/pose_graph.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "dense.hpp"
#include "outrider/slam/bounds/pose_graph_bound.hpp"
#include "random_graphs.hpp"

namespace outrider {
namespace {

using testing::largest_gap;
using testing::random_graph;
using testing::random_pose;
using testing::shaken;

template <class Pose>
void jacobians_are_the_finite_differences() {
  Rng rng(1);
  for (int round = 0; round < testing::cases(100); ++round) {
    const PoseGraphOf<Pose> graph = random_graph<Pose>(3, 1, 0.3, rng);
    for (const auto& edge : graph.edges) {
      const Pose a = graph.nodes[edge.from].pose, b = graph.nodes[edge.to].pose;
      const LinearEdgeOf<Pose> linear = linearise(edge, a, b);
      EXPECT_LT((linear.residual - residual(edge, a, b)).norm(), 1e-12);
      constexpr double step = 1e-6;
      for (Eigen::Index k = 0; k < (edge.kind == EdgeKind::pose ? freedoms<Pose> : dimension<Pose>); ++k) {
        const PoseVector<Pose> up = step * PoseVector<Pose>::Unit(k), down = -up;
        const PoseVector<Pose> by_from =
            (residual(edge, retract(a, up), b) - residual(edge, retract(a, down), b)) / (2.0 * step);
        const PoseVector<Pose> by_to =
            (residual(edge, a, retract(b, up)) - residual(edge, a, retract(b, down))) / (2.0 * step);
        EXPECT_LT((linear.by_from.col(k) - by_from).norm(), 1e-6);
        EXPECT_LT((linear.by_to.col(k) - by_to).norm(), 1e-6);
      }
    }
  }
}

TEST(PoseGraph, JacobiansAreTheFiniteDifferences) {
  jacobians_are_the_finite_differences<Pose2>();
  jacobians_are_the_finite_differences<Pose3>();
}

/// A step that turns all poses about one point changes no relative pose, however large it is.
template <class Pose>
void turning_about_a_point_keeps_relative_poses() {
  constexpr int D = dimension<Pose>, K = freedoms<Pose> - D;
  Rng rng(10);
  for (int round = 0; round < testing::cases(50); ++round) {
    const PoseGraphOf<Pose> graph = random_graph<Pose>(6, 0, 0.0, rng);
    const Eigen::Matrix<double, D, 1> centre = position_of(random_pose<Pose>(rng));
    const Eigen::Matrix<double, K, 1> turn = testing::random_step<Pose>(2.0, rng).template tail<K>();
    std::vector<Pose> turned;
    for (const auto& node : graph.nodes) {
      const auto arm = (position_of(node.pose) - centre).eval();
      PoseVector<Pose> step;
      if constexpr (D == 2) {
        step << -turn[0] * arm[1], turn[0] * arm[0], turn[0];
      } else {
        step << turn[1] * arm[2] - turn[2] * arm[1], turn[2] * arm[0] - turn[0] * arm[2],
            turn[0] * arm[1] - turn[1] * arm[0], turn;
      }
      turned.push_back(retract(node.pose, step));
    }
    EXPECT_NEAR(cost(graph, turned), 0.0, 1e-18);
  }
}

TEST(PoseGraph, TurningAboutAPointKeepsRelativePoses) {
  turning_about_a_point_keeps_relative_poses<Pose2>();
  turning_about_a_point_keeps_relative_poses<Pose3>();
}

template <class Pose>
void finds_the_poses_again() {
  Rng rng(2);
  for (int round = 0; round < testing::cases(20); ++round) {
    PoseGraphOf<Pose> graph = random_graph<Pose>(15, 4, 0.0, rng);
    const std::vector<Pose> truth = poses_of(graph);
    const std::vector<Pose> start = shaken(truth, graph, 20.0, rng);
    for (std::size_t i = 0; i < start.size(); ++i) graph.nodes[i].pose = start[i];
    for (const char* from : {"chordal", "odometry", "spanning_tree"}) {
      const auto solution = optimise(graph, {.start = from}, {});
      ASSERT_TRUE(solution) << to_string(solution.error());
      EXPECT_TRUE(solution->converged);
      EXPECT_EQ(solution->start, from);
      EXPECT_NEAR(solution->cost, 0.0, 1e-12);
      EXPECT_LT(largest_gap(solution->poses, truth), 1e-7);
    }
  }
}

TEST(PoseGraph, FindsThePosesAgainWhenTheMeasurementsAreExact) {
  finds_the_poses_again<Pose2>();
  finds_the_poses_again<Pose3>();
}

template <class Pose>
void the_end_is_a_minimum() {
  Rng rng(3);
  for (int round = 0; round < testing::cases(10); ++round) {
    const PoseGraphOf<Pose> graph = random_graph<Pose>(10, 3, 0.05, rng);
    for (const std::string kernel : {"none", "huber", "cauchy", "geman_mcclure"}) {
      const auto solution = optimise(graph, {.kernel = kernel, .kernel_width = 1.0}, {});
      ASSERT_TRUE(solution);
      EXPECT_TRUE(solution->converged);
      EXPECT_LE(solution->cost, kernel == "none" ? solution->start_cost : HUGE_VAL);
      for (int k = 0; k < 20; ++k) {  // nothing near is better
        const std::vector<Pose> near = shaken(solution->poses, graph, 1e-3, rng);
        double sum = 0.0;
        for (const auto& edge : graph.edges) {
          const PoseVector<Pose> r = residual(edge, near[edge.from], near[edge.to]);
          sum += robust_loss(kernel, 1.0, r.dot(edge.information * r)).value;
        }
        EXPECT_GE(sum, solution->robust_cost - 1e-7 * (1.0 + sum));
      }
    }
  }
}

TEST(PoseGraph, TheEndIsAMinimum) {
  the_end_is_a_minimum<Pose2>();
  the_end_is_a_minimum<Pose3>();
}

TEST(PoseGraph, IsNotConvergedBeforeItIsAtAMinimum) {
  Rng rng(9);
  for (int round = 0; round < testing::cases(20); ++round) {
    const PoseGraph graph = random_graph(20, 0, 0.1, rng);
    const auto whole = optimise(graph, {.start = "chordal"}, {});
    ASSERT_TRUE(whole && whole->converged && whole->iterations > 2);
    for (std::int64_t iterations = 1; iterations < whole->iterations; ++iterations) {
      const auto part = optimise(graph, {.start = "chordal", .iterations = iterations}, {});
      ASSERT_TRUE(part);
      EXPECT_FALSE(part->converged) << iterations << " of " << whole->iterations;
      EXPECT_GE(part->cost, whole->cost);
      EXPECT_LE(part->cost, part->start_cost);
    }
  }
}

/// From a start beyond the reach of Gauss-Newton, no step may raise the cost, and the end is still a minimum.
TEST(PoseGraph, NeverRisesFromABadStart) {
  Rng rng(11);
  for (int round = 0; round < testing::cases(20); ++round) {
    PoseGraph graph = random_graph(25, 0, 0.1, rng);
    const std::vector<Pose2> start = shaken(poses_of(graph), graph, 6.0, rng);
    for (std::size_t i = 0; i < start.size(); ++i) graph.nodes[i].pose = start[i];
    double before = cost(graph, start);
    for (const std::int64_t iterations : {1, 2, 4, 8, 16}) {
      const auto part = optimise(graph, {.start = "given", .iterations = iterations}, {});
      ASSERT_TRUE(part);
      EXPECT_LE(part->cost, before);
      before = part->cost;
    }
  }
}

/// Several starts find what one does not: the lowest end of all, which is proven or which two reach.
TEST(PoseGraph, TheBestOfSeveralStartsIsNoWorseThanAny) {
  Rng rng(12);
  int better = 0;
  for (int round = 0; round < testing::cases(20); ++round) {
    PoseGraph graph = random_graph(25, 0, 0.3, rng);
    const std::vector<Pose2> start = shaken(poses_of(graph), graph, 6.0, rng);
    for (std::size_t i = 0; i < start.size(); ++i) graph.nodes[i].pose = start[i];
    const auto best = optimise(graph, {}, {});
    const auto given = optimise(graph, {.start = "given"}, {});
    ASSERT_TRUE(best && given);
    EXPECT_TRUE(best->converged);
    const auto bound = least_cost_bound(graph, best->poses);
    EXPECT_TRUE(best->descents_agreeing >= 2 || *bound >= 0.999 * best->cost);
    EXPECT_LE(best->cost, given->cost * (1.0 + 1e-6));
    better += best->cost < 0.999 * given->cost ? 1 : 0;
  }
  EXPECT_GT(better, 0) << "the premise: one bad start can end elsewhere";
}

TEST(PoseGraph, KernelsResistAFalseLoop) {
  Rng rng(4);
  PoseGraph graph = random_graph(30, 0, 0.001, rng);
  const std::vector<Pose2> truth = poses_of(graph);
  graph.edges.push_back(graph.edges.back());
  graph.edges.back().measured = {{9.0, -9.0}, 2.0};
  const auto plain = optimise(graph, {.start = "given"}, {});
  const auto robust = optimise(graph, {.start = "given", .kernel = "geman_mcclure"}, {});
  ASSERT_TRUE(plain && robust);
  const double plain_error = largest_gap(plain->poses, truth);
  const double robust_error = largest_gap(robust->poses, truth);
  EXPECT_LT(robust_error, 0.02);
  EXPECT_GT(plain_error, 10.0 * robust_error);
}

TEST(PoseGraph, MarginalsAreTheDenseInverse) {
  Rng rng(5);
  for (int round = 0; round < testing::cases(10); ++round) {
    const PoseGraph graph = random_graph(8, 3, 0.05, rng);
    const std::vector<Pose2> poses = poses_of(graph);
    std::vector<std::size_t> column(graph.nodes.size(), 0);  // of the unknowns; the first pose has none
    std::size_t unknowns = 0;
    for (std::size_t i = 1; i < graph.nodes.size(); ++i) {
      column[i] = unknowns;
      unknowns += graph.nodes[i].is_point ? 2 : 3;
    }
    testing::Dense information = testing::zeros(unknowns, unknowns);
    for (const GraphEdge& edge : graph.edges) {
      const LinearEdge linear = linearise(edge, poses[edge.from], poses[edge.to]);
      testing::Dense jacobian = testing::zeros(3, unknowns);
      testing::Dense weight = testing::zeros(3, 3);
      for (std::size_t r = 0; r < 3; ++r) {
        for (std::size_t c = 0; c < 3; ++c) {
          const auto row = static_cast<Eigen::Index>(r), col = static_cast<Eigen::Index>(c);
          weight[r][c] = edge.information(row, col);
          if (edge.from != 0 && (c < 2 || !graph.nodes[edge.from].is_point)) {
            jacobian[r][column[edge.from] + c] = linear.by_from(row, col);
          }
          if (edge.to != 0 && (c < 2 || !graph.nodes[edge.to].is_point)) {
            jacobian[r][column[edge.to] + c] = linear.by_to(row, col);
          }
        }
      }
      const auto term = testing::product(testing::transposed(jacobian), testing::product(weight, jacobian));
      for (std::size_t r = 0; r < unknowns; ++r) {
        for (std::size_t c = 0; c < unknowns; ++c) information[r][c] += term[r][c];
      }
    }
    const testing::Dense covariance = testing::inverse(information);
    const auto marginals = marginal_covariances(graph, poses);
    ASSERT_TRUE(marginals);
    EXPECT_EQ((*marginals)[0], Eigen::Matrix3d::Zero());
    for (std::size_t i = 1; i < graph.nodes.size(); ++i) {
      for (std::size_t r = 0; r < (graph.nodes[i].is_point ? 2U : 3U); ++r) {
        for (std::size_t c = 0; c < (graph.nodes[i].is_point ? 2U : 3U); ++c) {
          const double expected = covariance[column[i] + r][column[i] + c];
          EXPECT_NEAR((*marginals)[i](static_cast<Eigen::Index>(r), static_cast<Eigen::Index>(c)), expected,
                      1e-8 * (1.0 + std::abs(expected)));
        }
      }
    }
  }
}

TEST(PoseGraph, TheMeasuredFrameTurnsTheErrorBack) {
  Rng rng(6);
  const PoseGraph graph = random_graph(6, 0, 0.3, rng);
  const std::vector<Pose2> poses = poses_of(graph);
  double sum = 0.0;
  for (const GraphEdge& edge : graph.edges) {
    const Eigen::Vector3d r = residual(edge, poses[edge.from], poses[edge.to]);
    const Vec2 back = unrotated(edge.measured.heading_rad, {r[0], r[1]});
    const Eigen::Vector3d turned(back.x, back.y, r[2]);
    sum += turned.dot(edge.information * turned);
  }
  EXPECT_NEAR(cost(in_measured_frame(graph), poses), sum, 1e-9 * sum);
}

TEST(PoseGraph, PlacesFromEdgesWhatIsNotPlaced) {
  Rng rng(7);
  PoseGraph graph = random_graph(12, 3, 0.0, rng);
  std::erase_if(graph.edges, [](const GraphEdge& edge) { return edge.kind == EdgeKind::range; });
  const std::vector<Pose2> truth = poses_of(graph);
  std::vector<bool> placed(graph.nodes.size(), false);
  placed[5] = true;
  for (std::size_t i = 0; i < truth.size(); ++i) {
    if (i != 5) graph.nodes[i].pose = {};
  }
  ASSERT_TRUE(place_from_edges(graph, placed));
  for (std::size_t i = 0; i < truth.size(); ++i) {
    EXPECT_NEAR(distance(graph.nodes[i].pose.position, truth[i].position), 0.0, 1e-9);
  }
}

TEST(PoseGraph, TakesInformationThatIsSymmetricButForRounding) {
  Rng rng(8);
  PoseGraph graph = random_graph(4, 1, 0.1, rng);
  for (GraphEdge& edge : graph.edges) {
    if (edge.kind != EdgeKind::pose) continue;
    edge.information = Eigen::Vector3d(4.0, 4.0, 9.0).asDiagonal();
    edge.information(0, 1) = 1e-13;  // what turning a diagonal by some angle leaves
    edge.information(1, 0) = -3e-13;
  }
  EXPECT_TRUE(optimise(graph, {}, {}).has_value());
  graph.edges[0].information(0, 1) = 1e-3;
  EXPECT_FALSE(optimise(graph, {}, {}).has_value());
}

TEST(PoseGraph, RefusesInASentence) {
  Rng rng(8);
  const PoseGraph good = random_graph(4, 1, 0.1, rng);
  const auto sentence = [](const PoseGraph& graph) {
    const auto solution = optimise(graph, {}, {});
    return solution ? std::string("taken") : solution.error().sentence;
  };
  EXPECT_EQ(sentence(good), "taken");
  PoseGraph bad = good;
  bad.nodes.push_back({"alone", {}, false});
  EXPECT_EQ(sentence(bad), "the graph falls apart: no chain of edges joins node alone to node 0; add one");
  bad = good;
  bad.edges[0].information(0, 0) = -1.0;
  EXPECT_EQ(sentence(bad),
            "the edge from 0 to 1 has an information that is not symmetric and positive definite");
  bad = good;
  bad.edges[0].measured.position.x = NAN;
  EXPECT_EQ(sentence(bad), "the edge from 0 to 1 measures more than 1e9, or no number");
  bad = good;
  bad.edges[0].to = 99;
  EXPECT_EQ(sentence(bad), "an edge joins nodes 0 and 99 of 5; name nodes that exist");
  bad = good;
  bad.edges[0].to = 0;
  EXPECT_EQ(sentence(bad), "the edge from 0 to 0 joins a node to itself; take it out");
  EXPECT_EQ(sentence({}), "the graph has no poses; expected at least one");
  EXPECT_EQ(optimise(good, {.kernel = "tukey"}, {}).error().sentence,
            "'tukey' is not valid; expected none, huber, cauchy, geman_mcclure");
  Budget nothing;
  nothing.expansions = 0;
  EXPECT_EQ(optimise(good, {}, nothing).error().code, FaultCode::budget_exhausted);
}

}  // namespace
}  // namespace outrider
