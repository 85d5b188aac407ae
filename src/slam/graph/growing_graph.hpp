// Incremental least squares of a growing pose graph: an update refactors only the part of the block Cholesky
// factor that depends on the changed nodes.
//
// Each node has a linearisation point, `place`, and a step from there, the solution of the linear equations.
// If the step of a node exceeds a threshold, the node is moved by it and its edges are linearised again
// ("fluid relinearisation": Kaess et al., iSAM2, IJRR 31 (2012) 216-235, algorithm 5). Every number depends
// only on the edges, the linearisation points and the elimination order, not on history.
#pragma once

#include <algorithm>

#include "algebra/block_cholesky.hpp"
#include "archive.hpp"
#include "graph/graph_edges.hpp"

namespace outrider {

class GrowingGraph {
 public:
  GrowingGraph(std::string kernel, double kernel_width);

  /// Adds a node and returns its index. The first node is fixed.
  std::uint32_t add_node(const Pose2& guess, bool is_point);
  /// Adds an edge by its covariance; zeros on its diagonal become 1e-12.
  void add_edge(EdgeKind kind, std::uint32_t from, std::uint32_t to, const Pose2& measured,
                const Eigen::Matrix3d& covariance);
  /// Relinearises the nodes that moved more than `threshold`, and solves.
  void update(double threshold);
  /// Chooses a new elimination order, with `last` at its end.
  void reorder(std::uint32_t last);
  /// Iterates Gauss-Newton to the minimum.
  void settle();

  [[nodiscard]] Pose2 estimate(std::uint32_t node) const;
  [[nodiscard]] double cost() const;
  /// Returns the number of measured values minus the number of unknowns.
  [[nodiscard]] std::int64_t degrees_of_freedom() const;
  [[nodiscard]] bool is_point(std::uint32_t node) const {
    return node < nodes_.size() && nodes_[node].is_point != 0;
  }
  /// Returns true if all nodes of the list are poses.
  [[nodiscard]] bool is_pose(const std::vector<std::uint32_t>& nodes) const {
    return std::all_of(nodes.begin(), nodes.end(), [&](std::uint32_t node) {
      return node < nodes_.size() && nodes_[node].is_point == 0;
    });
  }
  [[nodiscard]] Eigen::Matrix3d covariance(std::uint32_t node) const;
  [[nodiscard]] std::vector<Eigen::Matrix3d> covariances() const;
  /// Returns the covariance of a point in the frame of a pose, by the linear equations.
  [[nodiscard]] Eigen::Matrix2d relative_covariance(std::uint32_t pose, std::uint32_t point) const;

  template <class Archive>
  void exchange(Archive& archive) {
    archive(nodes_, edges_, order_);
    if constexpr (Archive::reading) {
      if (archive.ok) archive.ok = rebuild();
    }
  }

 private:
  struct PoseNode {
    Pose2 place;
    Eigen::Vector3d step = Eigen::Vector3d::Zero();
    std::int64_t is_point = 0;
    template <class Archive>
    void exchange(Archive& archive) {
      archive(place, step[0], step[1], step[2], is_point);
    }
  };
  struct Edge {
    std::int64_t kind = 0;
    std::uint32_t from = 0;
    std::uint32_t to = 0;
    Pose2 measured;
    Eigen::Matrix3d information = Eigen::Matrix3d::Zero();
    template <class Archive>
    void exchange(Archive& archive) {
      archive(kind, from, to, measured, information);
    }
  };

  [[nodiscard]] GraphEdge graph_edge(const Edge& edge) const;
  [[nodiscard]] LinearEdge linear(const Edge& edge) const;
  bool rebuild();
  void attach(std::uint32_t edge);
  void assemble(std::uint32_t node);
  void solve();

  std::string kernel_;
  double kernel_width_;
  std::vector<PoseNode> nodes_;
  std::vector<Edge> edges_;
  std::vector<std::uint32_t> order_;

  std::vector<std::vector<std::uint32_t>> edges_of_;  ///< by node
  std::vector<std::uint32_t> pair_of_;                ///< by edge
  std::vector<LinearEdge> linear_;                    ///< by edge
  std::vector<std::uint32_t> changed_;                ///< nodes with new edges
  BlockMatrix<3> matrix_;
  BlockCholesky<3> factor_;
  std::vector<Eigen::Vector3d> gradient_;
};

}  // namespace outrider
