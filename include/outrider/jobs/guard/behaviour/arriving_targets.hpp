// ArrivingTargets: the intruders inside a yard that others keep entering, and the planning of stop tasks for
// them.
//
// Between two commands the policy may request a new plan for the intruders inside. A new plan never aborts an
// action: a drive continues to its next waypoint, where the robot stops anyway; an aimed shot is fired; and a
// started visit to a station is completed. The stop tasks (task_board.hpp) do the rest: they solve each shot
// again from the true position, repeat misses, and make a second pass at the end.
#pragma once

#include <optional>
#include <vector>

#include "outrider/jobs/guard/behaviour/rolling_plan.hpp"
#include "outrider/jobs/guard/mission/task_board.hpp"

namespace outrider {

/// The intruders known so far. Copies are independent; the plan must outlive them.
class ArrivingTargets {
 public:
  explicit ArrivingTargets(const RollingPlan& plan) : plan_(&plan) {}

  /// Returns a board without tasks and with one record per intruder.
  [[nodiscard]] TaskBoard board() const;
  /// Notes the results of shots and those inside: adds those that have entered, removes those that are done.
  void note(TaskBoard& board, const Observation& seen);
  /// Returns the next command, or nothing when all intruders are done and no more will come. The plan is kept
  /// until the policy requests a new one. No intruder is shot at before it is in its place. In the end each
  /// intruder is reached, failed (after 2 `tries` shots, or without a shot from the places reached) or
  /// unreachable.
  std::optional<Command> propose(TaskBoard& board, const Observation& seen);

  [[nodiscard]] const RollingPlan& plan() const { return *plan_; }
  /// Returns those observed and not done, in the order of entering.
  [[nodiscard]] const std::vector<TargetArrival>& inside() const { return inside_; }
  [[nodiscard]] std::int64_t plans() const { return plans_; }        ///< number of plans made
  [[nodiscard]] std::int64_t survived() const { return survived_; }  ///< hits that the intruder survived

 private:
  void forget_the_done(const TaskBoard& board);
  [[nodiscard]] std::vector<TargetArrival> open_targets(const TaskBoard& board) const;
  [[nodiscard]] std::optional<double> to_wait_for(const TaskBoard& board, const Observation& seen) const;
  void plan_anew(const std::vector<TargetArrival>& open, TaskBoard& board, const Observation& seen,
                 std::size_t count);

  const RollingPlan* plan_;
  std::vector<TargetArrival> inside_;
  std::size_t entered_ = 0;  // since the last plan
  std::int64_t plans_ = 0;
  std::int64_t survived_ = 0;
};

}  // namespace outrider
