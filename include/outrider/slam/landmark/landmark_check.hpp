// LandmarkCheck: were landmarks moved farther than their covariances allow?
//
// A landmark stands still, so later sightings correct its estimate by about as much as its covariance
// promised: between two times, the difference of the estimates has the covariance P(earlier) - P(later) if
// the filter is consistent. Where the filter takes one landmark for another, it corrects the whole map by
// wrong sightings, again and again and to different sides, and becomes sure of it. Innovations do not tell,
// because each sighting is taken for the landmark that it fits best; nor do distances between landmarks.
//
// A landmark is moved too far if the squared Mahalanobis distance of an earlier estimate from the last one
// exceeds 4 x 18.4: errors are then more than twice as large as a consistent filter makes once in ten
// thousand times (chi-square of 2 degrees of freedom).
// Source: Bar-Shalom, Li and Kirubarajan, Estimation with Applications to Tracking and Navigation, Wiley
// 2001, 232-240 (consistency of filters). Complexity: a step, the landmarks; memory, the landmarks once in 20
// steps.
#pragma once

#include <cstdint>
#include <vector>

#include "outrider/slam/landmark/landmark_slam.hpp"

namespace outrider {

/// A landmark that was moved too far.
struct MovedLandmark {
  std::int64_t id = 0;
  std::size_t step = 0;  ///< of the estimate from which it moved most, in standard deviations
  double moved_m = 0.0;  ///< from there to the last estimate
  double sd_m = 0.0;     ///< standard deviation along that way that the covariances allow
  friend bool operator==(const MovedLandmark&, const MovedLandmark&) = default;
};

class LandmarkCheck {
 public:
  /// Takes in the map after each step, by the number of the step. Keeps it if it has new landmarks, or once
  /// in 20 steps.
  void note(std::size_t step, const LandmarkMap& map);

  /// Returns the landmarks of the last map that were moved too far, in its order. O(landmarks x maps kept).
  [[nodiscard]] std::vector<MovedLandmark> judge(const LandmarkMap& last) const;

 private:
  struct Kept {
    std::size_t step = 0;
    LandmarkMap map;
  };
  std::vector<Kept> kept_;
};

}  // namespace outrider
