#include "outrider/jobs/drive/localisation/dead_reckoning.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "outrider/core/units.hpp"

namespace outrider {
namespace {

constexpr double memory_s = 1.0;            ///< for which a drift lasts
constexpr double wander_variance = 1e-5;    ///< of an error of the motion, per second of motion
constexpr double innovation_memory = 10.0;  ///< number of images over which innovations are averaged
constexpr double plausible_ratio = 2.0;  ///< of the innovations to what they should be: 5 standard deviations
constexpr double plausible_squared =
    6.25;                             ///< of one innovation: 90 % quantile of chi-squared with 3 degrees
constexpr double at_rest_mps = 1e-3;  ///< slower is at rest
constexpr double at_rest_radps = 1e-3;

constexpr Eigen::Index pose_size = 3;
constexpr Eigen::Index state_size = pose_size + motion_error_count;
using StateCovariance = Eigen::Matrix<double, state_size, state_size>;

StateCovariance joint_covariance(const Reckoning& reckoning) {
  StateCovariance joint;
  joint.topLeftCorner<pose_size, pose_size>() = reckoning.belief.covariance;
  joint.topRightCorner<pose_size, motion_error_count>() = reckoning.errors.with_pose;
  joint.bottomLeftCorner<motion_error_count, pose_size>() = reckoning.errors.with_pose.transpose();
  joint.bottomRightCorner<motion_error_count, motion_error_count>() = reckoning.errors.covariance;
  return joint;
}

void set_joint_covariance(Reckoning& reckoning, const StateCovariance& joint) {
  reckoning.belief.covariance = joint.topLeftCorner<pose_size, pose_size>();
  reckoning.errors.with_pose = joint.topRightCorner<pose_size, motion_error_count>();
  reckoning.errors.covariance = joint.bottomRightCorner<motion_error_count, motion_error_count>();
}

/// Covariance that drift adds in a step.
Eigen::Matrix3d drift_covariance(Vec2 step, double turn_rad, double duration_s,
                                 const ReckoningOptions& options) {
  const double lasts = memory_s / duration_s;
  const double relative = options.drift * options.drift;
  const double along = relative * squared_norm(step) * lasts;
  const double turning =
      (relative * turn_rad * turn_rad + options.drift_radpm * options.drift_radpm * squared_norm(step)) *
      lasts;
  return Eigen::Vector3d(along, along, turning).asDiagonal();
}

/// P -> F P F^T + Q for the pose and the errors of the motion. The robot was commanded `commanded` and moved
/// by `step`, from a pose with the heading `heading_rad`.
void propagate(Reckoning& reckoning, Vec2 step, double turn_rad, const Twist2& commanded, double heading_rad,
               double duration_s, const ReckoningOptions& options, const Chassis& chassis) {
  StateCovariance by_state = StateCovariance::Identity();
  by_state(0, 2) = -step.y;
  by_state(1, 2) = step.x;
  const double middle_rad = heading_rad + 0.5 * turn_rad;
  Eigen::Matrix3d to_world = Eigen::Matrix3d::Identity();
  to_world.topLeftCorner<2, 2>() << std::cos(middle_rad), -std::sin(middle_rad), std::sin(middle_rad),
      std::cos(middle_rad);
  by_state.topRightCorner<pose_size, motion_error_count>() =
      duration_s * to_world * executed_by_errors(chassis, reckoning.errors.mean, commanded);
  StateCovariance joint = by_state * joint_covariance(reckoning) * by_state.transpose();
  joint.topLeftCorner<pose_size, pose_size>() += drift_covariance(step, turn_rad, duration_s, options);
  if (speed_of(commanded) > at_rest_mps || std::abs(commanded.turn_radps) > at_rest_radps) {
    for (Eigen::Index i = pose_size; i < state_size; ++i) {
      if (joint(i, i) > 0.0) joint(i, i) += wander_variance * duration_s;
    }
  }
  set_joint_covariance(reckoning, joint);
}

/// With the same target all the time.
void advance_steadily(Reckoning& reckoning, double until_s, const ReckoningOptions& options,
                      const Chassis& chassis) {
  const double duration_s = until_s - reckoning.time_s;
  if (duration_s <= 0.0) return;
  const double left = options.lag_s > 0.0 ? std::exp(-duration_s / options.lag_s) : 0.0;
  const Twist2 off = reckoning.twist + -1.0 * reckoning.target;
  const Twist2 commanded = reckoning.target + (options.lag_s * (1.0 - left) / duration_s) * off;
  const Twist2 mean = executed(chassis, reckoning.errors.mean, commanded);
  Pose2& pose = reckoning.belief.world_T_robot;
  const Pose2 before = pose;
  pose = moved(pose, mean, duration_s);
  pose.heading_rad = wrap_angle(pose.heading_rad);
  propagate(reckoning, pose.position - before.position, mean.turn_radps * duration_s, commanded,
            before.heading_rad, duration_s, options, chassis);
  reckoning.twist = reckoning.target + left * off;
  reckoning.time_s = until_s;
}

}  // namespace

std::vector<Option> describe(ReckoningOptions& options) {
  return {
      {"delay", "s", 0.0, 5.0, "between a command and its effect", &options.delay_s},
      {"lag", "s", 0.0, 5.0, "time constant with which the robot follows a command", &options.lag_s},
      {"drift", "", 0.0, 1.0, "standard deviation of the speed and of the turn rate, relative",
       &options.drift},
      {"drift_per_m", "rad/m", 0.0, 10.0, "standard deviation of the turn rate, per speed",
       &options.drift_radpm},
      {"wheel_sigma", "", 0.0, 1.0, "standard deviation of the error of a wheel at the start, relative",
       &options.wheel_sigma},
      {"slip_sigma", "", 0.0, 1.0, "the same of the fraction of sideways motion that is lost",
       &options.slip_sigma},
      {"lost", "m", 0.01, 100.0, "a larger standard deviation of the position is lost", &options.lost_m},
      {"lost_angle", "deg", 0.1, 180.0, "a larger standard deviation of the heading is lost",
       &options.lost_rad},
  };
}

void advance(Reckoning& reckoning, double until_s, const ReckoningOptions& options, const Chassis& chassis) {
  while (!reckoning.sent.empty() && reckoning.sent.front().at_s + options.delay_s <= until_s) {
    advance_steadily(reckoning, reckoning.sent.front().at_s + options.delay_s, options, chassis);
    reckoning.target = reckoning.sent.front().twist;
    reckoning.sent.pop_front();
  }
  advance_steadily(reckoning, until_s, options, chassis);
}

void correct(Reckoning& reckoning, const PoseBelief& measured) {
  StateCovariance joint = joint_covariance(reckoning);
  Pose2& pose = reckoning.belief.world_T_robot;
  const Eigen::Vector3d innovation(measured.world_T_robot.position.x - pose.position.x,
                                   measured.world_T_robot.position.y - pose.position.y,
                                   wrap_angle(measured.world_T_robot.heading_rad - pose.heading_rad));
  Eigen::Matrix3d expected = joint.topLeftCorner<pose_size, pose_size>() + measured.covariance;
  const double squared = innovation.dot(expected.ldlt().solve(innovation));
  if (squared > plausible_squared) {
    const double excess = squared / plausible_squared;
    expected += (excess - 1.0) * measured.covariance;
  }
  double& ratio = reckoning.innovation_ratio;
  ratio += (squared / static_cast<double>(pose_size) - ratio) / innovation_memory;
  if (ratio > plausible_ratio) {
    joint *= ratio;
    expected *= ratio;
  }
  const Eigen::Matrix<double, state_size, pose_size> with_pose = joint.leftCols<pose_size>();
  const Eigen::Matrix<double, state_size, pose_size> gain =
      expected.ldlt().solve(with_pose.transpose()).transpose();
  const Eigen::Matrix<double, state_size, 1> change = gain * innovation;
  joint -= gain * with_pose.transpose();
  set_joint_covariance(reckoning, 0.5 * (joint + joint.transpose()));
  pose.position = pose.position + Vec2{change[0], change[1]};
  pose.heading_rad = wrap_angle(pose.heading_rad + change[2]);
  reckoning.errors.mean += change.tail<motion_error_count>();
}

void relocate(Reckoning& reckoning, const PoseBelief& found) {
  reckoning.belief = found;
  reckoning.errors.with_pose.setZero();
  reckoning.innovation_ratio = 1.0;
}

bool is_at_rest(const Reckoning& reckoning) {
  const auto stands = [](const Twist2& twist) {
    return speed_of(twist) <= at_rest_mps && std::abs(twist.turn_radps) <= at_rest_radps;
  };
  return stands(reckoning.twist) && stands(reckoning.target) &&
         std::ranges::all_of(reckoning.sent, [&](const Reckoning::Sent& sent) { return stands(sent.twist); });
}

double position_sigma_m(const PoseBelief& belief) {
  const Eigen::Matrix3d& p = belief.covariance;
  const double mean = 0.5 * (p(0, 0) + p(1, 1));
  const double half = 0.5 * (p(0, 0) - p(1, 1));
  return std::sqrt(std::max(0.0, mean + std::sqrt(half * half + p(0, 1) * p(0, 1))));
}

double heading_sigma_rad(const PoseBelief& belief) {
  return std::sqrt(std::max(0.0, belief.covariance(2, 2)));
}

bool is_lost(const PoseBelief& belief, const ReckoningOptions& options) {
  return position_sigma_m(belief) > options.lost_m || heading_sigma_rad(belief) > options.lost_rad;
}

}  // namespace outrider
