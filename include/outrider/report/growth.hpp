// A report while a run fills it: who looks on, and what is new since they looked before.
#pragma once

#include <cstddef>
#include <string>
#include <tuple>
#include <vector>

#include "outrider/report/report.hpp"

namespace outrider {

/// Looks on while a run fills its report. Nothing of it changes what happens. Thread rule: the run calls,
/// from one thread.
class RunObserver {
 public:
  virtual ~RunObserver() = default;
  /// Whether it wants to see the report now. A run asks after each step, and brings up to date what takes
  /// time only where it is wanted.
  virtual bool wants() = 0;
  /// The report so far; once more, unasked, when the run is over. Its metrics and verdict are not there yet.
  virtual void see(const Report& so_far) = 0;

 protected:
  RunObserver() = default;
  RunObserver(const RunObserver&) = default;
  RunObserver& operator=(const RunObserver&) = default;
};

/// Takes a report that grows apart into what came between two looks at it.
class ReportGrowth {
 public:
  /// What is new, as a report of its own with the status "running". At first, and where the job has changed,
  /// that is all that stands still: job, world, robot, tags, walls, the map of costs. After that these are
  /// empty. Lists that grow (paths, shots, events, track, levels of supplies, beliefs, decisions, what
  /// happens in each second of a chase, odometry and scans of a log) go on where the one before ended.
  /// Targets, stops of a drive and the map that is found come whole, when something of them has changed;
  /// landmarks and loops come whole each time. O(what is new + targets + size of the
  /// map).
  Report delta(const Report& so_far);

 private:
  struct Told {
    std::size_t paths = 0, shots = 0, events = 0, track = 0, levels = 0;
    std::size_t beliefs = 0, decisions = 0, drive_beliefs = 0;
    std::size_t slam_beliefs = 0, odometry = 0, reference = 0, scans = 0;
    std::size_t target = 0, paid = 0, bounds = 0;
    std::vector<std::size_t> robots;  ///< of a chase, by robot
  };
  using TargetState = std::tuple<std::string, std::string, int, std::size_t>;

  void add_chase(Report& news, const ReportChase& chase);
  void add_drive(Report& news, const ReportDrive& drive);
  void add_explore(Report& news, const ReportExplore& explore);
  void add_slam(Report& news, const ReportSlam& slam);

  std::string job_;
  Told told_;
  std::vector<TargetState> targets_;
  std::vector<double> arrivals_;  ///< at the stops of a drive; -1: not yet
  ReportMap map_, slam_map_;
};

}  // namespace outrider
