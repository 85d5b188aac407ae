// A drive that covers an area with the navigator: around what stands there and who walks there, and back to
// what was left out.
#pragma once

#include <functional>
#include <string>

#include "outrider/job/watch.hpp"
#include "outrider/jobs/cover/mission/orders.hpp"
#include "outrider/log/log.hpp"
#include "outrider/sim/bodies/piece_body.hpp"
#include "outrider/sim/navigation.hpp"

namespace outrider {

/// A simulated drive, and what it came to.
struct NavigatedCover {
  PieceDrive drive;       ///< the true way; no pieces
  bool finished = false;  ///< nobody stopped it
  bool believed_complete = false;
  std::string reason;            ///< why the robot ended before that
  std::int64_t contacts = 0;     ///< that its own motion made
  std::int64_t walked_into = 0;  ///< people who walked into it
  std::size_t left_ground = 0;   ///< how often its disk came out of the area
  int rounds = 0;                ///< how often it planned what was left
  std::int64_t recoveries = 0;   ///< most in a row
  double left_m2 = 0.0;          ///< that it knows of
  double blocked_s = -1.0;       ///< when a post was put in its way; -1 if none was
  Region reach;            ///< area that a robot can cover that keeps its room from all that stands there
  Coverage driven;         ///< coverage of that area by the drive
  double missed_m2 = 0.0;  ///< missed of that area, without_specks()
};

/// Returns the problem of the part of the area in which a robot that is beside its track by no more than its
/// tracking error does not come out of the area. Where that falls apart, it is the part with the start, or
/// the largest. Fault: bad_input if there is none.
Outcome<CoverProblem> kept_inside(const CoverProblem& problem);

/// Returns the room that the robot keeps from what it sees, m.
double rim_of(const NavigationOptions& options);

/// Drives the plan of kept_inside(problem) in a world whose walls are the edges of the area of the problem
/// and in which the things stand (`things` as in add_things(), in the coordinates of the area's file). The
/// robot is a disk on two wheels at the pace of the problem. `look` receives the drive so far. Faults: those
/// of add_things() and Navigator::make(); cancelled while it measures what was covered.
Outcome<NavigatedCover> drive_with_navigator(const CoverProblem& problem, const CoverMethod& method,
                                             const CoverOptions& options, const CoverPlan& plan,
                                             const NavigationOptions& navigation, const std::string& things,
                                             std::uint64_t seed, Log& log, const RunWatch& watch,
                                             const std::function<void(const PieceDrive&)>& look);

}  // namespace outrider
