// LandmarkMission: a mission that maps landmarks from recorded motions and sightings, and commands nothing.
#pragma once

#include <optional>
#include <utility>
#include <vector>

#include "outrider/robot/mission.hpp"
#include "outrider/slam/landmark/landmark_check.hpp"
#include "outrider/slam/landmark/landmark_slam.hpp"

namespace outrider {

/// A Mission (robot/mission.hpp). It ends with an observation without landmark data: the log is over; or
/// with a fault of the map.
class LandmarkMission {
 public:
  /// Takes a map that is about to begin, or is continued.
  explicit LandmarkMission(LandmarkSlam begun) : slam(std::move(begun)) { odometry.push_back(slam.pose()); }

  /// Takes in a step of the log. Returns Wait, or nothing when the mission is over.
  std::optional<Command> step(const Observation& seen);

  LandmarkSlam slam;
  std::vector<double> times_s;        ///< that each step took, by the wall clock
  std::vector<Pose2> odometry;        ///< the start, and the pose by odometry alone after each step
  std::optional<StepOutcome> newest;  ///< of the last step; empty after the end
  std::optional<Fault> fault;         ///< that ended the mission
  int used = 0;                       ///< sightings, summed over the steps
  int refused = 0;                    ///< sightings
  int removed = 0;                    ///< landmarks
  int contradicted = 0;               ///< landmarks that were removed because their sightings were refused
  int misfits = 0;                    ///< longest row of steps at which no sighting of the map fitted
  int lost = 0;                       ///< steps at which the robot was lost
  bool checks_landmarks = false;      ///< set before the first step to have `check` filled
  LandmarkCheck check;                ///< whether landmarks were moved too far

 private:
  int misfits_now_ = 0;
};

}  // namespace outrider
