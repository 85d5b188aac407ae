// Solves the symmetric equations of least squares by Eigen's LDLT, which takes seconds to compile at each
// size, so one source file has it.
#pragma once

#include "rigid_motion.hpp"

namespace outrider {

/// Returns x with A x = b.
Eigen::Vector3d solve_symmetric(const Eigen::Matrix3d& a, const Eigen::Vector3d& b);
Vector6d solve_symmetric(const Matrix6d& a, const Vector6d& b);

Eigen::Matrix3d inverse_of_symmetric(const Eigen::Matrix3d& a);
Matrix6d inverse_of_symmetric(const Matrix6d& a);

double determinant_of_symmetric(const Matrix6d& a);

}  // namespace outrider
