// The tour problem: serve every goal once, from stops of one's choice, in the least time.
//
// A robot stands at the start (stop 0) and has a gun on a turntable. From each stop it can serve some
// of the goals. A tour is a list of visits; a visit drives to a stop and serves there at least one goal.
// It need not return. Choosing one stop of several for each goal makes it a generalised travelling
// salesman problem (Noon and Bean, 1991) whose costs depend on the heading and on the gun.
//
// The model of time, which cost() follows to the letter:
//  - Driving from stop i to stop j: turn in place to departure_rad, then time_s; the heading is then
//    arrival_rad. A visit to the stop where the robot stands already costs nothing to reach, and a
//    drive with time_s = 0 joins stops at one place: no turn, and the heading stays.
//  - Serving: the gun turns to the yaw and the pitch of the service, both axes at once, then
//    duration_s passes. While the body turns or drives, the gun keeps its yaw relative to the body
//    and its pitch. At first both are zero.
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
  std::uint32_t goal = 0;
  double yaw_rad = 0.0;    ///< of the gun, in the world
  double pitch_rad = 0.0;  ///< of the gun, up from the horizon
  double duration_s = 0.0;
};

struct TourProblem {
  std::size_t goals = 0;
  double heading_rad = 0.0;                    ///< at the start
  Limits turning;                              ///< of the body in place
  double yaw_rate_radps = 1.0;                 ///< of the gun relative to the body; yaw is unlimited
  double pitch_rate_radps = 1.0;               ///< of the gun
  std::vector<std::vector<Service>> services;  ///< by stop, the start first; a goal once at most
  std::vector<Drive> drives;                   ///< from row to column, row-major, services.size() squared
};

struct Visit {
  std::size_t stop = 0;
  std::vector<std::uint32_t> goals;  ///< in the order of serving, at least one
  friend bool operator==(const Visit&, const Visit&) = default;
};

struct Tour {
  std::vector<Visit> visits;
  double cost_s = 0.0;         ///< from the start to the end of the last service
  double lower_bound_s = 0.0;  ///< no tour of the given stops and services takes less
  bool proven_optimal = false;
  bool ended_early = false;      ///< the budget ended or the caller cancelled; the tour is still whole
  std::uint64_t expansions = 0;  ///< labels of the exact search
  std::uint64_t iterations = 0;  ///< of the neighbourhood search
};

/// Refuses wrong sizes, numbers that are not finite or out of range, a goal listed twice at a stop, more
/// than 4096 goals or stops, and a missing drive between stops that the start reaches (0 need not be
/// driven back to). O(stops^2 + services).
Status check(const TourProblem& problem);

/// Time of the visits under the model; infinite where a service or a drive does not exist.
/// Written apart from the solvers, to judge them. O(visits + services at the visited stops).
double cost(const TourProblem& problem, const std::vector<Visit>& visits);

/// The independent judge of a tour: every goal once, each visit with a goal, nothing that does not
/// exist, the cost as stated (to 1e-6), the bound not above it. `problem` has passed check().
Status check(const TourProblem& problem, const Tour& tour);

}  // namespace outrider
