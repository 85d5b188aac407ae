#include "block_cholesky.hpp"

#include <algorithm>
#include <limits>
#include <numeric>

namespace outrider {
namespace {

constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();  ///< no parent: a root

/// a -= b c^T.
inline void subtract_product(Matrix3& a, const Matrix3& b, const Matrix3& c) {
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) {
      a(i, j) -= b(i, 0) * c(j, 0) + b(i, 1) * c(j, 1) + b(i, 2) * c(j, 2);
    }
  }
}

Block3 operator-(const Block3& a, const Block3& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }

}  // namespace

void BlockMatrix::add_node() {
  diagonals_.emplace_back();
  neighbours_.emplace_back();
}

std::uint32_t BlockMatrix::pair(std::uint32_t a, std::uint32_t b) {
  auto& shorter = neighbours_[neighbours_[a].size() <= neighbours_[b].size() ? a : b];
  const std::uint32_t other = &shorter == &neighbours_[a] ? b : a;
  for (const Neighbour& neighbour : shorter) {
    if (neighbour.node == other) return neighbour.pair;
  }
  const auto number = static_cast<std::uint32_t>(blocks_.size());
  blocks_.emplace_back();
  neighbours_[a].push_back({b, number});
  neighbours_[b].push_back({a, number});
  return number;
}

void BlockCholesky::begin(std::vector<std::uint32_t> order) {
  order_ = std::move(order);
  place_.assign(order_.size(), 0);
  for (std::size_t i = 0; i < order_.size(); ++i) place_[order_[i]] = static_cast<std::uint32_t>(i);
  columns_.assign(order_.size(), {});
  marked_.assign(order_.size(), 0);
  seen_.assign(order_.size(), 0);
  index_.assign(order_.size(), 0);
  stamp_ = 0;
}

void BlockCholesky::append(std::uint32_t node) {
  place_.resize(std::max<std::size_t>(place_.size(), node + 1), 0);
  place_[node] = static_cast<std::uint32_t>(order_.size());
  order_.push_back(node);
  columns_.emplace_back();
  marked_.push_back(0);
  seen_.push_back(0);
  index_.push_back(0);
}

