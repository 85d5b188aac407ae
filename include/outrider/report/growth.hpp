// ReportGrowth: what is new in the report of a run since the last look at it.
#pragma once

#include <cstddef>
#include <string>
#include <tuple>
#include <vector>

#include "outrider/report/page_report.hpp"

namespace outrider {

/// Splits a growing report into the changes between two looks at it.
class ReportGrowth {
 public:
  /// Returns the changes as a report of their own with the status "running". The first report, and the first
  /// after a change of the job, has all static parts: job, world, robot, tags, walls, cost grid. Later
  /// reports leave these empty. Lists that grow (paths, shots, events, track, levels of supplies, beliefs,
  /// decisions, the seconds of a pursuit, odometry and scans of a log) continue where the last report ended.
  /// Targets, stops of a drive and the map are complete whenever a part of them has changed. Landmarks and
  /// loops are always complete. O(changes + targets + size of the map).
  PageReport delta(const PageReport& so_far);

 private:
  struct Sent {
    std::size_t paths = 0, shots = 0, events = 0, track = 0, levels = 0;
    std::size_t beliefs = 0, decisions = 0, drive_beliefs = 0;
    std::size_t slam_beliefs = 0, odometry = 0, reference = 0, scans = 0;
    std::size_t target = 0, paid = 0, bounds = 0;
    std::vector<std::size_t> robots;  ///< number of positions of each robot of a pursuit
  };
  using TargetState = std::tuple<std::string, std::string, int, std::size_t>;

  void add_pursuit(PageReport& changes, const ReportPursuit& pursuit);
  void add_drive(PageReport& changes, const ReportDrive& drive);
  void add_explore(PageReport& changes, const ReportExplore& explore);
  void add_slam(PageReport& changes, const ReportSlam& slam);

  std::string job_;
  Sent sent_;
  std::vector<TargetState> targets_;
  std::vector<double> arrivals_;  ///< arrival times at the stops of a drive; -1: not yet
  ReportMap map_, slam_map_;
};

}  // namespace outrider
