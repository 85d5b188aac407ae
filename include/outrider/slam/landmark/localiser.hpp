// Localisation on a known map of landmarks: an extended Kalman filter over the pose alone.
//
// The map never changes. A sighting is weighted by its own covariance and that of the landmark. A sighting
// outside the gate is refused. The robot is lost after `lost_after` steps in a row in which all sightings
// were refused; steps without sightings do not count. Sightings without ids are associated with the nearest
// landmark by Mahalanobis distance. Fault: bad_input for a step or a start that check() refuses, and for an
// empty map. Thread rule: one call at a time.
#pragma once

#include "outrider/slam/landmark/landmark_slam.hpp"

namespace outrider {

/// Options of localisation.
struct LocaliserOptions {
  double gate = 0.9999;          ///< probability that a correct sighting passes the gate
  std::int64_t lost_after = 10;  ///< steps without a matching sighting until the robot is lost
};

/// A robot on a known map.
class Localiser {
 public:
  /// Begins at a start pose. `covariance` is that of the start (x, y, heading in the world); zeros mean that
  /// the start is exact.
  static Outcome<Localiser> begin(LandmarkMap map, const LocaliserOptions& options, const Pose2& start,
                                  const Eigen::Matrix3d& covariance);

  /// Processes the odometry and the sightings of a step. In the result, `added` and `removed` are always
  /// empty.
  Outcome<StepOutcome> advance(const LogStep& step);

  [[nodiscard]] const LandmarkMap& map() const { return map_; }
  [[nodiscard]] const Pose2& pose() const { return pose_; }
  [[nodiscard]] const Eigen::Matrix3d& covariance() const { return covariance_; }

 private:
  Localiser(LandmarkMap map, const LocaliserOptions& options, const Pose2& start,
            const Eigen::Matrix3d& covariance)
      : map_(std::move(map)), options_(options), pose_(start), covariance_(covariance) {}
  bool correct(const LandmarkSighting& sighting);

  LandmarkMap map_;
  LocaliserOptions options_;
  Pose2 pose_;
  Eigen::Matrix3d covariance_;
  std::int64_t misfits_ = 0;
};

}  // namespace outrider
