#include "algebra/block_cholesky.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "dense.hpp"
#include "support/random_cases.hpp"

namespace outrider {
namespace {

/// A sum of random terms over random pairs, which is positive definite, as blocks and dense.
template <int N = 3>
struct System {
  static constexpr std::size_t n = N;
  BlockMatrix<N> sparse;
  testing::Dense dense;

  void add_node() {
    sparse.add_node();
    for (auto& row : dense) row.resize(row.size() + n, 0.0);
    for (int k = 0; k < N; ++k) dense.emplace_back(n * sparse.size(), 0.0);
    for (std::size_t k = 0; k < n; ++k) add(sparse.size() - 1, sparse.size() - 1, k, k, 0.1);
  }
  void add(std::size_t a, std::size_t b, std::size_t i, std::size_t j, double value) {
    dense[n * a + i][n * b + j] += value;
    const auto from = static_cast<std::uint32_t>(a), to = static_cast<std::uint32_t>(b);
    const auto row = static_cast<Eigen::Index>(i), column = static_cast<Eigen::Index>(j);
    if (a == b) sparse.diagonal(from)(row, column) += value;
    if (a < b) sparse.upper_block(sparse.pair(from, to))(row, column) += value;
  }
  /// v v^T for a random v on the nodes a and b.
  void join(std::size_t a, std::size_t b, Rng& rng) {
    std::array<double, 2 * n> v{};
    for (double& value : v) value = rng.normal();
    const std::array<std::size_t, 2> ends = {a, b};
    for (std::size_t p = 0; p < 2 * n; ++p) {
      for (std::size_t q = 0; q < 2 * n; ++q) add(ends[p / n], ends[q / n], p % n, q % n, v[p] * v[q]);
    }
  }
};

template <class Block>
double entry(const Block& block, std::size_t row, std::size_t column) {
  return block(static_cast<Eigen::Index>(row), static_cast<Eigen::Index>(column));
}

template <int N = 3>
System<N> random_system(std::size_t nodes, Rng& rng) {
  System<N> system;
  for (std::size_t i = 0; i < nodes; ++i) {
    system.add_node();
    for (std::size_t k = 0; i > 0 && k < 2; ++k) system.join(rng.below(i), i, rng);
  }
  return system;
}

template <int N = 3>
std::vector<Eigen::Matrix<double, N, 1>> random_vector(std::size_t nodes, Rng& rng) {
  std::vector<Eigen::Matrix<double, N, 1>> b(nodes);
  for (auto& block : b) {
    for (double& value : block.reshaped()) value = rng.normal();
  }
  return b;
}

template <int N>
BlockCholesky<N> factored(const System<N>& system) {
  BlockCholesky<N> factor;
  factor.begin(least_fill_order(system.sparse));
  factor.analyse_all(system.sparse);
  EXPECT_TRUE(factor.factor_all(system.sparse));
  return factor;
}

template <int N>
void solves_as_a_dense_solver_does() {
  Rng rng(1);
  constexpr std::size_t n = N;
  for (int round = 0; round < testing::cases(20); ++round) {
    const std::size_t nodes = 1 + rng.below(20);
    const System<N> system = random_system<N>(nodes, rng);
    const testing::Dense inverse = testing::inverse(system.dense);
    const auto b = random_vector<N>(nodes, rng);
    const auto x = factored(system).solve(b);
    for (std::size_t row = 0; row < n * nodes; ++row) {
      double sum = 0.0;
      for (std::size_t k = 0; k < n * nodes; ++k)
        sum += inverse[row][k] * b[k / n][static_cast<Eigen::Index>(k % n)];
      EXPECT_NEAR(x[row / n][static_cast<Eigen::Index>(row % n)], sum, 1e-6 * (1.0 + std::abs(sum)));
    }
  }
}

TEST(BlockCholesky, SolvesAsADenseSolverDoes) {
  solves_as_a_dense_solver_does<1>();
  solves_as_a_dense_solver_does<2>();
  solves_as_a_dense_solver_does<3>();
  solves_as_a_dense_solver_does<4>();
  solves_as_a_dense_solver_does<6>();
}

template <int N>
void inverts_as_a_dense_solver_does() {
  Rng rng(1);
  constexpr std::size_t n = N;
  for (int round = 0; round < testing::cases(20); ++round) {
    const std::size_t nodes = 1 + rng.below(20);
    const System<N> system = random_system<N>(nodes, rng);
    const BlockCholesky<N> factor = factored(system);
    const testing::Dense inverse = testing::inverse(system.dense);
    std::vector<std::array<std::uint32_t, 2>> pairs;
    for (std::uint32_t a = 0; a < nodes; ++a) {
      for (const auto& neighbour : system.sparse.neighbours(a)) pairs.push_back({a, neighbour.node});
    }
    const auto [diagonals, of_pairs] = factor.inverse_blocks(pairs);
    for (std::size_t i = 0; i < pairs.size(); ++i) {
      for (std::size_t k = 0; k < n * n; ++k)
        EXPECT_NEAR(entry(of_pairs[i], k / n, k % n),
                    inverse[n * pairs[i][0] + k / n][n * pairs[i][1] + k % n], 1e-6);
    }
    const auto some = static_cast<std::uint32_t>(rng.below(nodes));
    const auto columns = factor.inverse_columns(some);
    const auto own = factor.inverse_diagonal(some);
    for (std::size_t k = 0; k < n * n; ++k)
      EXPECT_NEAR(entry(own, k / n, k % n), inverse[n * some + k / n][n * some + k % n], 1e-6);
    for (std::size_t row = 0; row < n * nodes; ++row) {
      for (std::size_t k = 0; k < n; ++k) {
        EXPECT_NEAR(entry(diagonals[row / n], row % n, k), inverse[row][n * (row / n) + k], 1e-6);
        EXPECT_NEAR(entry(columns[row / n], row % n, k), inverse[row][n * some + k], 1e-6);
      }
    }
  }
}

TEST(BlockCholesky, InvertsAsADenseSolverDoes) {
  inverts_as_a_dense_solver_does<3>();
  inverts_as_a_dense_solver_does<6>();
}

TEST(BlockCholesky, AfterAChangeItHasTheVeryNumbersOfAFactorisationFromTheBeginning) {
  Rng rng(2);
  for (int round = 0; round < testing::cases(20); ++round) {
    System<> system = random_system<>(12, rng);
    std::vector<std::uint32_t> order = least_fill_order(system.sparse);
    BlockCholesky<3> grown;
    grown.begin(order);
    grown.analyse_all(system.sparse);
    ASSERT_TRUE(grown.factor_all(system.sparse));
    for (int step = 0; step < 10; ++step) {
      const std::size_t node = system.sparse.size();
      system.add_node();
      order.push_back(static_cast<std::uint32_t>(node));
      grown.append(order.back());
      std::vector<std::uint32_t> changed = {order.back()};
      for (int k = 0; k < 2; ++k) {
        const std::size_t other = rng.below(node);
        system.join(other, node, rng);
        changed.push_back(static_cast<std::uint32_t>(other));
      }
      const std::vector<std::uint32_t> places = grown.analyse(system.sparse, changed);
      EXPECT_TRUE(std::is_sorted(places.begin(), places.end()));
      ASSERT_TRUE(grown.factor(system.sparse, places));
      BlockCholesky<3> fresh;
      fresh.begin(order);
      fresh.analyse_all(system.sparse);
      ASSERT_TRUE(fresh.factor_all(system.sparse));
      const std::vector<Eigen::Vector3d> b = random_vector<>(system.sparse.size(), rng);
      EXPECT_EQ(grown.solve(b), fresh.solve(b));
      EXPECT_EQ(grown.fill(), fresh.fill());
    }
  }
}

TEST(BlockCholesky, ARefusedMatrixIsNotPositiveDefinite) {
  Rng rng(3);
  System<> system = random_system<>(6, rng);
  system.sparse.diagonal(4)(1, 1) -= 1e3;
  BlockCholesky<3> factor;
  factor.begin(least_fill_order(system.sparse));
  factor.analyse_all(system.sparse);
  EXPECT_FALSE(factor.factor_all(system.sparse));
}

TEST(BlockCholesky, TheOrderHasEachNodeOnceAndTheLastOnesLast) {
  Rng rng(4);
  const System<> system = random_system<>(30, rng);
  const std::vector<std::uint32_t> last = {7, 3};
  std::vector<std::uint32_t> order = least_fill_order(system.sparse, last);
  EXPECT_TRUE(std::equal(last.begin(), last.end(), order.end() - 2));
  std::sort(order.begin(), order.end());
  for (std::uint32_t i = 0; i < 30; ++i) EXPECT_EQ(order[i], i);
}

}  // namespace
}  // namespace outrider
