// The scans that a map is made of, and what ties their poses together.
#pragma once

#include "graph_edges.hpp"
#include "outrider/slam/laser_scan.hpp"
#include "surface.hpp"

namespace outrider {

struct KeyScan {
  Pose2 pose;          ///< world_T_robot
  Matrix3 covariance;  ///< of the pose, by the tie that says most: an upper bound
  double way_m = 0.0;  ///< driven up to here
  LaserScan scan;
  Surface surface;
};

/// The pose of b in the frame of a. Unlike that of seen_from() the heading is not wrapped: a sum with it is
/// rounded once.
Pose2 between(const Pose2& a, const Pose2& b);
/// Of (x, y, heading) in a frame turned by the heading, from that of the parent's.
Matrix3 in_frame(const Matrix3& of_parent, double heading_rad);

class KeyGraph {
 public:
  std::vector<KeyScan> keys;

  /// Says where `to` stands in the frame of `from`, with that information in the world's directions.
  void tie(std::uint32_t from, std::uint32_t to, const Pose2& world_T_to, const Matrix3& information);
  /// Takes the last tie away, and puts the poses back to what they were before it.
  void untie(const std::vector<Pose2>& before);
  /// r^T W r of the last tie as the poses stand.
  [[nodiscard]] double tension() const;
  /// Brings the poses to the least squares of all ties. The first stays. False, and nothing is done, when the
  /// ties cannot be solved.
  bool relax();
  [[nodiscard]] std::vector<Pose2> poses() const;
  /// For each scan, how uncertain its position is from `key`, as a variance (m^2) along the chain of ties
  /// that says most; infinite beyond `bound`.
  [[nodiscard]] std::vector<double> variances_from(std::uint32_t key, double bound) const;

 private:
  struct Way {
    std::uint32_t to = 0;
    double variance = 0.0;
  };
  void spread_covariance(std::uint32_t from, std::uint32_t to, const Matrix3& covariance);

  std::vector<GraphEdge> edges_;
  std::vector<std::vector<Way>> ways_;  ///< by key
  Matrix3 covariance_before_;           ///< of the scan that the last tie led to
};

}  // namespace outrider
