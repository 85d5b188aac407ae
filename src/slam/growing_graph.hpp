// A pose graph that grows, and its least squares kept up to date: a step changes the part of the block
// Cholesky factor that depends on it, and no other.
//
// Each node has a place where its edges are linearised, and the step from there that the linear equations
// give. A node whose step grows beyond a bound is moved by it and its edges are linearised again ("fluid
// relinearisation": Kaess et al., iSAM2, IJRR 31 (2012) 216-235, algorithm 5).
// Every number is a function of the edges, the places and the order of elimination, whatever came before.
#pragma once

#include <algorithm>

#include "archive.hpp"
#include "graph_edges.hpp"

namespace outrider {

class GrowingGraph {
 public:
  GrowingGraph(std::string kernel, double kernel_width);

  /// The number of the node; the first is held where it is.
  std::uint32_t add_node(const Pose2& guess, bool is_point);
  /// Takes covariance; exact odometry gets 1e-12.
  void add_edge(EdgeKind kind, std::uint32_t from, std::uint32_t to, const Pose2& measured,
                const Matrix3& covariance);
  /// Linearises again what moved more than `threshold`, and solves.
  void update(double threshold);
  /// Chooses the order of elimination anew, with that node last.
  void reorder(std::uint32_t last);
  /// Gauss-Newton steps to the minimum.
  void settle();

  [[nodiscard]] Pose2 estimate(std::uint32_t node) const;
  [[nodiscard]] double cost() const;
  [[nodiscard]] bool is_point(std::uint32_t node) const {
    return node < nodes_.size() && nodes_[node].is_point != 0;
  }
  /// Whether all of them are poses.
  [[nodiscard]] bool is_pose(const std::vector<std::uint32_t>& nodes) const {
    return std::all_of(nodes.begin(), nodes.end(), [&](std::uint32_t node) {
      return node < nodes_.size() && nodes_[node].is_point == 0;
    });
  }
  [[nodiscard]] Matrix3 covariance(std::uint32_t node) const;
  [[nodiscard]] std::vector<Matrix3> covariances() const;
  /// Of a point in the frame of a pose; what the linear equations make of it.
  [[nodiscard]] Matrix2 relative_covariance(std::uint32_t pose, std::uint32_t point) const;

  template <class Archive>
  void exchange(Archive& archive) {
    archive(nodes_, edges_, order_);
    if constexpr (Archive::reading) {
      if (archive.ok) archive.ok = rebuild();
    }
  }

 private:
  struct Node {
    Pose2 place;
    Block3 step{};
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
    Matrix3 information;
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
  std::vector<Node> nodes_;
  std::vector<Edge> edges_;
  std::vector<std::uint32_t> order_;

  std::vector<std::vector<std::uint32_t>> edges_of_;  ///< by node
  std::vector<std::uint32_t> pair_of_;                ///< by edge
  std::vector<LinearEdge> linear_;                    ///< by edge
  std::vector<std::uint32_t> changed_;                ///< nodes with new edges
  BlockMatrix matrix_;
  BlockCholesky factor_;
  std::vector<Block3> gradient_;
};

}  // namespace outrider
