// Logs of odometry and sightings of landmarks.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "outrider/core/outcome.hpp"
#include "outrider/geometry/pose.hpp"

namespace outrider {

struct LandmarkSighting {
  std::optional<std::int64_t> id;                        ///< of the landmark, where it can be told apart
  Vec2 position;                                         ///< in the robot's frame, m
  Eigen::Matrix2d covariance = Eigen::Matrix2d::Zero();  ///< of the position, m^2
  friend bool operator==(const LandmarkSighting&, const LandmarkSighting&) = default;
};

/// A sighting at a range and bearing that are off by these standard deviations.
LandmarkSighting sighted(std::optional<std::int64_t> id, double range_m, double bearing_rad,
                         double range_sd_m, double bearing_sd_rad);

struct LogStep {
  double time_s = 0.0;
  Pose2 odometry;                                        ///< of the robot in its frame at the step before
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();  ///< of the odometry in that frame: m^2, m rad, rad^2
  std::vector<LandmarkSighting> sightings;               ///< at the end of the motion
  friend bool operator==(const LogStep&, const LogStep&) = default;
};

/// Refuses numbers that are not finite and covariances that are not positive definite (all zeros in odometry
/// are taken as exact).
Status check(const LogStep& step);

struct LandmarkLog {
  Pose2 start;              ///< world_T_robot before the first step, held as exact
  bool told_apart = false;  ///< whoever made the log vouches for the ids: no gate, no patience is needed
  bool timed = false;       ///< its steps have times; else they are numbered
  std::vector<LogStep> steps;
  std::map<std::int64_t, Vec2>
      true_landmarks;  ///< where known; their world may be another than that of `start`
};

}  // namespace outrider
