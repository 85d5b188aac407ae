#include "algebra/block_cholesky.hpp"

#include <algorithm>
#include <limits>
#include <numeric>

#include "algebra/small_cholesky.hpp"

namespace outrider {
namespace {

constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();  ///< no parent: a root

}  // namespace

template <int N>
void BlockMatrix<N>::add_node() {
  diagonals_.push_back(Block::Zero());
  neighbours_.emplace_back();
}

template <int N>
std::uint32_t BlockMatrix<N>::pair(std::uint32_t a, std::uint32_t b) {
  auto& shorter = neighbours_[neighbours_[a].size() <= neighbours_[b].size() ? a : b];
  const std::uint32_t other = &shorter == &neighbours_[a] ? b : a;
  for (const Neighbour& neighbour : shorter) {
    if (neighbour.node == other) return neighbour.pair;
  }
  const auto number = static_cast<std::uint32_t>(blocks_.size());
  blocks_.push_back(Block::Zero());
  neighbours_[a].push_back({b, number});
  neighbours_[b].push_back({a, number});
  return number;
}

template <int N>
void BlockCholesky<N>::begin(std::vector<std::uint32_t> order) {
  order_ = std::move(order);
  place_.assign(order_.size(), 0);
  for (std::size_t i = 0; i < order_.size(); ++i) place_[order_[i]] = static_cast<std::uint32_t>(i);
  columns_.assign(order_.size(), {});
  marked_.assign(order_.size(), 0);
  seen_.assign(order_.size(), 0);
  index_.assign(order_.size(), 0);
  stamp_ = 0;
}

template <int N>
void BlockCholesky<N>::append(std::uint32_t node) {
  place_.resize(std::max<std::size_t>(place_.size(), node + 1), 0);
  place_[node] = static_cast<std::uint32_t>(order_.size());
  order_.push_back(node);
  columns_.emplace_back();
  marked_.push_back(0);
  seen_.push_back(0);
  index_.push_back(0);
}

/// Computes the rows of a column: those of the matrix and those of its children in the elimination tree. All
/// marked places to the left must be done.
template <int N>
void BlockCholesky<N>::analyse_column(const BlockMatrix<N>& matrix, std::uint32_t place) {
  Column& column = columns_[place];
  const auto parent = [&](std::uint32_t child) {
    return columns_[child].rows.empty() ? none : columns_[child].rows.front();
  };
  std::erase_if(column.children, [&](std::uint32_t child) { return parent(child) != place; });
  const std::uint32_t parent_before = parent(place);
  column.rows.clear();
  ++stamp_;
  const auto add = [&](std::uint32_t row) {
    if (row <= place || seen_[row] == stamp_) return;
    seen_[row] = stamp_;
    column.rows.push_back(row);
  };
  for (const auto& neighbour : matrix.neighbours(order_[place])) add(place_[neighbour.node]);
  for (const std::uint32_t child : column.children) {
    for (const std::uint32_t row : columns_[child].rows) add(row);
  }
  std::sort(column.rows.begin(), column.rows.end());
  column.blocks.resize(column.rows.size());
  const std::uint32_t parent_now = parent(place);
  if (parent_now == none) return;
  marked_[parent_now] = 1;
  if (parent_now != parent_before) columns_[parent_now].children.push_back(place);
}

template <int N>
std::vector<std::uint32_t> BlockCholesky<N>::analyse(const BlockMatrix<N>& matrix,
                                                     std::span<const std::uint32_t> changed) {
  std::vector<std::uint32_t> places;
  auto first = static_cast<std::uint32_t>(order_.size());
  for (const std::uint32_t node : changed) {
    marked_[place_[node]] = 1;
    first = std::min(first, place_[node]);
  }
  for (std::uint32_t place = first; place < order_.size(); ++place) {
    if (marked_[place] == 0) continue;
    analyse_column(matrix, place);
    places.push_back(place);
  }
  for (const std::uint32_t place : places) {
    std::erase_if(columns_[place].row, [&](const BlockAddress& entry) { return marked_[entry.place] != 0; });
  }
  for (const std::uint32_t place : places) {
    const auto& rows = columns_[place].rows;
    for (std::uint32_t index = 0; index < rows.size(); ++index) {
      columns_[rows[index]].row.push_back({place, index});
    }
  }
  for (const std::uint32_t place : places) {
    auto& row = columns_[place].row;
    std::sort(row.begin(), row.end(),
              [](const BlockAddress& a, const BlockAddress& b) { return a.place < b.place; });
    marked_[place] = 0;
  }
  return places;
}

/// L(i,j) = (A(i,j) - sum over k < j of L(i,k) L(j,k)^T) L(j,j)^-T.
template <int N>
bool BlockCholesky<N>::factor_column(const BlockMatrix<N>& matrix, std::uint32_t place) {
  Column& column = columns_[place];
  const std::uint32_t node = order_[place];
  for (std::uint32_t index = 0; index < column.rows.size(); ++index) {
    index_[column.rows[index]] = index;
    column.blocks[index].setZero();
  }
  Block pivot = matrix.diagonal(node);
  for (const auto& neighbour : matrix.neighbours(node)) {
    const std::uint32_t row = place_[neighbour.node];
    if (row > place) column.blocks[index_[row]] = matrix.block(node, neighbour).transpose();
  }
  for (const BlockAddress& entry : column.row) {
    const Column& left = columns_[entry.place];
    const Block factor = left.blocks[entry.index].transpose();
    pivot.noalias() -= left.blocks[entry.index] * factor;
    for (std::size_t i = entry.index + 1; i < left.rows.size(); ++i) {
      column.blocks[index_[left.rows[i]]].noalias() -= left.blocks[i] * factor;
    }
  }
  const SmallCholesky<N> triangle(pivot);
  if (!triangle.is_positive()) return false;
  column.inverse = triangle.inverse_of_triangle();
  const Block right = column.inverse.transpose();
  for (Block& block : column.blocks) block = block * right;
  return true;
}

template <int N>
bool BlockCholesky<N>::factor(const BlockMatrix<N>& matrix, std::span<const std::uint32_t> places) {
  return std::all_of(places.begin(), places.end(),
                     [&](std::uint32_t place) { return factor_column(matrix, place); });
}

template <int N>
void BlockCholesky<N>::analyse_all(const BlockMatrix<N>& matrix) {
  analyse(matrix, order_);
}

template <int N>
bool BlockCholesky<N>::factor_all(const BlockMatrix<N>& matrix) {
  for (std::uint32_t place = 0; place < order_.size(); ++place) {
    if (!factor_column(matrix, place)) return false;
  }
  return true;
}

template <int N>
std::vector<Eigen::Matrix<double, N, 1>> BlockCholesky<N>::solve(std::span<const Vector> b) const {
  std::vector<Vector> x(order_.size());
  for (std::size_t place = 0; place < order_.size(); ++place) x[place] = b[order_[place]];
  for (std::size_t place = 0; place < order_.size(); ++place) {
    const Column& column = columns_[place];
    x[place] = column.inverse * x[place];
    for (std::size_t i = 0; i < column.rows.size(); ++i) {
      x[column.rows[i]].noalias() -= column.blocks[i] * x[place];
    }
  }
  for (std::size_t place = order_.size(); place-- > 0;) {
    const Column& column = columns_[place];
    for (std::size_t i = 0; i < column.rows.size(); ++i) {
      x[place].noalias() -= column.blocks[i].transpose() * x[column.rows[i]];
    }
    x[place] = column.inverse.transpose() * x[place];
  }
  std::vector<Vector> result(order_.size());
  for (std::size_t place = 0; place < order_.size(); ++place) result[order_[place]] = x[place];
  return result;
}

template <int N>
std::vector<Eigen::Matrix<double, N, N>> BlockCholesky<N>::inverse_columns(std::uint32_t node) const
  requires has_inverse<N>
{
  std::vector<Block> result(order_.size());
  for (Eigen::Index k = 0; k < N; ++k) {
    std::vector<Vector> unit(order_.size(), Vector::Zero());
    unit[node] = Vector::Unit(k);
    const std::vector<Vector> column = solve(unit);
    for (std::size_t i = 0; i < column.size(); ++i) result[i].col(k) = column[i];
  }
  return result;
}

/// The inverse is L^-T L^-1: with Y the columns of L^-1 that belong to the node, its block is Y^T Y.
template <int N>
Eigen::Matrix<double, N, N> BlockCholesky<N>::inverse_diagonal(std::uint32_t node) const
  requires has_inverse<N>
{
  const std::uint32_t first = place_[node];
  std::vector<Block> y(order_.size() - first, Block::Zero());
  y.front().setIdentity();
  Block sum = Block::Zero();
  for (std::uint32_t place = first; place < order_.size(); ++place) {
    Block& here = y[place - first];
    if (here.isZero(0.0)) continue;
    const Column& column = columns_[place];
    here = column.inverse * here;
    sum.noalias() += here.transpose() * here;
    for (std::size_t i = 0; i < column.rows.size(); ++i) {
      y[column.rows[i] - first].noalias() -= column.blocks[i] * here;
    }
  }
  return sum;
}

/// With Z the inverse and S(i) = L(i,j) L(j,j)^-1 for the rows i of column j: Z(i,j) = -sum of Z(i,k) S(k),
/// and Z(j,j) = L(j,j)^-T L(j,j)^-1 - sum of Z(j,k) S(k); every Z(i,k) needed lies in the structure of L.
template <int N>
auto BlockCholesky<N>::inverse_blocks(std::span<const std::array<std::uint32_t, 2>> pairs) const
    -> InverseBlocks
  requires has_inverse<N>
{
  std::vector<Block> diagonals(order_.size());
  std::vector<std::vector<Block>> inverse(order_.size());
  const auto entry = [&](std::uint32_t row, std::uint32_t place) -> Block {
    if (row == place) return diagonals[row];
    const std::uint32_t left = std::min(row, place);
    const auto& rows = columns_[left].rows;
    const auto at = std::lower_bound(rows.begin(), rows.end(), std::max(row, place)) - rows.begin();
    const Block& found = inverse[left][static_cast<std::size_t>(at)];
    if (row > place) return found;
    return found.transpose();
  };
  for (std::size_t place = order_.size(); place-- > 0;) {
    const Column& column = columns_[place];
    std::vector<Block> scaled;
    for (const Block& block : column.blocks) scaled.emplace_back(block * column.inverse);
    inverse[place].resize(column.rows.size(), Block::Zero());
    for (std::size_t i = 0; i < column.rows.size(); ++i) {
      for (std::size_t k = 0; k < column.rows.size(); ++k) {
        inverse[place][i].noalias() -= entry(column.rows[i], column.rows[k]) * scaled[k];
      }
    }
    diagonals[place] = column.inverse.transpose() * column.inverse;
    for (std::size_t k = 0; k < column.rows.size(); ++k) {
      diagonals[place].noalias() -= inverse[place][k].transpose() * scaled[k];
    }
  }
  InverseBlocks result{std::vector<Block>(order_.size()), {}};
  for (std::size_t place = 0; place < order_.size(); ++place)
    result.diagonals[order_[place]] = diagonals[place];
  for (const auto& [a, b] : pairs) result.pairs.push_back(entry(place_[a], place_[b]));
  return result;
}

template <int N>
std::size_t BlockCholesky<N>::fill() const {
  return std::accumulate(columns_.begin(), columns_.end(), std::size_t{0},
                         [](std::size_t sum, const Column& column) { return sum + column.rows.size(); });
}

template class BlockMatrix<1>;
template class BlockMatrix<2>;
template class BlockMatrix<3>;
template class BlockMatrix<4>;
template class BlockMatrix<6>;
template class BlockCholesky<1>;
template class BlockCholesky<2>;
template class BlockCholesky<3>;
template class BlockCholesky<4>;
template class BlockCholesky<6>;

}  // namespace outrider
