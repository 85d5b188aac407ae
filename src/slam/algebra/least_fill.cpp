#include <Eigen/OrderingMethods>
#include <Eigen/SparseCore>
#include <numeric>

#include "algebra/block_cholesky.hpp"

namespace outrider {

std::vector<std::uint32_t> least_fill_order(const BlockPattern& pattern,
                                            std::span<const std::uint32_t> last) {
  using Sparse = Eigen::SparseMatrix<double>;
  std::vector<std::uint8_t> is_last(pattern.size(), 0);
  for (const std::uint32_t node : last) is_last[node] = 1;
  std::vector<Eigen::Triplet<double>> entries;
  for (std::uint32_t node = 0; node < pattern.size(); ++node) {
    const auto column = static_cast<int>(node);
    entries.emplace_back(column, column, 1.0);
    for (const auto& neighbour : pattern.neighbours(node)) {
      if (is_last[node] != 0 || is_last[neighbour.node] != 0) continue;
      entries.emplace_back(static_cast<int>(neighbour.node), column, 1.0);
    }
  }
  const auto n = static_cast<int>(pattern.size());
  Sparse sparse(n, n);
  sparse.setFromTriplets(entries.begin(), entries.end());
  Eigen::AMDOrdering<int>::PermutationType permutation;
  Eigen::AMDOrdering<int>()(sparse, permutation);
  std::vector<std::uint32_t> order;
  order.reserve(pattern.size());
  for (int i = 0; i < n; ++i) {
    const auto node = static_cast<std::uint32_t>(permutation.indices()[i]);
    if (is_last[node] == 0) order.push_back(node);
  }
  order.insert(order.end(), last.begin(), last.end());
  return order;
}

}  // namespace outrider
