// Setbacks: drives that end before their goal, and a gun that does not shoot.
//
// CutDrives: the robot measures where it is. If a drive ended elsewhere it drives on from there. If it then
// does not get away from the same place, it takes something to stand right ahead and drives around that; if
// that does not help either, it waits for 10 s, tries once more, and goes on to what it can do from where it
// is. After 12 such drives from one place it tries each further drive once. A robot that looked for other
// ways itself and gave up goes on at once; after four such drives within 1 m it stays for a minute, does what
// it can from there, and then tries one more.
//
// GunSilence: tells a gun that does not shoot from shots that miss. Nothing comes of a shot of a jammed gun
// or an empty tank. One shot without a result is tried again, and so is a target; but a gun of which nothing
// has come for long enough, whatever it was aimed at, does not shoot. A jam that ends sooner than that costs
// no target. O(log targets) a shot.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "outrider/geometry/pose.hpp"
#include "outrider/robot/command.hpp"
#include "outrider/robot/observation.hpp"

namespace outrider {

struct GuardProblem;

struct CutDrives {
  bool driving = false;         ///< the last command was a drive to the present task
  std::int64_t all = 0;         ///< drives that ended elsewhere
  std::int64_t here = 0;        ///< how many of the last of them ended at the same place
  std::int64_t in_place = 0;    ///< the same, also over what it has gone on to
  Vec2 place;                   ///< that place
  double stays_until_s = 0.0;   ///< until then it does not drive
  std::vector<Vec2> obstacles;  ///< what the robot takes to stand in its way: their middles
};

/// The next step after a drive.
enum class AfterDrive { go_on, drive_again, wait };

/// How far the robot keeps from the middles of the obstacles, m.
double obstacle_gap_m(const GuardProblem& problem);

/// Returns the reason to add if drives were given up; else an empty text.
std::string why_held_up(const CutDrives& cut);

/// The shots in a row of which no result came.
struct GunSilence {
  int shots = 0;
  std::set<std::size_t> targets;  ///< at which they were aimed
  double since_s = 0.0;           ///< when the first of them was found to have no result

  /// Notes what came of a shot at a target, or that nothing did.
  void note(std::size_t target, bool has_result, double time_s);

  /// Returns why the gun is not to be tried any more; empty if it is. That is after at least 6 shots without
  /// a result at 2 or more targets, the first at least 30 s ago.
  [[nodiscard]] std::string verdict(double time_s) const;
};

}  // namespace outrider
