// TourProblem: serve every goal once, from freely chosen stops, in the least time.
//
// A robot with a gun on a turntable begins at the start (stop 0). From each stop it can serve some of the
// goals. A tour is a list of visits; in a visit the robot drives to a stop and serves at least one goal
// there. It need not return. Each goal can be served from one of several stops, so this is a generalised
// travelling salesman problem (Noon and Bean, 1991) with costs that depend on the heading and on the gun.
//
// The model of time, as computed by cost():
//  - Drive from stop i to stop j: turn in place to departure_rad, then drive for time_s; the heading is then
//    arrival_rad. A visit to the present stop needs no drive. A drive with time_s = 0 connects stops at the
//    same place: there is no turn, and the heading stays.
//  - Service: the gun turns to the yaw and the pitch of the service, both axes at once; then duration_s
//  passes. While
//    the body turns or drives, the gun keeps its pitch and its yaw relative to the body. Both are zero at the
//    start.
// Times are seconds, angles radians in the world, counter-clockwise from +x.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "outrider/core/outcome.hpp"
#include "outrider/motion/drive.hpp"
#include "outrider/motion/profile.hpp"

namespace outrider {

/// One way to serve a goal.
struct Service {
  std::uint32_t goal = 0;   ///< index of the goal
  double yaw_rad = 0.0;     ///< yaw of the gun in the world frame
  double pitch_rad = 0.0;   ///< pitch of the gun, up from the horizon
  double duration_s = 0.0;  ///< time of the service after aiming
};

/// A tour problem.
struct TourProblem {
  std::size_t goals = 0;          ///< number of goals
  double heading_rad = 0.0;       ///< heading at the start
  Limits turning;                 ///< limits of turns in place
  double yaw_rate_radps = 1.0;    ///< yaw rate of the gun relative to the body; its range is unlimited
  double pitch_rate_radps = 1.0;  ///< pitch rate of the gun
  std::vector<std::vector<Service>> services;  ///< by stop, the start first; each goal at most once per stop
  std::vector<Drive> drives;                   ///< from stop (row) to stop (column), row-major
};

/// A stop of a tour and the goals served there.
struct Visit {
  std::size_t stop = 0;
  std::vector<std::uint32_t> goals;  ///< in the order of serving, at least one
  friend bool operator==(const Visit&, const Visit&) = default;
};

/// A tour with its cost and a proven lower bound.
struct Tour {
  std::vector<Visit> visits;     ///< in order
  double cost_s = 0.0;           ///< from the start to the end of the last service
  double lower_bound_s = 0.0;    ///< no tour over the given stops and services takes less
  bool proven_optimal = false;   ///< no tour is faster by more than 1e-6 s
  bool ended_early = false;      ///< the budget ended or the caller cancelled; the tour is still complete
  std::uint64_t expansions = 0;  ///< labels expanded by the exact search
  std::uint64_t iterations = 0;  ///< iterations of the neighbourhood search
};

/// Checks a problem. Faults: wrong sizes, numbers that are not finite or out of range, a goal listed twice at
/// a stop, more than 4096 goals or stops, and a missing drive between stops that can be reached from the
/// start (drives back to stop 0 may be missing). O(stops^2 + services).
Status check(const TourProblem& problem);

/// Returns the time of the visits in the model; infinite if a service or a drive does not exist. It shares no
/// code with the solvers, so that it can verify them. O(visits + services at the visited stops).
double cost(const TourProblem& problem, const std::vector<Visit>& visits);

/// Verifies a tour independently of the solvers: every goal is served once, each visit serves a goal, all
/// services and drives exist, the cost is as stated (to 1e-6), and the lower bound is not above it. `problem`
/// must have passed check().
Status check(const TourProblem& problem, const Tour& tour);

}  // namespace outrider