/// The rows of a column: those of the matrix and those of its children in the elimination tree. All marked
/// places to the left are done.
void BlockCholesky::structure_of(const BlockMatrix& matrix, std::uint32_t place) {
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

std::vector<std::uint32_t> BlockCholesky::structure(const BlockMatrix& matrix,
                                                    std::span<const std::uint32_t> changed) {
  std::vector<std::uint32_t> places;
  auto first = static_cast<std::uint32_t>(order_.size());
  for (const std::uint32_t node : changed) {
    marked_[place_[node]] = 1;
    first = std::min(first, place_[node]);
  }
  for (std::uint32_t place = first; place < order_.size(); ++place) {
    if (marked_[place] == 0) continue;
    structure_of(matrix, place);
    places.push_back(place);
  }
  for (const std::uint32_t place : places) {
    std::erase_if(columns_[place].row, [&](const Entry& entry) { return marked_[entry.place] != 0; });
  }
  for (const std::uint32_t place : places) {
    const auto& rows = columns_[place].rows;
    for (std::uint32_t index = 0; index < rows.size(); ++index) {
      columns_[rows[index]].row.push_back({place, index});
    }
  }
  for (const std::uint32_t place : places) {
    auto& row = columns_[place].row;
    std::sort(row.begin(), row.end(), [](const Entry& a, const Entry& b) { return a.place < b.place; });
    marked_[place] = 0;
  }
  return places;
}

/// L(i,j) = (A(i,j) - sum over k < j of L(i,k) L(j,k)^T) L(j,j)^-T.
bool BlockCholesky::numbers_of(const BlockMatrix& matrix, std::uint32_t place) {
  Column& column = columns_[place];
  const std::uint32_t node = order_[place];
  for (std::uint32_t index = 0; index < column.rows.size(); ++index) {
    index_[column.rows[index]] = index;
    column.blocks[index] = {};
  }
  Matrix3 pivot = matrix.diagonal(node);
  for (const auto& neighbour : matrix.neighbours(node)) {
    const std::uint32_t row = place_[neighbour.node];
    if (row > place) column.blocks[index_[row]] = transposed(matrix.block(node, neighbour));
  }
  for (const Entry& entry : column.row) {
    const Column& left = columns_[entry.place];
    const Matrix3 factor = left.blocks[entry.index];
    subtract_product(pivot, factor, factor);
    for (std::size_t i = entry.index + 1; i < left.rows.size(); ++i) {
      subtract_product(column.blocks[index_[left.rows[i]]], left.blocks[i], factor);
    }
  }
  const auto triangle = cholesky(pivot);
  if (!triangle) return false;
  column.inverse = inverse_of_lower(*triangle);
  const Matrix3 right = transposed(column.inverse);
  for (Matrix3& block : column.blocks) block = block * right;
  return true;
}

bool BlockCholesky::numbers(const BlockMatrix& matrix, std::span<const std::uint32_t> places) {
  return std::all_of(places.begin(), places.end(),
                     [&](std::uint32_t place) { return numbers_of(matrix, place); });
}

void BlockCholesky::structure_of_all(const BlockMatrix& matrix) { structure(matrix, order_); }

bool BlockCholesky::numbers_of_all(const BlockMatrix& matrix) {
  for (std::uint32_t place = 0; place < order_.size(); ++place) {
    if (!numbers_of(matrix, place)) return false;
  }
  return true;
}

std::vector<Block3> BlockCholesky::solve(std::span<const Block3> b) const {
  std::vector<Block3> x(order_.size());
  for (std::size_t place = 0; place < order_.size(); ++place) x[place] = b[order_[place]];
  for (std::size_t place = 0; place < order_.size(); ++place) {
    const Column& column = columns_[place];
    x[place] = column.inverse * x[place];
    for (std::size_t i = 0; i < column.rows.size(); ++i) {
      Block3& below = x[column.rows[i]];
      below = below - column.blocks[i] * x[place];
    }
  }
  for (std::size_t place = order_.size(); place-- > 0;) {
    const Column& column = columns_[place];
    for (std::size_t i = 0; i < column.rows.size(); ++i) {
      x[place] = x[place] - transposed(column.blocks[i]) * x[column.rows[i]];
    }
    x[place] = transposed(column.inverse) * x[place];
  }
  std::vector<Block3> result(order_.size());
  for (std::size_t place = 0; place < order_.size(); ++place) result[order_[place]] = x[place];
  return result;
}

std::vector<Matrix3> BlockCholesky::inverse_columns(std::uint32_t node) const {
  std::vector<Matrix3> result(order_.size());
  for (std::size_t k = 0; k < 3; ++k) {
    std::vector<Block3> unit(order_.size());
    unit[node][k] = 1.0;
    const std::vector<Block3> column = solve(unit);
    for (std::size_t i = 0; i < column.size(); ++i) {
      for (std::size_t r = 0; r < 3; ++r) result[i](r, k) = column[i][r];
    }
  }
  return result;
}

/// The inverse is L^-T L^-1: with Y the columns of L^-1 that belong to the node, its block is Y^T Y.
Matrix3 BlockCholesky::inverse_diagonal(std::uint32_t node) const {
  const std::uint32_t first = place_[node];
  std::vector<Matrix3> y(order_.size() - first);
  y.front() = diagonal<3>({1.0, 1.0, 1.0});
  Matrix3 sum;
  for (std::uint32_t place = first; place < order_.size(); ++place) {
    Matrix3& here = y[place - first];
    if (here == Matrix3{}) continue;
    const Column& column = columns_[place];
    here = column.inverse * here;
    sum += transposed(here) * here;
    for (std::size_t i = 0; i < column.rows.size(); ++i)
      y[column.rows[i] - first] += -1.0 * (column.blocks[i] * here);
  }
  return sum;
}

/// With Z the inverse and S(i) = L(i,j) L(j,j)^-1 for the rows i of column j: Z(i,j) = -sum of Z(i,k) S(k),
/// and Z(j,j) = L(j,j)^-T L(j,j)^-1 - sum of Z(j,k) S(k); every Z(i,k) needed lies in the structure of L.
std::vector<Matrix3> BlockCholesky::inverse_diagonals() const {
  std::vector<Matrix3> diagonals(order_.size());
  std::vector<std::vector<Matrix3>> inverse(order_.size());
  const auto entry = [&](std::uint32_t row, std::uint32_t place) {
    if (row == place) return diagonals[row];
    const std::uint32_t left = std::min(row, place);
    const auto& rows = columns_[left].rows;
    const auto at = std::lower_bound(rows.begin(), rows.end(), std::max(row, place)) - rows.begin();
    const Matrix3& found = inverse[left][static_cast<std::size_t>(at)];
    return row > place ? found : transposed(found);
  };
  for (std::size_t place = order_.size(); place-- > 0;) {
    const Column& column = columns_[place];
    std::vector<Matrix3> scaled;
    for (const Matrix3& block : column.blocks) scaled.push_back(block * column.inverse);
    inverse[place].resize(column.rows.size());
    for (std::size_t i = 0; i < column.rows.size(); ++i) {
      for (std::size_t k = 0; k < column.rows.size(); ++k) {
        inverse[place][i] += -1.0 * (entry(column.rows[i], column.rows[k]) * scaled[k]);
      }
    }
    diagonals[place] = transposed(column.inverse) * column.inverse;
    for (std::size_t k = 0; k < column.rows.size(); ++k) {
      diagonals[place] += -1.0 * (transposed(inverse[place][k]) * scaled[k]);
    }
  }
  std::vector<Matrix3> result(order_.size());
  for (std::size_t place = 0; place < order_.size(); ++place) result[order_[place]] = diagonals[place];
  return result;
}

std::size_t BlockCholesky::fill() const {
  return std::accumulate(columns_.begin(), columns_.end(), std::size_t{0},
                         [](std::size_t sum, const Column& column) { return sum + column.rows.size(); });
}

}  // namespace outrider
