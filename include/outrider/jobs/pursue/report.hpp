// PursuitLog logs a pursuit, and pursuit_report() returns its result. Both are pure functions of the run
// and use no wall clock, so the same run gives the same bytes.
#pragma once

#include <string>

#include "outrider/jobs/pursue/run.hpp"
#include "outrider/log/log.hpp"
#include "outrider/report/report.hpp"

namespace outrider {

/// Logs a pursuit. The map is logged with at most 500 cells a side: a larger map is averaged
/// over square blocks, and a block with more walls than free cells is a wall. Thread rule: one at a time.
class PursuitLog {
 public:
  /// Logs what stands still, and where everybody is at first. The log and the problem must outlive this
  /// object. A robot on wheels has a radius and logs itself where it is.
  PursuitLog(Log& log, const PursuitProblem& problem, const std::string& name, double robot_radius_m = 0.0);
  /// Logs what is new in the run since the last call.
  void note(const PursuitRun& run);

 private:
  void log_place(const std::string& topic, int second, Cell cell);

  Log& log_;
  const PursuitProblem& problem_;
  bool robot_logs_;
  int second_ = 0;  ///< up to which the places are logged
  double paid_ = 0.0;
  std::size_t moments_ = 0;
};

/// Returns the report. Its status is "done" if the target was caught.
Report pursuit_report(const PursuitProblem& problem, const PursuitRun& run, const std::string& name);

/// Returns that of a robot on wheels. It is not "done" if the robot touched something. Bounds on steps from
/// cell to cell hold for it if it never went farther than a cell in a second; else the report has none.
Report pursuit_report(const PursuitProblem& problem, const PursuitRun& run, const NavigatedBody& robot,
                      const std::string& name);

/// Returns the report of a pursuit that was proven impossible before it began.
Report pursuit_report(const Fault& fault, const std::string& name);

}  // namespace outrider
