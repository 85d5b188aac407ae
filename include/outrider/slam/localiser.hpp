// Localisation on a known map of landmarks: an extended Kalman filter over the pose alone.
//
// The map never changes. A sighting is weighted by its own covariance and that of the landmark. Sightings
// outside the gate are refused; the robot is lost once nothing fitted for `lost_after` steps. Sightings
// without ids go to the nearest landmark by Mahalanobis distance. Errors: bad_input for a step or a start
// that check() refuses. Thread rule: one at a time.
#pragma once

#include "outrider/slam/landmark_slam.hpp"

namespace outrider {

struct LocaliserOptions {
  double gate = 0.9999;
  std::int64_t lost_after = 10;
};

class Localiser {
 public:
  /// `covariance` of the start: x, y, heading in the world; zeros when it is exact.
  static Outcome<Localiser> begin(LandmarkMap map, const LocaliserOptions& options, const Pose2& start,
                                  const Eigen::Matrix3d& covariance);

  /// `added` and `removed` stay empty.
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
