// run_explore() simulates a whole exploration: what the robot does, what it believes, and the errors of its
// belief.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "outrider/job/watch.hpp"
#include "outrider/jobs/explore/map/reference.hpp"
#include "outrider/jobs/explore/mission/mission.hpp"
#include "outrider/sim/simulated_robot.hpp"

namespace outrider {

/// Called after each scan.
using ScanHook = std::function<void(const Observation& seen, const ExploreMission&, const SimulatedRobot&)>;

/// A finished exploration.
struct ExploreRun {
  Report report;
  std::string stop_reason;    ///< of explore/mission/mission.hpp
  Grid<std::uint8_t> map;     ///< values of Occupancy, in the frame of the world
  std::vector<Pose2> track;   ///< final SLAM estimate: the start, and the pose at each scan
  Pose2 pose;                 ///< final believed pose
  Pose2 true_pose;            ///< final true pose
  std::vector<Vec2> touched;  ///< points of what it touched, as it believes
};

/// Explores the world with a simulated robot, and logs the exploration. The status is "done" if the
/// exploration is complete (nothing is left over but what lies behind gaps that are too narrow, which it
/// names: left_over.hpp), the robot is home (if it has to return), it touched nothing that its laser can see,
/// and the map is right: at least 0.9 of what can be seen, before the gaps if there are any, and walls that
/// are off by at most 0.1 m on average. Touching what the laser cannot see, such as a glass door, is how the
/// robot finds out about it. A world that the robot can leave is open: there the robot turns back with the
/// reason "leak" once its map is larger than the box of all obstacles plus twice the range of the laser,
/// whatever most_extent allows. A pure function of its arguments except for machine_times. Faults: those of
/// begin() and of exploration_reference(). Metrics:
///   explored_fraction, explored_before_gaps, map_error_m, mapped_free_m2   of reference.hpp; seeable_m2
///                                    and reachable_m2, too
///   time_s, distance_m, turned_rad   of the true robot, until the end
///   decisions, max_decision_s        number of decisions, and the longest one in processor time,
///                                    from the changes of the map to the twist
///   max_step_s                       the same with the matching and mapping of the scan
///   left_over_m2                     what is left over, as the robot estimates it
///   left_narrow, left_touched, left_other   number of places left over: too narrow, touched, others
///   contacts, visible_contacts       touches of anything, and of what the laser sees
///   returned_home                    1 when the true robot ended within 0.3 m of its start
///   home_error_m                     distance of the true robot from its start in the end
///   false_complete                   1 if it believes to be done, and is elsewhere or its map wrong
///   pose_error_m                     distance of its true from its believed position in the end
///   stuck, bad_scans, loops          how often it got stuck; unusable scans; closed loops
///   home_contradiction               share of what it sees at home that contradicts its first scan
///   blocked_s                        when a post was put in its way (walk_ins.hpp); -1 if none was
/// and the table "left_over" has the places that are left over, with the reasons.
Outcome<ExploreRun> run_explore(const World& world, const ExploreTask& task, const ExplorerSimParams& params,
                                std::uint64_t seed, Log& log, const RunWatch& watch = {},
                                const ScanHook& scanned = {});

}  // namespace outrider
