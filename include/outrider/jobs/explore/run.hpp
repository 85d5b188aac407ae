// A whole exploration, simulated: what the robot does, what it believes, and how far the truth is from it.
#pragma once

#include <cstdint>
#include <functional>

#include "outrider/job/watch.hpp"
#include "outrider/jobs/explore/mission.hpp"
#include "outrider/jobs/explore/reference.hpp"
#include "outrider/sim/simulated_robot.hpp"

namespace outrider {

/// Called after each scan.
using ScanHook = std::function<void(const ExploreMission&, const SimulatedRobot&)>;

struct ExploreRun {
  Report report;
  std::string stop_reason;   ///< of jobs/explore/mission.hpp
  Grid<std::uint8_t> map;    ///< values of Occupancy, in the frame of the world
  std::vector<Pose2> track;  ///< as SLAM knows it in the end: the start, and the pose at each scan
  Pose2 pose;                ///< believed in the end
  Pose2 true_pose;           ///< then
};

/// Explores the world on a simulated robot and reports. status is "done" when the exploration is complete,
/// the robot home where it was to go there, and nothing was touched. A world that the robot can leave has no
/// end: there it turns back, with "leak" for a reason, once its map is larger than the box of all that stands
/// and twice the range of the laser, whatever most_extent allows. A pure function of its arguments, the
/// machine_times left out. The map that an observer sees has at most 40,000 cells. Faults: those of begin()
/// and of exploration_reference(). Metrics:
///   explored_fraction, map_error_m, mapped_free_m2   of reference.hpp; seeable_m2 and reachable_m2, too
///   time_s, distance_m, turned_rad   of the true robot, until the end
///   decisions, max_decision_s        times that it thought where to go, and the longest in processor time,
///                                    from the changes of the map to the twist
///   max_step_s                       the same with the matching and mapping of the scan
///   contacts                         touches of anything
///   returned_home                    1 when the true robot ended within 0.3 m of its start
///   home_error_m                     distance of its true from its believed position in the end
///   stuck, bad_scans, loops          times that it got stuck; scans not of use; loops closed
/// and report.explore has the map, the beliefs, the decisions and the frontiers refused.
Outcome<ExploreRun> run_explore(const World& world, const ExploreTask& task, const ExplorerSimParams& params,
                                std::uint64_t seed, const RunWatch& watch = {}, const ScanHook& scanned = {});

}  // namespace outrider
