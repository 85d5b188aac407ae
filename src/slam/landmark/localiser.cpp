#include "outrider/slam/landmark/localiser.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <limits>

#include "algebra/small_cholesky.hpp"
#include "covariances.hpp"
#include "graph/graph_edges.hpp"
#include "outrider/core/units.hpp"
#include "outrider/slam/landmark/joint_compatibility.hpp"

namespace outrider {
namespace {

/// The innovation of a sighting of a landmark, and its Jacobian by the pose.
struct Innovation {
  Eigen::Vector2d difference = Eigen::Vector2d::Zero();
  Eigen::Matrix<double, 2, 3> by_pose = Eigen::Matrix<double, 2, 3>::Zero();
  Eigen::Matrix2d weight = Eigen::Matrix2d::Zero();  ///< inverse of the difference's covariance
  double squared_distance = std::numeric_limits<double>::infinity();
};

Innovation innovation(const LandmarkSighting& sighting, const LandmarkEstimate& landmark, const Pose2& pose,
                      const Eigen::Matrix3d& covariance) {
  const GraphEdge edge{EdgeKind::point, 0, 1, {sighting.position, 0.0}};
  const LinearEdge linear = linearise(edge, pose, {landmark.position, 0.0});
  Innovation result;
  result.difference = -linear.residual.head<2>();
  result.by_pose = linear.by_from.topRows<2>();
  const Eigen::Matrix2d turn = Eigen::Rotation2Dd(-pose.heading_rad).toRotationMatrix();
  Eigen::Matrix2d sum = result.by_pose * covariance * result.by_pose.transpose() + sighting.covariance +
                        turn * landmark.covariance * turn.transpose();
  sum(1, 0) = sum(0, 1);
  const SmallCholesky<2> factor(sum);
  if (!factor.is_positive()) return result;
  result.weight = factor.inverse();
  result.squared_distance = result.difference.dot(result.weight * result.difference);
  return result;
}

}  // namespace

Outcome<Localiser> Localiser::begin(LandmarkMap map, const LocaliserOptions& options, const Pose2& start,
                                    const Eigen::Matrix3d& covariance) {
  if (map.empty()) return bad_input("the map has no landmarks; expected at least one", "map");
  if (auto ok = check(LogStep{0.0, start, covariance, {}}); !ok) {
    return bad_input("the start is not finite, or its covariance not positive definite; correct it", "start");
  }
  return Localiser(std::move(map), options, start, covariance);
}

bool Localiser::correct(const LandmarkSighting& sighting) {
  Innovation best;
  for (const LandmarkEstimate& landmark : map_) {
    if (sighting.id && *sighting.id != landmark.id) continue;
    const Innovation found = innovation(sighting, landmark, pose_, covariance_);
    if (found.squared_distance < best.squared_distance) best = found;
  }
  if (!(best.squared_distance <= squared_gate(options_.gate, 2))) return false;
  const Eigen::Matrix<double, 3, 2> gain = covariance_ * best.by_pose.transpose() * best.weight;
  const Eigen::Vector3d step = gain * best.difference;
  pose_ = {pose_.position + Vec2{step[0], step[1]}, wrap_angle(pose_.heading_rad + step[2])};
  const Eigen::Matrix3d smaller = covariance_ - gain * best.by_pose * covariance_;
  covariance_ = 0.5 * (smaller + smaller.transpose());
  return true;
}

Outcome<StepOutcome> Localiser::advance(const LogStep& step) {
  if (auto ok = check(step); !ok) return pass_on(ok);
  const Vec2 arm = rotated(pose_.heading_rad, step.odometry.position);
  const Eigen::Matrix3d by_pose = lever_of(arm);
  const Eigen::Matrix3d by_motion = rotation_by(pose_.heading_rad);
  covariance_ =
      by_pose * covariance_ * by_pose.transpose() + by_motion * step.covariance * by_motion.transpose();
  pose_ = wrap_heading(compose(pose_, step.odometry));
  StepOutcome outcome;
  for (const LandmarkSighting& sighting : step.sightings)
    ++(correct(sighting) ? outcome.used : outcome.refused);
  if (outcome.used > 0) misfits_ = 0;
  if (outcome.used == 0 && outcome.refused > 0) ++misfits_;
  outcome.lost = misfits_ >= options_.lost_after;
  return outcome;
}

}  // namespace outrider
