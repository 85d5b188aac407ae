// ScanLocaliser: where a robot is by its odometry and its laser scans, on the map that it makes of them.
//
// SLAM matches each scan, and odometry carries the pose on until the next one. A scan belongs to where the
// robot was when it was measured, so one that comes late is matched there. Unusable scans are skipped, as are
// those that repeat the ranges of before after a motion, which a frozen sensor does. The mission notes each
// observation before the navigator perceives it; the navigator then asks by take(). Frames: poses are
// world_T_robot in the frame of the start pose. Thread rule: one at a time. Cost: that of LaserSlam.
#pragma once

#include <deque>
#include <optional>
#include <string>
#include <vector>

#include "outrider/jobs/explore/map/close_range.hpp"
#include "outrider/navigate/robot_localiser.hpp"
#include "outrider/robot/observation.hpp"
#include "outrider/slam/laser/laser_slam.hpp"
#include "outrider/slam/scan/repeated_scans.hpp"

namespace outrider {

/// The effects of an observation.
struct Localised {
  bool redrawn = false;      ///< the map was drawn anew, so that marks on it have to move
  bool corrected = false;    ///< a pose was corrected by more than two cells
  bool closed_loop = false;  ///< a place was recognised
  bool undid_loop = false;   ///< and a loop that was closed before is undone
  std::string lost;          ///< why the pose is not known any more; empty if it is
};

class ScanLocaliser final : public RobotLocaliser {
 public:
  /// `slam` begins at `start` with these options. The robot is lost at a standard deviation of `lost_m`.
  ScanLocaliser(LaserSlam slam, const LaserSlamOptions& options, const Pose2& start, double lost_m);

  /// Takes an observation. Odometry that is not finite is taken for that of before.
  Localised note(const Observation& seen);
  /// Tells the navigator what note() made of the scan.
  bool take(const LaserScan& scan, const Pose2& odometry_T_robot) override;
  [[nodiscard]] Pose2 world_T_odometry() const override { return world_T_odometry_; }
  [[nodiscard]] Eigen::Matrix3d covariance() const override { return slam_.pose_covariance(); }
  /// Optimises all poses a last time.
  void finish();

  [[nodiscard]] const LaserSlam& slam() const { return slam_; }
  [[nodiscard]] bool begun() const { return started_s_.has_value(); }
  [[nodiscard]] double started_s() const { return *started_s_; }  ///< time of the first observation
  [[nodiscard]] double time_s() const { return time_s_; }         ///< time of the newest one
  [[nodiscard]] const Pose2& pose() const { return pose_; }       ///< believed pose at that time
  [[nodiscard]] const Pose2& odometry() const { return odometry_; }
  [[nodiscard]] const Twist2& twist() const { return twist_; }  ///< recent velocity by odometry
  [[nodiscard]] double driven_m() const { return driven_m_; }   ///< distance by odometry
  [[nodiscard]] double range_m() const { return range_m_; }     ///< largest range of its scans
  [[nodiscard]] std::int64_t scans() const { return scans_; }
  [[nodiscard]] std::int64_t bad_scans() const { return bad_scans_; }  ///< those that could not be used
  [[nodiscard]] bool any_usable() const { return scans_ > bad_scans_; }
  /// Returns the time since the newest usable scan was measured.
  [[nodiscard]] double blind_s() const { return time_s_ - scan_s_; }
  /// Returns the surfaces around the robot by its last scans, finer than the map.
  [[nodiscard]] std::vector<Vec2> surfaces() const { return close_range_.surfaces(odometry_, pose_); }

  /// True if a scan arrived, or all poses were optimised, since forget_news().
  [[nodiscard]] bool has_news() const { return has_news_; }
  void forget_news() { has_news_ = false; }
  /// Returns what these changed on the map.
  [[nodiscard]] const MapUpdate& changed() const { return changed_; }

  /// Optimises all poses with the next scan.
  void settle_soon() { settles_soon_ = true; }
  [[nodiscard]] bool settles_soon() const { return settles_soon_; }
  /// Returns true if they were optimised within the last metres, and since forget_settling().
  [[nodiscard]] bool settled_within(double metres) const {
    return settled_m_ && driven_m_ - *settled_m_ <= metres;
  }
  void forget_settling() { settled_m_.reset(); }

  /// Returns why the range finder is not to be believed, or nothing; asks the scans less and less often.
  std::string doubt_of_range_finder();
  /// Returns the share of points by which the newest usable scan contradicts the first one; nothing without
  /// scans.
  [[nodiscard]] std::optional<double> contradiction_of_first_scan() const;

 private:
  struct TimedOdometry {
    double time_s = 0.0;
    Pose2 odometry;
  };
  struct KeptScan {
    LaserScan scan;
    std::size_t step = 0;  ///< its number in the trajectory
  };

  void remember_odometry();
  [[nodiscard]] Pose2 odometry_at(double time_s) const;
  void take_scan(const LaserScan& scan, Localised& result);
  void keep(const LaserScan& scan, const Pose2& then);
  void settle(Localised& result);
  void learn(MapUpdate update);
  [[nodiscard]] bool much_between(const Pose2& before, const Pose2& after) const;
  [[nodiscard]] Pose2 carried_on() const;

  LaserSlam slam_;
  Pose2 robot_T_laser_;
  double much_m_;  ///< a correction by more
  double lost_m_;
  double time_s_ = 0.0;
  std::optional<double> started_s_;
  Pose2 pose_;
  Twist2 twist_;
  Pose2 odometry_;
  Pose2 odometry_of_slam_;                ///< when the previous scan was measured
  std::deque<TimedOdometry> odometries_;  ///< the last seconds of odometry, for scans that come late
  double driven_m_ = 0.0;
  double scan_s_ = 0.0;  ///< when the newest usable scan was measured
  double range_m_ = 3.5;
  std::int64_t scans_ = 0;
  std::int64_t bad_scans_ = 0;
  std::int64_t asked_at_ = 250;  ///< number of scans at which the range finder is asked about next
  std::optional<KeptScan> first_, newest_;
  RepeatedScans repeated_;
  CloseRange close_range_;
  bool has_news_ = false;
  MapUpdate changed_;
  Pose2 world_T_odometry_;  ///< as the navigator knows it
  bool moved_ = false;      ///< the map was corrected since take()
  bool settles_soon_ = false;
  std::optional<double> settled_m_;  ///< driven_m at the last optimisation
};

}  // namespace outrider
