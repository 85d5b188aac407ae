// Random pose graphs of the plane and of space whose true poses are known.
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "graph/graph_edges.hpp"
#include "graph/graph_starts.hpp"
#include "support/random_cases.hpp"

namespace outrider::testing {

template <class Pose>
PoseVector<Pose> random_step(double size, Rng& rng) {
  PoseVector<Pose> step;
  for (double& value : step.reshaped()) value = rng.uniform(-size, size);
  return step;
}

template <class Pose>
Pose random_pose(Rng& rng) {
  PoseVector<Pose> step = random_step<Pose>(3.0, rng);
  step.template head<dimension<Pose>>() *= 2.0;
  return retract(Pose{}, step);
}

template <class Pose>
PoseMatrix<Pose> random_information(EdgeKind kind, Rng& rng) {
  const Eigen::Index n = residual_rows<Pose>(kind);
  PoseMatrix<Pose> result = PoseMatrix<Pose>::Zero();
  for (int k = 0; k < freedoms<Pose> + 1; ++k) {
    PoseVector<Pose> v;
    for (double& value : v.reshaped()) value = rng.normal();
    result.topLeftCorner(n, n) += 20.0 * v.head(n) * v.head(n).transpose();
  }
  return result;
}

/// Returns the measurement of an edge between these poses, moved by `error` in each direction.
template <class Pose>
Pose measurement(EdgeKind kind, const Pose& from, const Pose& to, double error, Rng& rng) {
  PoseVector<Pose> noise = PoseVector<Pose>::Zero();
  for (double& value : noise.reshaped()) value = error * rng.normal();
  Pose result;
  if (kind == EdgeKind::range) {
    result.position.x = (position_of(to) - position_of(from)).norm() + noise[0];
    return result;
  }
  const auto back = rotation_of(from).transpose().eval();
  set_position(result, back * (position_of(to) - position_of(from)) + noise.template head<dimension<Pose>>());
  if (kind == EdgeKind::point) return result;
  set_rotation(result, back * rotation_of(to));
  noise.template head<dimension<Pose>>().setZero();
  Pose turned = retract(result, noise);
  turned.position = result.position;
  return turned;
}

/// A walk with loops, points and ranges; measurements of the nodes' poses with errors of that size.
template <class Pose = Pose2>
PoseGraphOf<Pose> random_graph(std::size_t poses, std::size_t points, double error, Rng& rng) {
  PoseGraphOf<Pose> graph;
  for (std::size_t i = 0; i < poses + points; ++i) {
    Pose pose = random_pose<Pose>(rng);
    if (i >= poses) {
      const auto position = pose.position;
      pose = {};
      pose.position = position;
    }
    graph.nodes.push_back({fmt::format("{}", i), pose, i >= poses});
  }
  const auto join = [&](EdgeKind kind, std::size_t from, std::size_t to) {
    GraphEdgeOf<Pose> edge{kind, static_cast<std::uint32_t>(from), static_cast<std::uint32_t>(to), {}};
    edge.information = random_information<Pose>(kind, rng);
    edge.measured = measurement(kind, graph.nodes[from].pose, graph.nodes[to].pose, error, rng);
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

/// A ring of poses, each a metre and a part of the turn from the one before; as given, they wind around it so
/// often.
inline PoseGraph winding_ring(int count, int times) {
  PoseGraph ring;
  for (int i = 0; i < count; ++i) {
    const Pose2 pose{{0.1 * i, 0.0}, wrap_angle(2.0 * pi * times / count * i)};
    ring.nodes.push_back({fmt::format("{}", i), pose, false});
  }
  for (int i = 0; i < count; ++i) {
    GraphEdge edge{
        EdgeKind::pose, static_cast<std::uint32_t>(i), static_cast<std::uint32_t>((i + 1) % count), {}};
    edge.measured = {{1.0, 0.0}, 2.0 * pi / count + 0.01};
    edge.information = Eigen::Vector3d(10.0, 10.0, 100.0).asDiagonal();
    ring.edges.push_back(edge);
  }
  return ring;
}

template <class Pose>
std::vector<Pose> shaken(std::vector<Pose> poses, const PoseGraphOf<Pose>& graph, double size, Rng& rng) {
  for (std::size_t i = 1; i < poses.size(); ++i) {
    const PoseVector<Pose> step = random_step<Pose>(size, rng);
    const auto position = position_of(poses[i]);
    if (!graph.nodes[i].is_point) poses[i] = retract(poses[i], step);
    set_position(poses[i], position + step.template head<dimension<Pose>>());
  }
  return poses;
}

/// The largest distance between positions.
template <class Pose>
double largest_gap(const std::vector<Pose>& a, const std::vector<Pose>& b) {
  double largest = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    largest = std::max(largest, (position_of(a[i]) - position_of(b[i])).norm());
  }
  return largest;
}

}  // namespace outrider::testing
