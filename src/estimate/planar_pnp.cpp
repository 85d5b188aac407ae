#include "outrider/estimate/planar_pnp.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "symmetric_solve.hpp"

namespace outrider {
namespace {

using Eigen::Matrix2d;
using Eigen::Matrix3d;
using Eigen::Vector2d;
using Eigen::Vector3d;
using Matrix86 = Eigen::Matrix<double, 8, 6>;
using Vector8 = Eigen::Matrix<double, 8, 1>;

constexpr int most_pnp_steps = 500;  // the worse solution of a tag seen at an angle converges slowly

constexpr double least_sharpness = 1e-6;  // px^12 / m^6; far below that of tags that a camera can read

using Rays = std::array<Vec2, 4>;  // points of the plane z = 1

/// Returns true if the corners are convex and in the order of a tag seen from its front.
bool is_seen_from_front(const std::array<Vec2, 4>& corners) {
  for (std::size_t i = 0; i < 4; ++i) {
    const Vec2 edge = corners[(i + 1) % 4] - corners[i];
    const Vec2 next = corners[(i + 2) % 4] - corners[(i + 1) % 4];
    if (!(cross(edge, next) < 0.0)) return false;
  }
  return true;
}

/// Returns the homography from the plane of the tag (m) to the rays, normalised to 1 in its last element.
/// Source: Heckbert, Fundamentals of texture mapping and image warping, 1989, section 2.2.3.
Matrix3d homography(double size_m, const Rays& p) {
  const Vec2 d1 = p[1] - p[2], d2 = p[3] - p[2], s = p[0] - p[1] + p[2] - p[3];
  const double g = cross(s, d2) / cross(d1, d2);
  const double h = cross(d1, s) / cross(d1, d2);
  const Vec2 along = p[1] - p[0] + g * p[1], up = p[3] - p[0] + h * p[3];
  Matrix3d from_unit_square;
  from_unit_square << along.x, up.x, p[0].x, along.y, up.y, p[0].y, g, h, 1.0;
  Matrix3d to_unit_square;
  to_unit_square << 1.0 / size_m, 0, 0.5, 0, -1.0 / size_m, 0.5, 0, 0, 1;
  const Matrix3d both = from_unit_square * to_unit_square;
  return both / both(2, 2);
}

/// Returns the two rotations with the Jacobian of the homography at the tag centre (Collins and Bartoli,
/// section 4).
std::array<Matrix3d, 2> rotations(const Matrix3d& h) {
  const Vector2d v(h(0, 2), h(1, 2));  // image of the tag centre
  const Matrix2d slope = h.topLeftCorner<2, 2>() - v * h.bottomLeftCorner<1, 2>();
  const double aside = v.norm();
  const Vector3d axis = aside > 0.0 ? Vector3d(-v.y() / aside, v.x() / aside, 0.0) : Vector3d::Zero();
  const Matrix3d turn = exp_so3(std::atan(aside) * axis);  // rotates the view axis to the tag centre
  const Matrix2d b = turn.topLeftCorner<2, 2>() - v * turn.bottomLeftCorner<1, 2>();
  Matrix2d adjugate;
  adjugate << b(1, 1), -b(0, 1), -b(1, 0), b(0, 0);
  const Matrix2d a = adjugate * slope / (b(0, 0) * b(1, 1) - b(0, 1) * b(1, 0));
  const Matrix2d aat = a * a.transpose();
  const double stretch = std::sqrt(0.5 * (aat.trace() + std::hypot(aat(0, 0) - aat(1, 1), 2.0 * aat(0, 1))));
  const Matrix2d r = a / stretch;
  double tilt_x = std::sqrt(std::max(0.0, 1.0 - r.col(0).squaredNorm()));
  double tilt_y = std::sqrt(std::max(0.0, 1.0 - r.col(1).squaredNorm()));
  if (r.col(0).dot(r.col(1)) > 0.0) tilt_y = -tilt_y;
  std::array<Matrix3d, 2> both;
  for (Matrix3d& rotation : both) {
    Matrix3d local;
    local.col(0) << r.col(0), tilt_x;
    local.col(1) << r.col(1), tilt_y;
    local.col(2) = skew(local.col(0)) * local.col(1);
    rotation = turn * local;
    tilt_x = -tilt_x;
    tilt_y = -tilt_y;
  }
  return both;
}

struct Estimate {
  Matrix3d rotation;
  Vector3d translation;
};

/// Returns the translation that fits the rays best, by linear least squares.
Vector3d translation_for(const Matrix3d& rotation, const std::array<Vec3, 4>& corners, const Rays& rays) {
  Matrix3d normal = Matrix3d::Zero();
  Vector3d right = Vector3d::Zero();
  for (std::size_t i = 0; i < 4; ++i) {
    const Vector3d p = rotation * to_eigen(corners[i]);
    Eigen::Matrix<double, 2, 3> rows;
    rows << 1, 0, -rays[i].x, 0, 1, -rays[i].y;
    normal += rows.transpose() * rows;
    right -= rows.transpose() * (rows * p);
  }
  return solve_symmetric(normal, right);
}

/// The reprojection errors in px and their derivatives by translation and rotation vector. linearise()
/// returns nothing if a corner is behind the camera.
struct Linearised {
  Vector8 error;
  Matrix86 jacobian;
};

std::optional<Linearised> linearise(const Estimate& pose, const Vector2d& focal,
                                    const std::array<Vec3, 4>& corners, const Rays& rays) {
  Linearised result;
  for (std::size_t i = 0; i < 4; ++i) {
    const Vector3d turned = pose.rotation * to_eigen(corners[i]);
    const Vector3d p = turned + pose.translation;
    if (!(p.z() > 0.0)) return std::nullopt;
    const Vector2d seen = p.head<2>() / p.z();
    Eigen::Matrix<double, 2, 3> by_point;
    by_point << 1, 0, -seen.x(), 0, 1, -seen.y();
    by_point = focal.asDiagonal() * by_point / p.z();
    const auto row = static_cast<Eigen::Index>(2 * i);
    result.error.segment<2>(row) = focal.cwiseProduct(seen - Vector2d(rays[i].x, rays[i].y));
    result.jacobian.block<2, 3>(row, 0) = by_point;
    result.jacobian.block<2, 3>(row, 3) = -by_point * skew(turned);
  }
  return result;
}

struct Minimum {
  Estimate pose;
  Linearised at;
};

/// Finds a local minimum of the reprojection error with Levenberg-Marquardt.
std::optional<Minimum> refine(Estimate pose, const Vector2d& focal, const std::array<Vec3, 4>& corners,
                              const Rays& rays) {
  auto at = linearise(pose, focal, corners, rays);
  if (!at) return std::nullopt;
  double damping = 1e-4;
  for (int step = 0; step < most_pnp_steps && damping < 1e12; ++step) {
    Matrix6d normal = at->jacobian.transpose() * at->jacobian;
    normal.diagonal() *= 1.0 + damping;
    const Vector6d move = solve_symmetric(normal, -at->jacobian.transpose() * at->error);
    const Estimate moved{exp_so3(move.tail<3>()) * pose.rotation, pose.translation + move.head<3>()};
    auto there = linearise(moved, focal, corners, rays);
    if (!there || !(there->error.squaredNorm() <= at->error.squaredNorm())) {
      damping *= 10.0;
      continue;
    }
    damping *= 0.1;
    pose = moved;
    at = there;
    if (move.squaredNorm() < 1e-16) break;
  }
  return Minimum{pose, *at};
}

TagPose with_covariance(const Minimum& minimum, const PlanarPnpOptions& options) {
  const double squares = minimum.at.error.squaredNorm();
  const double weight = options.corner_sigma_weight;
  const double variance =
      (weight * options.corner_sigma_px * options.corner_sigma_px + squares) / (weight + 2.0);
  const Matrix6d normal = minimum.at.jacobian.transpose() * minimum.at.jacobian;
  TagPose pose{{to_vec3(minimum.pose.translation), to_rotation(minimum.pose.rotation)},
               std::sqrt(squares / 4.0)};
  const Matrix6d covariance = variance * inverse_of_symmetric(normal);
  pose.covariance = 0.5 * (covariance + covariance.transpose());
  return pose;
}

/// Sets the probability of each pose: the integral of the likelihood of the corners around its minimum, where
/// the variance of a corner has the prior of the options (Gelman et al., Bayesian Data Analysis, section 4.1:
/// normal approximation).
void set_probabilities(std::vector<TagPose>& poses, const std::vector<Minimum>& minima,
                       const PlanarPnpOptions& options) {
  const double weight = options.corner_sigma_weight;
  const double prior = weight * options.corner_sigma_px * options.corner_sigma_px;
  std::vector<double> logs;
  for (const Minimum& minimum : minima) {
    const Matrix6d normal = minimum.at.jacobian.transpose() * minimum.at.jacobian;
    const double sharpness = determinant_of_symmetric(normal);  // not positive: the pose is not determined
    logs.push_back(-0.5 * (weight + 2.0) * std::log(prior + minimum.at.error.squaredNorm()) -
                   0.5 * std::log(std::max(sharpness, least_sharpness)));
  }
  const double most = logs.empty() ? 0.0 : *std::ranges::max_element(logs);
  double sum = 0.0;
  for (const double log : logs) sum += std::exp(log - most);
  for (std::size_t i = 0; i < poses.size(); ++i) poses[i].probability = std::exp(logs[i] - most) / sum;
}

}  // namespace

std::vector<Option> describe(PlanarPnpOptions& options) {
  return {{"corner_sigma", "px", 0.01, 100, "expected error of a corner along each axis",
           &options.corner_sigma_px},
          {"corner_sigma_weight", "", 0.1, 1e6, "degrees of freedom that this expectation is worth",
           &options.corner_sigma_weight}};
}

std::vector<TagPose> planar_pnp(const Camera& camera, double size_m, const std::array<Vec2, 4>& corners_px,
                                const PlanarPnpOptions& options) {
  if (!is_seen_from_front(corners_px)) return {};
  const std::array<Vec3, 4> corners = tag_corners(size_m);
  const Vector2d focal(camera.fx, camera.fy);
  Rays rays;
  std::ranges::transform(corners_px, rays.begin(), [&](Vec2 p) { return ray_through(camera, p); });

  std::vector<Minimum> minima;
  for (const Matrix3d& rotation : rotations(homography(size_m, rays))) {
    const auto minimum = refine({rotation, translation_for(rotation, corners, rays)}, focal, corners, rays);
    if (!minimum || !minimum->at.error.allFinite()) continue;
    const bool again = std::ranges::any_of(minima, [&](const Minimum& other) {
      return (other.pose.rotation - minimum->pose.rotation).norm() < 1e-4;
    });
    if (!again) minima.push_back(*minimum);
  }
  std::vector<TagPose> poses;
  for (const Minimum& minimum : minima) poses.push_back(with_covariance(minimum, options));
  set_probabilities(poses, minima, options);
  std::ranges::stable_sort(poses, {}, &TagPose::error_px);
  return poses;
}

}  // namespace outrider
