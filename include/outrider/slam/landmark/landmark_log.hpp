// Landmark logs: odometry and sightings of landmarks.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "outrider/core/options.hpp"
#include "outrider/core/outcome.hpp"
#include "outrider/core/units.hpp"
#include "outrider/geometry/pose.hpp"

namespace outrider {

/// One measured landmark position.
struct LandmarkSighting {
  std::optional<std::int64_t> id;                        ///< id of the landmark, if it can be identified
  Vec2 position;                                         ///< position in the robot frame, m
  Eigen::Matrix2d covariance = Eigen::Matrix2d::Zero();  ///< covariance of the position, m^2
  friend bool operator==(const LandmarkSighting&, const LandmarkSighting&) = default;
};

/// Returns a sighting from a range and a bearing with these standard deviations.
LandmarkSighting sighted(std::optional<std::int64_t> id, double range_m, double bearing_rad,
                         double range_sd_m, double bearing_sd_rad);

/// Standard deviations. For odometry they grow with the square root of the distance and of the angle turned.
struct LogNoise {
  double distance = 0.01;                       ///< error of the position, m per sqrt(m)
  double turn_per_distance_rad = radians(6.0);  ///< error of the heading, rad per sqrt(m)
  double turn = 0.1;                            ///< error of the heading, rad per sqrt(rad)
  double range_m = 0.3;
  double bearing_rad = radians(6.0);
};

std::vector<Option> describe(LogNoise& noise);

/// A motion with its covariance, composed of short motions.
struct LogMotion {
  Pose2 pose;
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();

  /// Adds a turn, a straight drive and a second turn.
  void add(double turn_rad, double distance_m, double then_turn_rad, const LogNoise& noise);
};

/// One motion and the sightings at its end.
struct LogStep {
  double time_s = 0.0;
  Pose2 odometry;                                        ///< previous_T_robot by odometry
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();  ///< covariance of the odometry, in m^2, m rad, rad^2
  std::vector<LandmarkSighting> sightings;               ///< sightings at the end of the motion
  friend bool operator==(const LogStep&, const LogStep&) = default;
};

/// Checks a step. Faults: numbers that are not finite, and covariances that are not positive definite. An
/// odometry covariance of all zeros is valid and means exact odometry.
Status check(const LogStep& step);

/// A complete log.
struct LandmarkLog {
  Pose2 start;              ///< world_T_robot before the first step, taken as exact
  bool told_apart = false;  ///< the ids are reliable: neither gate nor patience is needed
  bool timed = false;       ///< the steps have times; otherwise they are numbered
  std::vector<LogStep> steps;
  std::map<std::int64_t, Vec2>
      true_landmarks;  ///< true positions, if known; their frame may differ from that of `start`
};

}  // namespace outrider
