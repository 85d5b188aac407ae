// The keyframes of a laser map, and the pose graph that joins them.
#pragma once

#include "laser/keyframe_covariance.hpp"

namespace outrider {

/// Expresses a covariance or an information of (x, y, heading) in a frame rotated by the heading.
Eigen::Matrix3d in_frame(const Eigen::Matrix3d& of_parent, double heading_rad);

class KeyframeGraph {
 public:
  std::vector<Keyframe> keyframes;

  /// Adds a constraint between two keyframes: `to` was measured at `world_T_to` as seen from the present pose
  /// of `from`. The information is along the world's axes.
  void add_constraint(std::uint32_t from, std::uint32_t to, const Pose2& world_T_to,
                      const Eigen::Matrix3d& information);
  void add_constraint(const KeyframeConstraint& constraint);
  /// Returns the last constraint, to say more of it.
  [[nodiscard]] KeyframeConstraint& last_constraint() { return constraints_.back(); }
  /// Says that so much of the information of the last constraint comes from a match with the map of several
  /// keyframes, all of them before `to`.
  void share_last_constraint(const Eigen::Matrix3d& information, const Matched& matched);
  /// Removes the last constraint and restores the poses to `before`.
  void remove_last_constraint(const std::vector<Pose2>& before);
  [[nodiscard]] const std::vector<KeyframeConstraint>& constraints() const { return constraints_; }
  /// Takes other constraints and poses for all that there are.
  void replace(std::vector<KeyframeConstraint> constraints, const std::vector<Pose2>& poses);
  /// Returns r^T W r of the last constraint at the present poses.
  [[nodiscard]] double chi2() const;
  /// Moves the poses to the least-squares solution of all constraints; the first stays. Returns false, and
  /// changes nothing, if there is no solution.
  bool optimise();
  [[nodiscard]] std::vector<Pose2> poses() const;
  /// Returns all constraints, with the keyframes as nodes without names.
  [[nodiscard]] PoseGraph pose_graph() const;
  /// Returns the covariance of the last keyframe; see keyframe_covariance.hpp.
  [[nodiscard]] const Eigen::Matrix3d& covariance() const { return covariance_; }
  /// Computes covariance() from all constraints.
  void update_covariance();
  /// Returns, by keyframe, the variance of its position (m^2) relative to `keyframe`, summed along the most
  /// certain chain of constraints; infinite beyond `bound`.
  [[nodiscard]] std::vector<double> variances_from(std::uint32_t keyframe, double bound) const;

 private:
  struct Link {
    std::uint32_t to = 0;
    double variance = 0.0;
  };

  void add_links(const GraphEdge& edge);

  std::vector<KeyframeConstraint> constraints_;
  std::vector<std::vector<Link>> links_;  ///< by keyframe
  KeyframeCovariance of_last_;
  Eigen::Matrix3d covariance_ = Eigen::Matrix3d::Zero();
};

}  // namespace outrider
