#include "block_cholesky.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "dense.hpp"
#include "support/random_cases.hpp"

namespace outrider {
namespace {

/// A sum of random terms over random pairs, which is positive definite, as blocks and dense.
struct System {
  BlockMatrix sparse;
  testing::Dense dense;

  void add_node() {
    sparse.add_node();
    for (auto& row : dense) row.resize(row.size() + 3, 0.0);
    for (int k = 0; k < 3; ++k) dense.emplace_back(3 * sparse.size(), 0.0);
    for (std::size_t k = 0; k < 3; ++k) add(sparse.size() - 1, sparse.size() - 1, k, k, 0.1);
  }
  void add(std::size_t a, std::size_t b, std::size_t i, std::size_t j, double value) {
    dense[3 * a + i][3 * b + j] += value;
    const auto from = static_cast<std::uint32_t>(a), to = static_cast<std::uint32_t>(b);
    const auto row = static_cast<Eigen::Index>(i), column = static_cast<Eigen::Index>(j);
    if (a == b) sparse.diagonal(from)(row, column) += value;
    if (a < b) sparse.upper_block(sparse.pair(from, to))(row, column) += value;
  }
  /// v v^T for a random v on the nodes a and b.
  void join(std::size_t a, std::size_t b, Rng& rng) {
    std::array<double, 6> v{};
    for (double& value : v) value = rng.normal();
    const std::array<std::size_t, 2> ends = {a, b};
    for (std::size_t p = 0; p < 6; ++p) {
      for (std::size_t q = 0; q < 6; ++q) add(ends[p / 3], ends[q / 3], p % 3, q % 3, v[p] * v[q]);
    }
  }
};

double entry(const Eigen::Matrix3d& block, std::size_t row, std::size_t column) {
  return block(static_cast<Eigen::Index>(row), static_cast<Eigen::Index>(column));
}

System random_system(std::size_t nodes, Rng& rng) {
  System system;
  for (std::size_t i = 0; i < nodes; ++i) {
    system.add_node();
    for (std::size_t k = 0; i > 0 && k < 2; ++k) system.join(rng.below(i), i, rng);
  }
  return system;
}

std::vector<Eigen::Vector3d> random_vector(std::size_t nodes, Rng& rng) {
  std::vector<Eigen::Vector3d> b(nodes);
  for (Eigen::Vector3d& block : b) block = {rng.normal(), rng.normal(), rng.normal()};
  return b;
}

BlockCholesky factored(const System& system) {
  BlockCholesky factor;
  factor.begin(least_fill_order(system.sparse));
  factor.analyse_all(system.sparse);
  EXPECT_TRUE(factor.factor_all(system.sparse));
  return factor;
}

TEST(BlockCholesky, SolvesAndInvertsAsADenseSolverDoes) {
  Rng rng(1);
  for (int round = 0; round < testing::cases(20); ++round) {
    const std::size_t nodes = 1 + rng.below(20);
    const System system = random_system(nodes, rng);
    const BlockCholesky factor = factored(system);
    const testing::Dense inverse = testing::inverse(system.dense);
    const std::vector<Eigen::Vector3d> b = random_vector(nodes, rng);
    const std::vector<Eigen::Vector3d> x = factor.solve(b);
    const std::vector<Eigen::Matrix3d> diagonals = factor.inverse_diagonals();
    const auto some = static_cast<std::uint32_t>(rng.below(nodes));
    const std::vector<Eigen::Matrix3d> columns = factor.inverse_columns(some);
    const Eigen::Matrix3d own = factor.inverse_diagonal(some);
    for (std::size_t k = 0; k < 9; ++k)
      EXPECT_NEAR(entry(own, k / 3, k % 3), inverse[3 * some + k / 3][3 * some + k % 3], 1e-6);
    for (std::size_t row = 0; row < 3 * nodes; ++row) {
      double sum = 0.0;
      for (std::size_t k = 0; k < 3 * nodes; ++k)
        sum += inverse[row][k] * b[k / 3][static_cast<Eigen::Index>(k % 3)];
      EXPECT_NEAR(x[row / 3][static_cast<Eigen::Index>(row % 3)], sum, 1e-6 * (1.0 + std::abs(sum)));
      for (std::size_t k = 0; k < 3; ++k) {
        EXPECT_NEAR(entry(diagonals[row / 3], row % 3, k), inverse[row][3 * (row / 3) + k], 1e-6);
        EXPECT_NEAR(entry(columns[row / 3], row % 3, k), inverse[row][3 * some + k], 1e-6);
      }
    }
  }
}

TEST(BlockCholesky, AfterAChangeItHasTheVeryNumbersOfAFactorisationFromTheBeginning) {
  Rng rng(2);
  for (int round = 0; round < testing::cases(20); ++round) {
    System system = random_system(12, rng);
    std::vector<std::uint32_t> order = least_fill_order(system.sparse);
    BlockCholesky grown;
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
      BlockCholesky fresh;
      fresh.begin(order);
      fresh.analyse_all(system.sparse);
      ASSERT_TRUE(fresh.factor_all(system.sparse));
      const std::vector<Eigen::Vector3d> b = random_vector(system.sparse.size(), rng);
      EXPECT_EQ(grown.solve(b), fresh.solve(b));
      EXPECT_EQ(grown.fill(), fresh.fill());
    }
  }
}

TEST(BlockCholesky, ARefusedMatrixIsNotPositiveDefinite) {
  Rng rng(3);
  System system = random_system(6, rng);
  system.sparse.diagonal(4)(1, 1) -= 1e3;
  BlockCholesky factor;
  factor.begin(least_fill_order(system.sparse));
  factor.analyse_all(system.sparse);
  EXPECT_FALSE(factor.factor_all(system.sparse));
}

TEST(BlockCholesky, TheOrderHasEachNodeOnceAndTheLastOnesLast) {
  Rng rng(4);
  const System system = random_system(30, rng);
  const std::vector<std::uint32_t> last = {7, 3};
  std::vector<std::uint32_t> order = least_fill_order(system.sparse, last);
  EXPECT_TRUE(std::equal(last.begin(), last.end(), order.end() - 2));
  std::sort(order.begin(), order.end());
  for (std::uint32_t i = 0; i < 30; ++i) EXPECT_EQ(order[i], i);
}

}  // namespace
}  // namespace outrider
