// Linear least squares in the gains of a few wheels, equation by equation.
#pragma once

#include <Eigen/Core>
#include <cstddef>

#include "outrider/motion/chassis.hpp"

namespace outrider {

class NormalEquations {
 public:
  static constexpr int most_unknowns = static_cast<int>(most_wheels);
  using Vector = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, most_unknowns, 1>;
  using Matrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, most_unknowns, most_unknowns>;

  explicit NormalEquations(std::size_t unknowns);

  /// Adds the equation row . x = right.
  void add(const Vector& row, double right);
  [[nodiscard]] std::size_t rows() const { return rows_; }

  struct Solution {
    Vector x;
    Vector deviations;  ///< standard deviations of x
  };
  /// Returns the least-squares x among those of mean 0. A component that no row determines is 0 and has an
  /// infinite deviation.
  [[nodiscard]] Solution solve_with_mean_zero() const;

 private:
  std::size_t rows_ = 0;
  Matrix product_;       ///< A^T A
  Vector right_;         ///< A^T b
  double square_ = 0.0;  ///< b^T b
};

}  // namespace outrider
