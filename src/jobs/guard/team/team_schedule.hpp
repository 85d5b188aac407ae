// Puts the plans of a team in time, so that no two robots come too near to each other.
#pragma once

#include <optional>
#include <vector>

#include "outrider/jobs/guard/plan/plan.hpp"
#include "outrider/jobs/guard/yard/firing_map.hpp"
#include "outrider/motion/presence.hpp"

namespace outrider {

/// A robot of a team, with its plan. Both references must outlive it.
struct TeamMember {
  const GuardProblem& problem;  ///< with its own start
  const GuardPlan& plan;
};

/// The times of one robot.
struct MemberTimes {
  std::vector<double> begins_s;    ///< by stop: when the drive to it begins
  std::vector<std::size_t> turns;  ///< by stop: number of drives of the team that were admitted before it
  double end_s = 0.0;              ///< the last stop is made and the last ball has landed
};

/// Returns the times of a team, by robot; nothing if the search found no order in which all keep apart.
std::optional<std::vector<MemberTimes>> schedule_team(const FiringMap& firing_map,
                                                      const std::vector<TeamMember>& team, double gap_m);

}  // namespace outrider
