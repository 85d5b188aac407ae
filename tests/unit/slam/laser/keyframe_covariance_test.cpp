// The marginal covariance against the inverse of a dense information that numeric derivatives give.
#include "laser/keyframe_covariance.hpp"

#include <gtest/gtest.h>

#include <Eigen/LU>

#include "outrider/core/rng.hpp"
#include "outrider/core/units.hpp"

namespace outrider {
namespace {

struct Graph {
  std::vector<Keyframe> keyframes;
  std::vector<KeyframeConstraint> constraints;
};

Eigen::Matrix3d random_information(Rng& rng) {
  Eigen::Matrix3d a;
  for (Eigen::Index i = 0; i < 9; ++i) a.data()[i] = rng.normal();
  return 50.0 * a * a.transpose() + 20.0 * Eigen::Matrix3d::Identity();
}

GraphEdge random_edge(const Graph& graph, std::uint32_t from, std::uint32_t to, Rng& rng) {
  return {EdgeKind::pose, from, to, relative_pose(graph.keyframes[from].pose, graph.keyframes[to].pose),
          random_information(rng)};
}

Graph random_chain(std::uint32_t count, Rng& rng) {
  Graph graph;
  for (std::uint32_t i = 0; i < count; ++i) {
    const Vec2 at{rng.uniform(-5.0, 5.0), rng.uniform(-5.0, 5.0)};
    graph.keyframes.push_back({{at, rng.uniform(-3.0, 3.0)}, 0.0, {}});
    if (i > 0) graph.constraints.push_back({random_edge(graph, i - 1, i, rng), {}, {}, false});
    if (i > 4 && i % 3 == 0) graph.constraints.push_back({random_edge(graph, i / 2, i, rng), {}, {}, false});
  }
  return graph;
}

/// The error of `to` as `from` measured it, in the frame of `from`.
Eigen::Vector3d error_of(const GraphEdge& edge, const Pose2& from, const Pose2& to) {
  const Vec2 p = rotated(-from.heading_rad, to.position - from.position) - edge.measured.position;
  return {p.x, p.y, wrap_angle(to.heading_rad - from.heading_rad - edge.measured.heading_rad)};
}

Pose2 moved(Pose2 pose, int coordinate, double by) {
  (coordinate == 0 ? pose.position.x : coordinate == 1 ? pose.position.y : pose.heading_rad) += by;
  return pose;
}

Eigen::Matrix<double, 3, 6> derivative(const GraphEdge& edge, const Pose2& from, const Pose2& to) {
  constexpr double step = 1e-6;
  Eigen::Matrix<double, 3, 6> result;
  for (int k = 0; k < 3; ++k) {
    result.col(k) =
        (error_of(edge, moved(from, k, step), to) - error_of(edge, moved(from, k, -step), to)) / (2 * step);
    result.col(3 + k) =
        (error_of(edge, from, moved(to, k, step)) - error_of(edge, from, moved(to, k, -step))) / (2 * step);
  }
  return result;
}

Eigen::Matrix3d dense_covariance(const std::vector<Keyframe>& keyframes,
                                 const std::vector<GraphEdge>& edges) {
  const auto size = 3 * static_cast<Eigen::Index>(keyframes.size());
  Eigen::MatrixXd information = Eigen::MatrixXd::Zero(size, size);
  for (const GraphEdge& edge : edges) {
    const auto by = derivative(edge, keyframes[edge.from].pose, keyframes[edge.to].pose);
    const Eigen::Index at[] = {3 * static_cast<Eigen::Index>(edge.from),
                               3 * static_cast<Eigen::Index>(edge.to)};
    for (int i = 0; i < 2; ++i) {
      for (int j = 0; j < 2; ++j) {
        information.block<3, 3>(at[i], at[j]) +=
            by.middleCols<3>(3 * i).transpose() * edge.information * by.middleCols<3>(3 * j);
      }
    }
  }
  const Eigen::MatrixXd rest = information.bottomRightCorner(size - 3, size - 3);
  return rest.inverse().bottomRightCorner<3, 3>();
}

void expect_near(const Eigen::Matrix3d& found, const Eigen::Matrix3d& wanted) {
  EXPECT_LT((found - wanted).norm(), 1e-6 * wanted.norm()) << found << "\n\n" << wanted;
}

TEST(KeyframeCovariance, IsTheMarginalOfTheGraphWhileItGrows) {
  Rng rng(5);
  const Graph graph = random_chain(40, rng);
  KeyframeCovariance covariance;
  std::vector<KeyframeConstraint> constraints;
  std::vector<GraphEdge> edges;
  for (std::uint32_t count = 1; count <= graph.keyframes.size(); ++count) {
    for (const KeyframeConstraint& constraint : graph.constraints) {
      if (constraint.edge.to + 1 != count) continue;
      constraints.push_back(constraint);
      edges.push_back(constraint.edge);
    }
    const std::vector<Keyframe> keyframes(graph.keyframes.begin(), graph.keyframes.begin() + count);
    const Eigen::Matrix3d found = covariance.of_last(keyframes, constraints);
    if (count == 1) {
      EXPECT_TRUE(found.isZero(0.0));
    } else {
      expect_near(found, dense_covariance(keyframes, edges));
    }
  }
}

TEST(KeyframeCovariance, ALoopThatIsClosedLaterCounts) {
  Rng rng(6);
  Graph graph = random_chain(20, rng);
  KeyframeCovariance covariance;
  const Eigen::Matrix3d open = covariance.of_last(graph.keyframes, graph.constraints);
  graph.constraints.push_back({random_edge(graph, 0, 19, rng), {}, {}, false});
  const Eigen::Matrix3d closed = covariance.of_last(graph.keyframes, graph.constraints);
  EXPECT_LT(closed.trace(), open.trace());
  std::vector<GraphEdge> edges;
  for (const KeyframeConstraint& constraint : graph.constraints) edges.push_back(constraint.edge);
  expect_near(closed, dense_covariance(graph.keyframes, edges));
  covariance.forget();
  expect_near(covariance.of_last(graph.keyframes, graph.constraints), closed);
}

TEST(KeyframeCovariance, AMatchWithSeveralIsAConstraintToEach) {
  Rng rng(7);
  Graph graph = random_chain(12, rng);
  KeyframeConstraint& match = graph.constraints.back();
  match.edge = random_edge(graph, 10, 11, rng);
  match.edge.information += 30.0 * Eigen::Matrix3d::Identity();
  match.shared = match.edge.information - 30.0 * Eigen::Matrix3d::Identity();
  match.matched = {{{10, 0.7}, {4, 0.3}}};
  std::vector<GraphEdge> edges;
  for (const KeyframeConstraint& constraint : graph.constraints) edges.push_back(constraint.edge);
  edges.back().information -= 0.3 * match.shared;
  GraphEdge older = edges.back();
  older.from = 4;
  const Pose2& frame = graph.keyframes[10].pose;
  older.measured = relative_pose(graph.keyframes[4].pose, graph.keyframes[11].pose);
  Eigen::Matrix3d turn = Eigen::Matrix3d::Identity();
  const double angle = graph.keyframes[4].pose.heading_rad - frame.heading_rad;
  turn.topLeftCorner<2, 2>() << std::cos(angle), -std::sin(angle), std::sin(angle), std::cos(angle);
  older.information = 0.3 * turn.transpose() * match.shared * turn;
  edges.push_back(older);
  expect_near(KeyframeCovariance().of_last(graph.keyframes, graph.constraints),
              dense_covariance(graph.keyframes, edges));
}

/// At a known place only the constraint there counts, of all that end at the keyframe; what begins at it goes
/// on from there.
TEST(KeyframeCovariance, AKeyframeAtAKnownPlaceIsAttachedToIt) {
  Rng rng(8);
  Graph graph = random_chain(15, rng);
  graph.constraints.push_back({random_edge(graph, 3, 14, rng), {}, {}, true});
  std::vector<GraphEdge> edges;
  for (const KeyframeConstraint& constraint : graph.constraints) {
    if (constraint.edge.to < 14 || constraint.is_known_place) edges.push_back(constraint.edge);
  }
  KeyframeCovariance covariance;
  expect_near(covariance.of_last(graph.keyframes, graph.constraints),
              dense_covariance(graph.keyframes, edges));
  graph.keyframes.push_back({{{1.0, 2.0}, 0.5}, 0.0, {}});
  graph.constraints.push_back({random_edge(graph, 14, 15, rng), {}, {}, false});
  edges.push_back(graph.constraints.back().edge);
  expect_near(covariance.of_last(graph.keyframes, graph.constraints),
              dense_covariance(graph.keyframes, edges));
}

}  // namespace
}  // namespace outrider
