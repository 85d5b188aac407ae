// TeamPlan: several robots share the targets of a yard, and are never in each other's way.
//
// The targets are split into one part for each robot. First, the order in which one robot would hit all of
// them, and their order by bearing, are cut into runs of targets; the cuts and the robots of the runs are
// those with the least estimated makespan. Then targets move from the latest robot to others as long as that
// helps. Each part is planned like the mission of one robot, the estimates are corrected by these plans, and
// the split is repeated a few times. The source of cut-first heuristics is Frederickson, Hecht and Kim,
// Approximation algorithms for some routing problems, SIAM J. Computing 7(2), 1978.
//
// The plans are then put in time. A robot waits before a drive until the drive, and standing at its end for
// ever, keeps the distance team_gap_m() from all drives that were admitted before. So whoever stands
// somewhere is never driven into, and no two robots wait for each other. Among the possible next drives the
// one that begins soonest is admitted; dead ends are left by backtracking.
//
// Level ground, targets that stand still, no stations. Plans do not look at balls that touch other robots;
// whoever carries them out does (team_run.hpp).
#pragma once

#include <cstdint>
#include <vector>

#include "outrider/jobs/guard/plan/plan.hpp"
#include "outrider/jobs/guard/yard/firing_map.hpp"

namespace outrider {

/// When a robot of a team does what.
struct MemberTimes {
  std::vector<double> begins_s;    ///< by stop of the plan: when the drive to it begins
  std::vector<std::size_t> turns;  ///< by stop: number of drives of the team that were admitted before it
  double end_s = 0.0;              ///< all its stops are made and its last ball has landed
};

/// The part of one robot in the plan of a team.
struct TeamPart {
  Pose2 start;
  GuardPlan plan;  ///< of its targets, as if it were alone; without lower bounds
  MemberTimes times = {};
};

/// The plan of a team.
struct TeamPlan {
  std::vector<TeamPart> parts;           ///< by robot
  std::vector<Unreachable> unreachable;  ///< targets that cannot be hit
  double makespan_s = 0.0;               ///< the largest `end_s`
  double alone_s = 0.0;                  ///< time of the first robot's plan for all targets
  double lower_bound_s = 0.0;            ///< proven lower bound on the makespan of every team plan
};

/// Returns the least distance between the centres of two robots when they are simulated: their bodies, the
/// largest errors of the ends of their drives, and 2 cm.
double simulated_gap_m(const GuardProblem& problem);
/// Returns the least distance in a plan, where that is possible: one such error more, so that a robot that
/// has ended beside its goal may drive on.
double team_gap_m(const GuardProblem& problem);

/// Checks the starts of a team: the first is that of the problem, all are in reach of it, and each two are at
/// least simulated_gap_m() apart. Fault: bad_input, with the robots as they count from 1.
Status check_starts(const GuardProblem& problem, const FiringMap& firing_map,
                    const std::vector<Pose2>& starts);

/// Plans for a team. Every target is in one stop of one part or in `unreachable`. The plan is never slower
/// than the first robot alone, if the others do not stand in its way. Deterministic. Faults: those of
/// check_starts(), plan_guard() and precompute_stops(); no_path if no order of the drives was found in which
/// the robots keep apart. Takes about 2 + robots times as long as plan_guard(), and up to three times that.
Outcome<TeamPlan> plan_team(const GuardProblem& problem, const FiringMap& firing_map,
                            const std::vector<Pose2>& starts, const GuardOptions& options,
                            const Budget& budget);

inline constexpr std::int64_t most_robots = 5;

/// Returns the starts of `robots` robots: that of the problem and the `others`. If there are no others, they
/// are chosen: the centres of reachable cells with the heading of the first robot, one after another. Each is
/// at least 2 simulated_gap_m() from those before, so that every robot can turn aside, or once that if there
/// is not enough room; and it has the least sum of its distance to the left or right of the first robot and
/// twice its distance ahead of it or behind. O(cells * robots). Faults: those of check_starts() at
/// `robot_starts`; bad_input at `robots` if there is not enough room.
Outcome<std::vector<Pose2>> starts_of_team(const GuardProblem& problem, const FiringMap& firing_map,
                                           std::size_t robots, const std::vector<Pose2>& others);

}  // namespace outrider
