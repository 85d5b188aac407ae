// The normal equations H x = -g of a pose graph whose node `fixed` does not move; x are the steps of its
// nodes.
#pragma once

#include <array>

#include "algebra/block_cholesky.hpp"
#include "graph/graph_edges.hpp"

namespace outrider {

template <class Pose>
using GraphSteps = std::vector<PoseVector<Pose>>;  ///< by node

template <class Pose>
class GraphEquations {
 public:
  GraphEquations(const PoseGraphOf<Pose>& graph, std::uint32_t fixed);

  /// Resets all equations to zero, with ones on the diagonal where there is no unknown.
  void clear();
  void add(std::size_t edge, const LinearEdgeOf<Pose>& linear);

  /// Factors H with its diagonal raised by that part; returns false if it is not positive definite.
  bool factor(double damping);
  /// Returns the steps of the factored equations.
  [[nodiscard]] GraphSteps<Pose> solve() const;
  /// Returns the steps of steepest descent, -B^-1 g, in the norm of the diagonal blocks B of H, and the inner
  /// product a^T B b of that norm: a step is as long in metres as in radians if it changes the errors as
  /// much.
  [[nodiscard]] GraphSteps<Pose> steepest() const;
  [[nodiscard]] double inner_product(const GraphSteps<Pose>& a, const GraphSteps<Pose>& b) const;
  /// Returns -2 g^T x - x^T H x: by how much the cost falls at these steps, according to the linear model.
  [[nodiscard]] double predicted_decrease(const GraphSteps<Pose>& steps) const;
  /// Returns x^T H x.
  [[nodiscard]] double curvature(const GraphSteps<Pose>& steps) const;
  /// Returns -g^T x.
  [[nodiscard]] double slope(const GraphSteps<Pose>& steps) const;
  /// Factors H and returns the covariances of the nodes, and by edge those of its two nodes with each other,
  /// which are blocks of the inverse of H; that of the fixed node is 0. Empty if H is singular.
  using Covariances = typename BlockCholesky<freedoms<Pose>>::InverseBlocks;
  Covariances covariances();

 private:
  std::uint32_t fixed_;
  std::vector<std::uint8_t> is_point_;
  std::vector<std::uint32_t> pairs_;  ///< by edge
  std::vector<std::array<std::uint32_t, 2>> ends_;
  BlockMatrix<freedoms<Pose>> matrix_;
  GraphSteps<Pose> gradient_;
  BlockCholesky<freedoms<Pose>> factor_;
};

}  // namespace outrider
