// Sparse symmetric positive definite systems made of 3 x 3 blocks, one block row for each node of a graph.
//
// A node with fewer unknowns has ones on the rest of its diagonal and zeros beside them.
//
// BlockCholesky factors P A P^T = L L^T, where the caller chooses the order P: left-looking by columns, each
// column the sum of what the columns to its left give it (Davis, Direct Methods for Sparse Linear Systems,
// SIAM 2006, chapter 4). After a change of some nodes, only these and their ancestors in the elimination tree
// are done again (Kaess et al., iSAM2, IJRR 31 (2012) 216-235), and every number is the same as in a
// factorisation from the beginning: a column adds what it is given in the order of the columns that give it.
// Complexity: time and memory grow with the fill of L, which least_fill_order() keeps small.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "outrider/slam/matrix.hpp"

namespace outrider {

using Block3 = std::array<double, 3>;

/// The symmetric matrix: a block for each node, and one for each pair of nodes that an edge joins.
class BlockMatrix {
 public:
  struct Neighbour {
    std::uint32_t node = 0;
    std::uint32_t pair = 0;
  };

  [[nodiscard]] std::size_t size() const { return diagonals_.size(); }
  void add_node();
  /// The number of the pair; makes it when it is new.
  std::uint32_t pair(std::uint32_t a, std::uint32_t b);

  Matrix3& diagonal(std::uint32_t node) { return diagonals_[node]; }
  [[nodiscard]] const Matrix3& diagonal(std::uint32_t node) const { return diagonals_[node]; }
  /// The block in the row of the smaller node and the column of the larger.
  Matrix3& between(std::uint32_t pair) { return blocks_[pair]; }
  /// The block in that row and column.
  [[nodiscard]] Matrix3 block(std::uint32_t row, const Neighbour& column) const {
    return row < column.node ? blocks_[column.pair] : transposed(blocks_[column.pair]);
  }
  [[nodiscard]] std::span<const Neighbour> neighbours(std::uint32_t node) const { return neighbours_[node]; }

 private:
  std::vector<Matrix3> diagonals_;
  std::vector<Matrix3> blocks_;
  std::vector<std::vector<Neighbour>> neighbours_;
};

/// The nodes in an order of little fill: approximate minimum degree. The nodes of `last`, each of them once,
/// come last.
std::vector<std::uint32_t> least_fill_order(const BlockMatrix& matrix,
                                            std::span<const std::uint32_t> last = {});

class BlockCholesky {
 public:
  /// Nodes in the order of elimination; forgets everything before. Then structure() and numbers() of all.
  void begin(std::vector<std::uint32_t> order);
  /// A new node, eliminated after all others.
  void append(std::uint32_t node);

  /// The places that have to be done again when these nodes changed, ascending.
  std::vector<std::uint32_t> structure(const BlockMatrix& matrix, std::span<const std::uint32_t> changed);
  /// False when the matrix is not positive definite.
  bool numbers(const BlockMatrix& matrix, std::span<const std::uint32_t> places);
  /// Both, for all nodes.
  void structure_of_all(const BlockMatrix& matrix);
  bool numbers_of_all(const BlockMatrix& matrix);

  /// x with A x = b, both by node.
  [[nodiscard]] std::vector<Block3> solve(std::span<const Block3> b) const;
  /// The columns of the inverse that belong to a node: three solutions, as blocks by node.
  [[nodiscard]] std::vector<Matrix3> inverse_columns(std::uint32_t node) const;
  /// The diagonal block of the inverse for a node: as much work as the columns of L from it on that depend on
  /// it, next to nothing for one of the last.
  [[nodiscard]] Matrix3 inverse_diagonal(std::uint32_t node) const;
  /// The diagonal blocks of the inverse, by node (Takahashi, Fagan and Chen, 1973): as much work as a
  /// factorisation.
  [[nodiscard]] std::vector<Matrix3> inverse_diagonals() const;
  /// Blocks of L, without its diagonal.
  [[nodiscard]] std::size_t fill() const;

 private:
  struct Entry {
    std::uint32_t place = 0;  ///< of the column
    std::uint32_t index = 0;  ///< in its rows
  };
  struct Column {
    std::vector<std::uint32_t> rows;  ///< places below, ascending
    std::vector<Matrix3> blocks;
    Matrix3 inverse;         ///< of the triangle on the diagonal
    std::vector<Entry> row;  ///< the columns to the left that reach this row, ascending
    std::vector<std::uint32_t> children;
  };

  void structure_of(const BlockMatrix& matrix, std::uint32_t place);
  bool numbers_of(const BlockMatrix& matrix, std::uint32_t place);

  std::vector<std::uint32_t> order_;  ///< node at each place
  std::vector<std::uint32_t> place_;  ///< of each node
  std::vector<Column> columns_;       ///< by place
  std::vector<std::uint8_t> marked_;  ///< by place: to be done again
  std::vector<std::uint64_t> seen_;   ///< by place: the last structure that has it
  std::vector<std::uint32_t> index_;  ///< by place: its index in the rows of the column in work
  std::uint64_t stamp_ = 0;
};

}  // namespace outrider
