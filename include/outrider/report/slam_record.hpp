// SlamRecord: what is noted while a log is mapped, and the report that comes of it.
//
// While the log is mapped the report grows by a row a step: belief, odometry and, since nothing is settled
// yet, the belief once more as its track. settle() puts the way as it is known in the end into the track, and
// thins the rows (thinning.hpp) where there are more than 5000.
// Bounds: 5000 rows, 400 scans of 180 points, 2000 loops. Thread rule: one at a time.
#pragma once

#include <Eigen/Core>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "outrider/report/report.hpp"
#include "outrider/slam/laser_scan.hpp"

namespace outrider {

/// A step of a log as it was believed then.
struct SlamRow {
  double time_s = 0.0;
  Pose2 pose;
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();  ///< of x, y and heading: m^2, m rad, rad^2
  Pose2 odometry;                                        ///< where odometry alone puts the robot
  bool recognised = false;                               ///< something known told where the robot is
};

/// Seconds from the first step, as its times say; a time that goes back counts as the one before. Of a log
/// without times, or whose times go on in fewer than nine of ten steps: a tenth of a second a step. O(steps).
std::vector<double> run_times(const std::vector<double>& recorded_s);

/// Where the beams of a scan ended, in the frame of the robot: of at most 180 beams, equally far apart.
std::vector<Vec2> points_of(const LaserScan& scan, const Pose2& robot_T_laser);

/// A part of a covariance as reports keep it: the two sigmas and the correlation.
struct ReportSigmas {
  double x_m = 0.0;
  double y_m = 0.0;
  double correlation = 0.0;
};
ReportSigmas sigmas_of(double xx, double xy, double yy);

/// What a motion adds to the way that scans are spread over: half a metre for each radian turned, too.
double scan_way_m(const Pose2& motion);

class SlamRecord {
 public:
  /// Fills the parts `track` and `slam` of a report. `way_m` is the sum of scan_way_m() by odometry.
  SlamRecord(Report& report, const std::string& engine, double way_m);

  void note(const SlamRow& row);
  /// Keeps what was seen at the row noted last, to the centimetre, where the way since the one before is long
  /// enough; `points` is asked then only.
  void note_scan(const std::function<std::vector<Vec2>()>& points);

  /// The way as known in the end, a pose a row, and a reference in its frame, as long or empty. Adds the
  /// metrics `distance_m`, the length of the way, and `thinned_m`, within which lines between the rows kept
  /// are what was noted (headings count a metre a radian).
  void settle(const std::vector<Pose2>& poses, const std::vector<Vec2>& reference);

 private:
  void thin();

  Report& report_;
  double scan_every_m_;
  double way_m_ = 0.0;
  double next_scan_m_ = 0.0;
  std::optional<Pose2> odometry_;  ///< at the row noted last
};

/// Takes away loops beyond 2000, equally far apart in their order.
void bound_loops(std::vector<ReportLoop>& loops);

/// What holds all that a report of mapping tells of, odometry left out, and a margin around it.
Box2 bounds_of(const Report& report);

}  // namespace outrider
