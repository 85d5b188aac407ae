#include "algebra/symmetric_eigen.hpp"

#include <gtest/gtest.h>

#include "support/random_cases.hpp"

namespace outrider {
namespace {

template <int N>
void solves_the_equations_that_define_it() {
  Rng rng(1);
  for (int round = 0; round < testing::cases(50); ++round) {
    Eigen::Matrix<double, N, N> m;
    for (double& value : m.reshaped()) value = rng.normal();
    const Eigen::Matrix<double, N, N> a = m * m.transpose() + 0.1 * Eigen::Matrix<double, N, N>::Identity();
    const auto [values, vectors] = eigen_of_symmetric<N>(a);
    for (int k = 0; k < N; ++k) {
      EXPECT_LE(values[0], values[k]);
      EXPECT_LE((a * vectors.col(k) - values[k] * vectors.col(k)).norm(), 1e-9);
      EXPECT_NEAR(vectors.col(k).norm(), 1.0, 1e-12);
    }
    const Eigen::Matrix<double, N, N> root = inverse_square_root<N>(a);
    EXPECT_LE((root * a * root - Eigen::Matrix<double, N, N>::Identity()).norm(), 1e-9);
  }
}

TEST(SymmetricEigen, SolvesTheEquationsThatDefineIt) {
  solves_the_equations_that_define_it<2>();
  solves_the_equations_that_define_it<3>();
}

}  // namespace
}  // namespace outrider
