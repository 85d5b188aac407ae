#include "outrider/slam/pose_graph.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

#include "dense.hpp"
#include "graph_edges.hpp"
#include "support/random_cases.hpp"

namespace outrider {
namespace {

Pose2 random_pose(Rng& rng) { return {testing::random_point(rng, 5.0), rng.uniform(-3.0, 3.0)}; }

Eigen::Matrix3d random_information(EdgeKind kind, Rng& rng) {
  const Eigen::Index n = kind == EdgeKind::pose ? 3 : kind == EdgeKind::point ? 2 : 1;
  Eigen::Matrix3d result = Eigen::Matrix3d::Zero();
  for (int k = 0; k < 4; ++k) {
    const Eigen::Vector3d v = {rng.normal(), rng.normal(), rng.normal()};
    result.topLeftCorner(n, n) += 20.0 * v.head(n) * v.head(n).transpose();
  }
  return result;
}

/// A walk with loops, points and ranges; measurements of `truth` with errors of that size.
PoseGraph random_graph(std::size_t poses, std::size_t points, double error, Rng& rng) {
  PoseGraph graph;
  for (std::size_t i = 0; i < poses + points; ++i) {
    Pose2 pose = random_pose(rng);
    if (i >= poses) pose.heading_rad = 0.0;
    graph.nodes.push_back({fmt::format("{}", i), pose, i >= poses});
  }
  const auto join = [&](EdgeKind kind, std::size_t from, std::size_t to) {
    GraphEdge edge{kind, static_cast<std::uint32_t>(from), static_cast<std::uint32_t>(to), {}};
    edge.information = random_information(kind, rng);
    const Eigen::Vector3d seen = residual(edge, graph.nodes[from].pose, graph.nodes[to].pose);
    edge.measured = {{seen[0] + error * rng.normal(), seen[1] + error * rng.normal()},
                     seen[2] + error * rng.normal()};
    if (kind == EdgeKind::range) edge.measured.position.y = 0.0;
    if (kind != EdgeKind::pose) edge.measured.heading_rad = 0.0;
    graph.edges.push_back(edge);
  };
  for (std::size_t i = 1; i < poses; ++i) {
    join(EdgeKind::pose, i - 1, i);
    if (i > 1) join(EdgeKind::pose, rng.below(i - 1), i);
  }
  for (std::size_t i = poses; i < poses + points; ++i) {
    for (int k = 0; k < 3; ++k) join(EdgeKind::point, rng.below(poses), i);
    join(EdgeKind::range, rng.below(poses), i);
  }
  return graph;
}

std::vector<Pose2> poses_of(const PoseGraph& graph) {
  std::vector<Pose2> poses;
  for (const GraphNode& node : graph.nodes) poses.push_back(node.pose);
  return poses;
}

std::vector<Pose2> shaken(std::vector<Pose2> poses, const PoseGraph& graph, double size, Rng& rng) {
  for (std::size_t i = 1; i < poses.size(); ++i) {
    poses[i].position = poses[i].position + testing::random_point(rng, size);
    if (!graph.nodes[i].is_point) poses[i].heading_rad += rng.uniform(-size, size);
  }
  return poses;
}

TEST(PoseGraph, JacobiansAreTheFiniteDifferences) {
  Rng rng(1);
  for (int round = 0; round < testing::cases(100); ++round) {
    const PoseGraph graph = random_graph(3, 1, 0.3, rng);
    for (const GraphEdge& edge : graph.edges) {
      const Pose2 a = graph.nodes[edge.from].pose, b = graph.nodes[edge.to].pose;
      const LinearEdge linear = linearise(edge, a, b);
      constexpr double step = 1e-6;
      for (Eigen::Index k = 0; k < (edge.kind == EdgeKind::pose ? 3 : 2); ++k) {
        const Eigen::Vector3d up = step * Eigen::Vector3d::Unit(k), down = -up;
        const Eigen::Vector3d a_up = residual(edge, retract(a, up), b),
                              a_down = residual(edge, retract(a, down), b);
        const Eigen::Vector3d b_up = residual(edge, a, retract(b, up)),
                              b_down = residual(edge, a, retract(b, down));
        for (Eigen::Index row = 0; row < 3; ++row) {
          EXPECT_NEAR(linear.by_from(row, k), (a_up[row] - a_down[row]) / (2.0 * step), 1e-6);
          EXPECT_NEAR(linear.by_to(row, k), (b_up[row] - b_down[row]) / (2.0 * step), 1e-6);
        }
      }
    }
  }
}

TEST(PoseGraph, FindsThePosesAgainWhenTheMeasurementsAreExact) {
  Rng rng(2);
  for (int round = 0; round < testing::cases(20); ++round) {
    PoseGraph graph = random_graph(15, 4, 0.0, rng);
    const std::vector<Pose2> truth = poses_of(graph);
    const std::vector<Pose2> start = shaken(truth, graph, 20.0, rng);
    for (std::size_t i = 0; i < start.size(); ++i) graph.nodes[i].pose = start[i];
    const auto solution = optimise(graph, {.start = "chordal"}, {});
    ASSERT_TRUE(solution) << to_string(solution.error());
    EXPECT_NEAR(solution->cost, 0.0, 1e-12);
    for (std::size_t i = 0; i < truth.size(); ++i) {
      EXPECT_NEAR(distance(solution->poses[i].position, truth[i].position), 0.0, 1e-7);
    }
  }
}

TEST(PoseGraph, TheEndIsAMinimum) {
  Rng rng(3);
  for (int round = 0; round < testing::cases(10); ++round) {
    const PoseGraph graph = random_graph(10, 3, 0.05, rng);
    for (const std::string kernel : {"none", "huber", "cauchy", "geman_mcclure"}) {
      const auto solution = optimise(graph, {.kernel = kernel, .kernel_width = 1.0}, {});
      ASSERT_TRUE(solution);
      EXPECT_TRUE(solution->converged);
      EXPECT_LE(solution->cost, kernel == "none" ? solution->start_cost : HUGE_VAL);
      for (int k = 0; k < 20; ++k) {  // nothing near is better
        const std::vector<Pose2> near = shaken(solution->poses, graph, 1e-3, rng);
        double sum = 0.0;
        for (const GraphEdge& edge : graph.edges) {
          const Eigen::Vector3d r = residual(edge, near[edge.from], near[edge.to]);
          const double s = r.dot(edge.information * r);
          sum += robust_loss(kernel, 1.0, s).value;
        }
        EXPECT_GE(sum, solution->robust_cost - 1e-7 * (1.0 + sum));
      }
    }
  }
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
  double plain_error = 0.0, robust_error = 0.0;
  for (std::size_t i = 0; i < truth.size(); ++i) {
    plain_error = std::max(plain_error, distance(plain->poses[i].position, truth[i].position));
    robust_error = std::max(robust_error, distance(robust->poses[i].position, truth[i].position));
  }
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
