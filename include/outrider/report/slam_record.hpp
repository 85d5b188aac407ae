// SlamRecord fills the report of a log while it is mapped.
//
// The report grows by one row for each step of the log: the belief, the odometry, and the belief again as the
// track. settle() replaces the track by the final estimate of the path, and thins the rows (thinning.hpp) if
// there are more than 5000. Bounds: 5000 rows, 400 scans of 180 points, 2000 loops. Thread rule: one at a
// time.
#pragma once

#include <Eigen/Core>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "outrider/report/report.hpp"
#include "outrider/slam/laser_scan.hpp"

namespace outrider {

/// One step of a log as it was believed at that time.
struct SlamRow {
  double time_s = 0.0;
  Pose2 pose;
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();  ///< of x, y and heading: m^2, m rad, rad^2
  Pose2 odometry;                                        ///< pose by odometry alone
  bool recognised = false;                               ///< a known landmark or place corrected the belief
};

/// Returns the time of each step since the first one, s. A time that goes back counts as the one before. A
/// log without times, or whose times increase in fewer than nine of ten steps, gets 0.1 s for each step.
/// O(steps).
std::vector<double> run_times(const std::vector<double>& recorded_s);

/// Returns the end points of at most 180 beams of a scan, at equal distances in the scan, in the frame of the
/// robot.
std::vector<Vec2> points_of(const LaserScan& scan, const Pose2& robot_T_laser);

/// The covariance of a position as reports keep it: two standard deviations and the correlation.
struct ReportSigmas {
  double x_m = 0.0;
  double y_m = 0.0;
  double correlation = 0.0;
};
/// Converts a covariance matrix [xx xy; xy yy].
ReportSigmas sigmas_of(double xx, double xy, double yy);

/// Returns the length of a motion for spacing scans: its distance plus half a metre for each radian turned.
double scan_way_m(const Pose2& motion);

class SlamRecord {
 public:
  /// Fills the members `track` and `slam` of the report. `way_m` is the sum of scan_way_m() over the
  /// odometry.
  SlamRecord(Report& report, const std::string& engine, double way_m);

  /// Adds a row.
  void note(const SlamRow& row);
  /// Keeps the scan of the last row, rounded to the centimetre, if the path since the last kept scan is long
  /// enough. Calls `points` only then.
  void note_scan(const std::function<std::vector<Vec2>()>& points);

  /// Sets the final path, with one pose for each row, and a reference in the same frame, which is as long or
  /// empty. Adds the metrics `distance_m`, the length of the path, and `thinned_m`, the largest deviation of
  /// the removed rows from the lines between the kept rows (one radian of heading counts as one metre).
  void settle(const std::vector<Pose2>& poses, const std::vector<Vec2>& reference);

 private:
  void thin();

  Report& report_;
  double scan_every_m_;
  double way_m_ = 0.0;
  double next_scan_m_ = 0.0;
  std::optional<Pose2> odometry_;  ///< at the last row
};

/// Keeps at most 2000 loops, at equal distances in their order.
void bound_loops(std::vector<ReportLoop>& loops);

/// Returns a box around everything in a report of mapping except odometry, with a margin.
Box2 bounds_of(const Report& report);

}  // namespace outrider
