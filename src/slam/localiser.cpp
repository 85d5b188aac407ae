#include "outrider/slam/localiser.hpp"

#include <algorithm>
#include <limits>

#include "graph_edges.hpp"
#include "outrider/core/units.hpp"
#include "outrider/slam/joint_compatibility.hpp"

namespace outrider {
namespace {

/// What a sighting of a landmark says about the pose.
struct Innovation {
  std::array<double, 2> difference{};
  Matrix<2, 3> by_pose;
  Matrix2 weight;  ///< inverse of the difference's covariance
  double squared_distance = std::numeric_limits<double>::infinity();
};

Innovation innovation(const LandmarkSighting& sighting, const LandmarkEstimate& landmark, const Pose2& pose,
                      const Matrix3& covariance) {
  const GraphEdge edge{EdgeKind::point, 0, 1, {sighting.position, 0.0}, {}};
  const LinearEdge linear = linearised(edge, pose, {landmark.position, 0.0});
  Innovation result;
  result.difference = {-linear.residual[0], -linear.residual[1]};
  for (std::size_t i = 0; i < 2; ++i) {
    for (std::size_t j = 0; j < 3; ++j) result.by_pose(i, j) = linear.by_from(i, j);
  }
  const Matrix2 turn = rotation2(-pose.heading_rad);
  Matrix2 sum = result.by_pose * covariance * transposed(result.by_pose) + sighting.covariance +
                turn * landmark.covariance * transposed(turn);
  sum(1, 0) = sum(0, 1);
  const auto weight = inverse_of_positive(sum);
  if (!weight) return result;
  result.weight = *weight;
  result.squared_distance = quadratic_form(*weight, result.difference);
  return result;
}

}  // namespace

Outcome<Localiser> Localiser::begin(LandmarkMap map, const LocaliserOptions& options, const Pose2& start,
                                    const Matrix3& covariance) {
  if (map.empty()) return bad_input("the map has no landmarks; it takes one at least", "map");
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
  const Matrix<3, 2> gain = covariance_ * transposed(best.by_pose) * best.weight;
  Block3 step{};
  for (std::size_t i = 0; i < 3; ++i) {
    step[i] = gain(i, 0) * best.difference[0] + gain(i, 1) * best.difference[1];
  }
  pose_ = {pose_.position + Vec2{step[0], step[1]}, wrap_angle(pose_.heading_rad + step[2])};
  const Matrix3 smaller = covariance_ - gain * best.by_pose * covariance_;
  covariance_ = 0.5 * (smaller + transposed(smaller));
  return true;
}

Outcome<StepOutcome> Localiser::advance(const LogStep& step) {
  if (auto ok = check(step); !ok) return pass_on(ok);
  const Vec2 arm = rotated(pose_.heading_rad, step.odometry.position);
  Matrix3 by_pose = diagonal<3>({1.0, 1.0, 1.0});
  by_pose(0, 2) = -arm.y;
  by_pose(1, 2) = arm.x;
  const Matrix2 turn = rotation2(pose_.heading_rad);
  const Matrix3 by_motion = {{turn(0, 0), turn(0, 1), 0.0, turn(1, 0), turn(1, 1), 0.0, 0.0, 0.0, 1.0}};
  covariance_ =
      by_pose * covariance_ * transposed(by_pose) + by_motion * step.covariance * transposed(by_motion);
  pose_ = composed(pose_, step.odometry);
  StepOutcome outcome;
  for (const LandmarkSighting& sighting : step.sightings)
    ++(correct(sighting) ? outcome.used : outcome.refused);
  if (outcome.used > 0) misfits_ = 0;
  if (outcome.used == 0 && outcome.refused > 0) ++misfits_;
  outcome.lost = misfits_ >= options_.lost_after;
  return outcome;
}

}  // namespace outrider
