// Sparse symmetric positive definite systems made of N x N blocks, one block row for each node of a graph.
//
// N is 1, 2, 3, 4 or 6: a planar pose has three unknowns, a spatial one six. A node with fewer than N
// unknowns has ones on the rest of its diagonal and zeros beside them.
//
// BlockCholesky factors P A P^T = L L^T for an elimination order P that the caller chooses, with a
// left-looking algorithm: each column subtracts the contributions of the columns to its left (Davis, Direct
// Methods for Sparse Linear Systems, SIAM 2006, chapter 4). After a change of some nodes, only these and
// their ancestors in the elimination tree are factored again (Kaess et al., iSAM2, IJRR 31 (2012) 216-235).
// Every number is then the same as in a factorisation from scratch, because contributions are added in the
// order of the columns. Complexity: time and memory grow with the fill of L, which least_fill_order() keeps
// small.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace outrider {

/// The nodes and the pairs of nodes joined by an edge.
class BlockPattern {
 public:
  struct Neighbour {
    std::uint32_t node = 0;
    std::uint32_t pair = 0;
  };

  [[nodiscard]] std::size_t size() const { return neighbours_.size(); }
  [[nodiscard]] std::span<const Neighbour> neighbours(std::uint32_t node) const { return neighbours_[node]; }

 protected:
  std::vector<std::vector<Neighbour>> neighbours_;
};

/// The symmetric matrix: one block for each node, and one for each pair.
template <int N>
class BlockMatrix : public BlockPattern {
 public:
  using Block = Eigen::Matrix<double, N, N>;

  void add_node();
  /// Returns the index of the pair; adds the pair if it is new.
  std::uint32_t pair(std::uint32_t a, std::uint32_t b);

  Block& diagonal(std::uint32_t node) { return diagonals_[node]; }
  [[nodiscard]] const Block& diagonal(std::uint32_t node) const { return diagonals_[node]; }
  /// Returns the block in the row of the smaller node and the column of the larger.
  Block& upper_block(std::uint32_t pair) { return blocks_[pair]; }
  /// Returns the block in that row and column.
  [[nodiscard]] Block block(std::uint32_t row, const Neighbour& column) const {
    const Block& upper = blocks_[column.pair];
    if (row < column.node) return upper;
    return upper.transpose();
  }

 private:
  std::vector<Block> diagonals_;
  std::vector<Block> blocks_;
};

/// Returns the nodes in an order of little fill, by approximate minimum degree. The nodes of `last`, which
/// must be distinct, come last.
std::vector<std::uint32_t> least_fill_order(const BlockPattern& pattern,
                                            std::span<const std::uint32_t> last = {});

/// Blocks of the inverse are compiled for the sizes of poses in the plane and in space.
template <int N>
constexpr bool has_inverse = N == 3 || N == 6;

template <int N>
class BlockCholesky {
 public:
  using Block = Eigen::Matrix<double, N, N>;
  using Vector = Eigen::Matrix<double, N, 1>;

  /// Sets the order of elimination and discards the factor; analyse() and factor() of all nodes follow.
  void begin(std::vector<std::uint32_t> order);
  /// Appends a new node, which is eliminated after all others.
  void append(std::uint32_t node);

  /// Updates the structure of L after these nodes changed; returns the places to factor again, ascending.
  std::vector<std::uint32_t> analyse(const BlockMatrix<N>& matrix, std::span<const std::uint32_t> changed);
  /// Factors the columns at these places; returns false if the matrix is not positive definite.
  bool factor(const BlockMatrix<N>& matrix, std::span<const std::uint32_t> places);
  /// Does the same for all nodes.
  void analyse_all(const BlockMatrix<N>& matrix);
  bool factor_all(const BlockMatrix<N>& matrix);

  /// Returns x with A x = b; both are by node.
  [[nodiscard]] std::vector<Vector> solve(std::span<const Vector> b) const;
  /// Returns the columns of the inverse that belong to a node: N solutions, as blocks by node.
  [[nodiscard]] std::vector<Block> inverse_columns(std::uint32_t node) const
    requires has_inverse<N>;
  /// Returns the diagonal block of the inverse for a node. Visits the columns of L that depend on it, so it
  /// is cheap for nodes late in the order.
  [[nodiscard]] Block inverse_diagonal(std::uint32_t node) const
    requires has_inverse<N>;
  /// The blocks of the inverse on the diagonal, by node, and those of pairs of nodes, in the row of the
  /// first.
  struct InverseBlocks {
    std::vector<Block> diagonals;
    std::vector<Block> pairs;
  };
  /// Returns the diagonal blocks of the inverse and those of pairs that the matrix has (Takahashi, Fagan and
  /// Chen, 1973); costs about as much as two factorisations.
  [[nodiscard]] InverseBlocks inverse_blocks(std::span<const std::array<std::uint32_t, 2>> pairs) const
    requires has_inverse<N>;
  /// Returns the number of blocks of L below its diagonal.
  [[nodiscard]] std::size_t fill() const;

 private:
  struct BlockAddress {
    std::uint32_t place = 0;  ///< place of the column
    std::uint32_t index = 0;  ///< index in its rows
  };
  struct Column {
    std::vector<std::uint32_t> rows;  ///< places below, ascending
    std::vector<Block> blocks;
    Block inverse = Block::Zero();  ///< inverse of the triangle on the diagonal
    std::vector<BlockAddress> row;  ///< the columns to the left that reach this row, ascending
    std::vector<std::uint32_t> children;
  };

  void analyse_column(const BlockMatrix<N>& matrix, std::uint32_t place);
  bool factor_column(const BlockMatrix<N>& matrix, std::uint32_t place);

  std::vector<std::uint32_t> order_;  ///< node at each place
  std::vector<std::uint32_t> place_;  ///< place of each node
  std::vector<Column> columns_;       ///< by place
  std::vector<std::uint8_t> marked_;  ///< by place: must be computed again
  std::vector<std::uint64_t> seen_;   ///< by place: the last structure that contains it
  std::vector<std::uint32_t> index_;  ///< by place: its index in the rows of the present column
  std::uint64_t stamp_ = 0;
};

}  // namespace outrider
