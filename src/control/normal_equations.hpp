// Least squares in a few unknowns whose mean is 0, equation by equation.
#pragma once

#include <cstddef>

#include "outrider/motion/chassis.hpp"

namespace outrider {

class NormalEquations {
 public:
  explicit NormalEquations(std::size_t unknowns) : unknowns_(unknowns) {}

  /// row * x = right.
  void add(const WheelSpeeds4& row, double right);
  [[nodiscard]] std::size_t rows() const { return rows_; }

  struct Solution {
    WheelSpeeds4 x{};
    WheelSpeeds4 deviations{};  ///< standard deviations of x
  };
  /// The x of mean 0 with the least squares. What no row determines is 0, with an infinite deviation.
  [[nodiscard]] Solution solve_with_mean_zero() const;

 private:
  std::size_t unknowns_;
  std::size_t rows_ = 0;
  double product_[most_wheels][most_wheels] = {};  // A^T A
  WheelSpeeds4 right_{};                           // A^T b
  double square_ = 0.0;                            // b^T b
};

}  // namespace outrider
