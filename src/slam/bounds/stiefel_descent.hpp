// A Riemannian trust region for the quadratic form of a pose graph whose rotations have orthonormal columns.
#pragma once

#include "bounds/quadratic_form.hpp"
#include "outrider/core/budget.hpp"

namespace outrider {

/// Descends on one form from any X; see staircase.hpp for the method.
template <class Pose>
class StiefelDescent {
 public:
  /// The graph must outlive it.
  StiefelDescent(const PoseGraphOf<Pose>& graph, QuadraticForm<Pose> form);

  [[nodiscard]] const QuadraticForm<Pose>& form() const { return form_; }
  [[nodiscard]] double cost(const Eigen::MatrixXd& x) const;
  /// Replaces the rotations by the nearest with orthonormal columns, and the positions by those that cost
  /// least for them: so nodes that turn take the others along.
  void retract(Eigen::MatrixXd& x) const;
  /// Descends until a step lowers the cost by less than `tolerance` of it; spends an expansion of the meter
  /// and one of `steps` for each step, and returns false if there is none left.
  bool descend(Eigen::MatrixXd& x, double tolerance, std::int64_t& steps, BudgetMeter& meter);

 private:
  struct Point;
  struct Step;
  [[nodiscard]] Eigen::MatrixXd project(const Eigen::MatrixXd& x, Eigen::MatrixXd v) const;
  [[nodiscard]] Point point_at(const Eigen::MatrixXd& x) const;
  void precondition_at(const Point& at);
  [[nodiscard]] Eigen::MatrixXd hessian(const Point& at, const Eigen::MatrixXd& v) const;
  [[nodiscard]] Step truncated_newton(const Point& at, double radius) const;

  const PoseGraphOf<Pose>& graph_;
  QuadraticForm<Pose> form_;
  BlockCholesky<1> positions_;  ///< of the part of the form that is quadratic in positions
  double least_shift_;
  ShiftedMatrix<Pose> preconditioner_;  ///< the Hessian where the descent stands, made definite
  double shift_;
};

}  // namespace outrider
