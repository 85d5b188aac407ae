// Puts the plans of a team in time, so that no two robots come too near to each other.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "outrider/jobs/guard/mission/task_board.hpp"
#include "outrider/jobs/guard/plan/plan.hpp"
#include "outrider/jobs/guard/team/team_plan.hpp"
#include "outrider/jobs/guard/yard/firing_map.hpp"
#include "outrider/motion/presence.hpp"

namespace outrider {

/// A robot of a team, with its plan. Both references must outlive it.
struct TeamMember {
  const GuardProblem& problem;  ///< with its own start
  const GuardPlan& plan;
};

/// Returns the times of a team, by robot; nothing if the search found no order in which all keep apart.
std::optional<std::vector<MemberTimes>> schedule_team(const FiringMap& firing_map,
                                                      const std::vector<TeamMember>& team, double gap_m);

/// The order in which the drives of a team's plan begin, as far as it matters.
///
/// The plan says when each drive begins, and errors change all times. But whoever was to pass a place before
/// another robot comes to stand there has to pass it first, or never. So a drive waits for each drive of
/// another robot that the plan admitted before and that comes near to its way, at any time: until that drive
/// begins, since the rest is a matter of keeping apart. Waits go back in the order of the plan, so nobody
/// waits in a circle. Source: Hoenig et al., Persistent and robust execution of MAPF schedules in warehouses,
/// IEEE Robotics and Automation Letters 4(2), 2019.
class TeamOrder {
 public:
  /// The plan must outlive it.
  TeamOrder(const TeamPlan& plan, double gap_m) : plan_(plan), gap_m_(gap_m) {}

  /// Returns a robot whose drive comes before that of `robot` along these waypoints to its planned stop at
  /// `place`, and has not begun yet; nothing if there is none, or if no such stop is planned. `tasks` are
  /// those of the robots. O(stops * waypoints^2).
  [[nodiscard]] std::optional<std::size_t> waits_for(std::size_t robot, Vec2 place,
                                                     const std::vector<Vec2>& waypoints,
                                                     const std::vector<const TaskBoard*>& tasks) const;

 private:
  const TeamPlan& plan_;
  double gap_m_;
};

}  // namespace outrider
