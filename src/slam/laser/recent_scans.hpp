// RecentScans: the last scans of a robot, matched with each other.
//
// A scan is placed by odometry and matched with those before. It is kept every 0.25 m or 0.35 rad; at most 12
// are kept. A scan that does not match begins anew, as after the robot was carried away. Thread rule: one at
// a time.
#pragma once

#include <deque>
#include <optional>

#include "motion_noise.hpp"
#include "outrider/slam/scan/laser_scan.hpp"
#include "scan/surface_map.hpp"

namespace outrider {

class RecentScans {
 public:
  struct Placed {
    LaserScan scan;
    Surface surface;
    Pose2 pose;  ///< in the frame of the first scan
  };

  /// Holds the options of the odometry, which must outlive it.
  explicit RecentScans(const LaserSlamOptions& options) : options_(options) {}

  /// Moves the robot by odometry.
  void move(const Pose2& motion);
  /// Places a scan. Returns true if it is kept.
  bool add(const LaserScan& scan, const Surface& surface);
  void clear();

  /// Returns true if there are enough of them to tell places apart.
  [[nodiscard]] bool are_enough() const;
  /// Returns the surfaces of all in the frame of the robot.
  [[nodiscard]] Surface together() const;
  [[nodiscard]] const std::deque<Placed>& scans() const { return scans_; }
  /// Returns the pose of the robot in the frame of the first scan.
  [[nodiscard]] const Pose2& pose() const { return pose_; }

 private:
  void keep(const LaserScan& scan, const Surface& surface);

  const LaserSlamOptions& options_;
  std::deque<Placed> scans_;
  std::optional<SurfaceMap> map_;  ///< of the scans
  Pose2 pose_;
  Driven unmatched_;  ///< since the last match
};

}  // namespace outrider
