// RollingPlan: from the targets that are inside and the present state of the robot to the next stretch of its
// tasks, again at each event. Missions against intruders that come or survive plan by it
// (arriving_targets.hpp), and the estimate of how long such a mission takes does, too.
//
// expected_time() estimates how long a mission takes against survivors, intruders that may survive a hit. The
// model: all intruders are inside from the start. The robot drives, aims and shoots as in the tour model
// (tour/problem.hpp). After a hit the intruder leaves with a given probability; otherwise it walks in a
// straight line to another place, drawn uniformly. The robot knows at once where it goes.
#pragma once

#include <stop_token>
#include <vector>

#include "outrider/jobs/guard/behaviour/policy.hpp"
#include "outrider/jobs/guard/plan/stop_table.hpp"
#include "outrider/jobs/guard/yard/arrivals.hpp"
#include "outrider/tour/sequence.hpp"

namespace outrider {

/// When to plan, and what for. Planning uses only the intruders that were observed so far. The yard and the
/// stops must outlive it.
struct RollingPlan {
  const ArrivalYard& yard;
  const StopTable& stops;
  ReplanPolicy policy;                                         ///< when to plan anew
  ArrivalObjective objective = ArrivalObjective::time_inside;  ///< what plans minimise
  std::size_t group = 3;                                       ///< as in ArrivalOptions
  std::size_t beam = 100;                                      ///< as in ArrivalOptions

  /// Returns for how many of those `inside` to plan now, at most 64; those that have been inside longest come
  /// first. 0: the present plan is kept. `entered` of them since it was made; `idle`: it is completed.
  [[nodiscard]] std::size_t wanted(std::size_t inside, std::size_t entered, bool idle) const;
  /// Returns the next stops and the hits at each. The `first` plan is the tour of the table where that
  /// answers this very question: all its targets there, and the makespan.
  [[nodiscard]] Sequence next(const std::vector<PendingTarget>& pending, const RobotState& from,
                              bool first) const;
};

/// An estimate of the mission time.
struct ExpectedTime {
  double mean_s = 0.0;
  double error_s = 0.0;  ///< standard error of the mean
};

/// Estimates the time of the last hit as the mean over `missions` simulated missions. Of the options, only
/// leave and walk_mps are used. The result is a pure function of the arguments for any number of threads.
/// After a stop request no more missions begin, and the result is meaningless.
ExpectedTime expected_time(const RollingPlan& plan, const ArrivalOptions& options, std::size_t missions,
                           const std::stop_token& stop = {});

}  // namespace outrider
