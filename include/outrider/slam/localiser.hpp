// Where a robot is on a map of landmarks that is known: an extended Kalman filter over its pose alone.
//
// It has no way to change the map; that is what it is for. A sighting is weighed by its own covariance and
// the landmark's. Sightings outside the gate are refused; the robot is lost once nothing fitted for
// `lost_after` steps. Sightings without ids go to the nearest landmark by Mahalanobis distance. Errors:
// bad_input for a step or a start that check() refuses. Thread rule: one at a time.
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
                                  const Matrix3& covariance);

  /// `added` and `removed` stay empty.
  Outcome<StepOutcome> advance(const LogStep& step);

  [[nodiscard]] const LandmarkMap& map() const { return map_; }
  [[nodiscard]] const Pose2& pose() const { return pose_; }
  [[nodiscard]] const Matrix3& covariance() const { return covariance_; }

 private:
  Localiser(LandmarkMap map, const LocaliserOptions& options, const Pose2& start, const Matrix3& covariance)
      : map_(std::move(map)), options_(options), pose_(start), covariance_(covariance) {}
  bool correct(const LandmarkSighting& sighting);

  LandmarkMap map_;
  LocaliserOptions options_;
  Pose2 pose_;
  Matrix3 covariance_;
  std::int64_t misfits_ = 0;
};

}  // namespace outrider
