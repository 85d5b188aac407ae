// Simultaneous localisation and mapping with landmarks: one interface, three engines.
//
//   kalman  is the linear Kalman filter: headings are those of the odometry, so only positions are estimated
//           and the equations are linear (Kalman 1960). For comparison.
//   ekf     is the extended Kalman filter over robot and landmarks with the full Jacobians (Smith, Self and
//           Cheeseman 1990). Landmarks without ids are associated by joint compatibility.
//   graph   is sparse least squares over all poses and landmarks. Each step is an incremental update of a
//           block Cholesky factorisation; nodes that moved far from their linearisation point are linearised
//           again (Kaess et al., iSAM2, IJRR 31 (2012) 216-235). Accepts only known ids. Supports robust
//           kernels, and covariances on demand.
//
// Map management: a landmark enters the map after `patience` sightings at about the same place, so false
// detections stay out. A sighting outside the gate is refused. If the sightings of a landmark are refused
// `patience` + 2 times while others are used, the landmark has moved: it is removed and can enter again. If
// the range of the sensor is given, a landmark is removed after `misses` steps in which it should have been
// seen and was not. If all sightings of the map are refused for `lost_after` steps, the robot is lost: the
// map is frozen until sightings fit again. Without ids, a sighting that fits no landmark is
// refused if a landmark that no other sighting fits is near, and begins a new landmark otherwise.
//
// Frames: poses are world_T_robot; covariances are of (x, y, heading) in the world. The first pose is exact.
// Complexity of a step: kalman and ekf, quadratic in the landmarks; graph, a factorisation of the part of the
// elimination tree above the changes (of the whole every `reorder_every` steps) and a solve with the whole
// factor, which is linear in its blocks: about the poses and landmarks so far, so n steps take O(n^2). Equal
// steps and options give byte-identical results, and a run continued with state() and load() equals an
// uninterrupted one. Faults: bad_input for a step that check() refuses; the state then stays unchanged.
// Thread rule: one call at a time.
#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "outrider/core/options.hpp"
#include "outrider/slam/landmark/landmark_log.hpp"

namespace outrider {

/// Options of landmark SLAM.
struct LandmarkSlamOptions {
  std::string engine = "graph";      ///< kalman, ekf or graph
  bool unknown_ids = false;          ///< associate landmarks by position and ignore their ids
  double gate = 0.9999;              ///< probability that a correct sighting passes the gate; 1: no gate
  std::int64_t patience = 2;         ///< sightings that a new landmark needs
  double patience_distance_m = 1.0;  ///< largest distance between these sightings
  double sensor_range_m = 0.0;       ///< range within which the sensor sees all landmarks; 0: unknown
  double field_of_view_rad = 6.283185307179586;  ///< opening angle of the sensor
  std::int64_t misses = 20;                      ///< consecutive misses after which a landmark is removed
  std::int64_t lost_after = 10;      ///< steps without a matching sighting until the robot is lost
  std::string kernel = "none";       ///< graph: loss of a sighting: none, huber, cauchy, geman_mcclure
  double kernel_width = 3.0;         ///< standard deviations from which the kernel reduces the weight
  double relinearise = 0.05;         ///< graph: change that triggers a new linearisation, m or rad
  std::int64_t reorder_every = 100;  ///< graph: steps between new elimination orders
  friend bool operator==(const LandmarkSlamOptions&, const LandmarkSlamOptions&) = default;
};

std::vector<Option> describe(LandmarkSlamOptions& options);

/// An estimated landmark.
struct LandmarkEstimate {
  std::int64_t id = 0;  ///< id as sighted; if ids are unknown, numbered from 0 in the order of discovery
  Vec2 position;        ///< position in the world, m
  Eigen::Matrix2d covariance = Eigen::Matrix2d::Zero();  ///< m^2
  std::int64_t sightings = 0;
  friend bool operator==(const LandmarkEstimate&, const LandmarkEstimate&) = default;
};
using LandmarkMap = std::vector<LandmarkEstimate>;

/// The result of a step: how its sightings were used, and how the map changed.
struct StepOutcome {
  int used = 0;                       ///< sightings used
  int refused = 0;                    ///< sightings outside the gate
  int waiting = 0;                    ///< sightings of candidates that are not in the map yet
  std::vector<std::int64_t> added;    ///< ids of new landmarks
  std::vector<std::int64_t> removed;  ///< ids of removed landmarks
  int contradicted = 0;               ///< how many of them because their sightings were refused
  bool lost = false;                  ///< the robot is lost; the map is frozen
};

class SlamEngine;

/// Landmark SLAM with one of the engines.
class LandmarkSlam {
 public:
  /// Begins at the start pose, which is exact. Fault: bad_input for invalid options.
  static Outcome<LandmarkSlam> begin(const LandmarkSlamOptions& options, const Pose2& start);
  /// Restores a filter or graph from the text of state(); refuses any other text.
  static Outcome<LandmarkSlam> load(std::string_view state);

  LandmarkSlam(LandmarkSlam&&) noexcept;
  LandmarkSlam& operator=(LandmarkSlam&&) noexcept;
  ~LandmarkSlam();

  /// Processes the odometry and the sightings of a step.
  Outcome<StepOutcome> advance(const LogStep& step);
  /// Optimises a graph to the minimum of its cost; does nothing for a filter.
  void settle();

  [[nodiscard]] Pose2 pose() const;
  [[nodiscard]] Eigen::Matrix3d pose_covariance() const;
  [[nodiscard]] LandmarkMap landmarks() const;
  /// The start and the pose after each step: smoothed for a graph, as estimated at that step for a filter.
  [[nodiscard]] std::vector<Pose2> trajectory() const;
  /// Returns the sum of r^T W r over odometry and sightings at the present estimate of a graph. For a filter,
  /// returns the sum of the squared normalised innovations of the sightings used, which is the same number if
  /// the equations are linear.
  [[nodiscard]] double cost() const;
  /// Returns the expected cost if the noise is as the covariances say: measured values minus unknowns.
  [[nodiscard]] std::int64_t degrees_of_freedom() const;
  /// Returns the complete state as text, for load().
  [[nodiscard]] std::string state() const;

 private:
  explicit LandmarkSlam(std::unique_ptr<SlamEngine> engine);
  std::unique_ptr<SlamEngine> engine_;
};

}  // namespace outrider
