// The keyframes of a laser map, and the pose graph that joins them.
#pragma once

#include "graph_edges.hpp"
#include "motion_noise.hpp"
#include "outrider/slam/laser_scan.hpp"

namespace outrider {

struct Keyframe {
  Pose2 pose;  ///< world_T_robot
  /// Covariance of the pose, propagated along the most certain constraints: an upper bound.
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
  double way_m = 0.0;  ///< distance driven up to here
  LaserScan scan;      ///< without ranges once it was released

  Pose2 odometry{};                      ///< its pose on the keyframe before, by odometry
  MotionNoise odometry_noise{1.0, 1.0};  ///< of that pose
  double shared_before = 1.0;  ///< share of its surface that the keyframe before shows too, when added

  [[nodiscard]] bool has_scan() const { return !scan.ranges_m.empty(); }
  /// Frees the memory of the scan.
  void release_scan() { scan.ranges_m = std::vector<float>(); }  // "= {}" would keep the memory
};

/// Expresses a covariance or an information of (x, y, heading) in a frame rotated by the heading.
Eigen::Matrix3d in_frame(const Eigen::Matrix3d& of_parent, double heading_rad);

class KeyframeGraph {
 public:
  std::vector<Keyframe> keyframes;

  /// Adds a constraint between two keyframes: `to` was measured at `world_T_to` as seen from the present pose
  /// of `from`. The information is along the world's axes.
  void add_constraint(std::uint32_t from, std::uint32_t to, const Pose2& world_T_to,
                      const Eigen::Matrix3d& information);
  /// Removes the last constraint and restores the poses to `before`.
  void remove_last_constraint(const std::vector<Pose2>& before);
  /// Returns r^T W r of the last constraint at the present poses.
  [[nodiscard]] double chi2() const;
  /// Moves the poses to the least-squares solution of all constraints; the first stays. Returns false, and
  /// changes nothing, if there is no solution.
  bool optimise();
  [[nodiscard]] std::vector<Pose2> poses() const;
  /// Returns, by keyframe, the variance of its position (m^2) relative to `keyframe`, summed along the most
  /// certain chain of constraints; infinite beyond `bound`.
  [[nodiscard]] std::vector<double> variances_from(std::uint32_t keyframe, double bound) const;

 private:
  struct Link {
    std::uint32_t to = 0;
    double variance = 0.0;
  };
  void propagate_covariance(std::uint32_t from, std::uint32_t to, const Eigen::Matrix3d& covariance);

  std::vector<GraphEdge> edges_;
  std::vector<std::vector<Link>> links_;  ///< by keyframe
  /// Covariance of the keyframe at which the last constraint ends, before the constraint was added.
  Eigen::Matrix3d covariance_before_ = Eigen::Matrix3d::Zero();
};

}  // namespace outrider
