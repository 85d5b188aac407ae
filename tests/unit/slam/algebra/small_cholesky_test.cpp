#include "algebra/small_cholesky.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "dense.hpp"
#include "support/random_cases.hpp"

namespace outrider {
namespace {

/// Returns M M^T plus a little on the diagonal, for a random M.
template <int N>
Eigen::Matrix<double, N, N> random_positive_matrix(Rng& rng) {
  Eigen::Matrix<double, N, N> m;
  for (double& value : m.reshaped()) value = rng.normal();
  return m * m.transpose() + 0.1 * Eigen::Matrix<double, N, N>::Identity();
}

template <int N>
void solves_and_inverts_as_a_dense_solver_does() {
  Rng rng(1);
  for (int round = 0; round < testing::cases(50); ++round) {
    const Eigen::Matrix<double, N, N> a = random_positive_matrix<N>(rng);
    testing::Dense dense = testing::zeros(N, N);
    for (int i = 0; i < N; ++i) {
      for (int j = 0; j < N; ++j) dense[static_cast<std::size_t>(i)][static_cast<std::size_t>(j)] = a(i, j);
    }
    const testing::Dense expected = testing::inverse(dense);
    const SmallCholesky<N> factor(a);
    ASSERT_TRUE(factor.is_positive());
    const Eigen::Matrix<double, N, N> inverse = factor.inverse(), triangle = factor.inverse_of_triangle();
    for (int j = 0; j < N; ++j) {
      const Eigen::Matrix<double, N, 1> column = factor.solve(Eigen::Matrix<double, N, 1>::Unit(j));
      for (int i = 0; i < N; ++i) {
        const double right = expected[static_cast<std::size_t>(i)][static_cast<std::size_t>(j)];
        EXPECT_NEAR(inverse(i, j), right, 1e-9);
        EXPECT_NEAR(column[i], right, 1e-9);
        EXPECT_NEAR(triangle.col(i).dot(triangle.col(j)), right, 1e-9);
      }
    }
  }
}

TEST(SmallCholesky, SolvesAndInvertsAsADenseSolverDoes) {
  solves_and_inverts_as_a_dense_solver_does<1>();
  solves_and_inverts_as_a_dense_solver_does<2>();
  solves_and_inverts_as_a_dense_solver_does<3>();
  solves_and_inverts_as_a_dense_solver_does<6>();
}

TEST(SmallCholesky, RefusesWhatIsNotPositiveDefiniteOrNotFinite) {
  const auto is_positive = [](double a, double b, double c) {
    Eigen::Matrix2d matrix;
    matrix << a, b, b, c;
    return SmallCholesky<2>(matrix).is_positive();
  };
  constexpr double infinity = std::numeric_limits<double>::infinity();
  EXPECT_TRUE(is_positive(2.0, 1.0, 1.0));
  EXPECT_FALSE(is_positive(1.0, 1.0, 1.0));
  EXPECT_FALSE(is_positive(1.0, 2.0, 1.0));
  EXPECT_FALSE(is_positive(-1.0, 0.0, 1.0));
  EXPECT_FALSE(is_positive(infinity, 0.0, 1.0));
  EXPECT_FALSE(is_positive(1.0, std::numeric_limits<double>::quiet_NaN(), 1.0));
}

}  // namespace
}  // namespace outrider
