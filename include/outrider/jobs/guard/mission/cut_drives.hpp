// CutDrives: what a guard robot makes of drives that end before their goal.
//
// The robot measures where it is. If a drive ended elsewhere it drives on from there. If it then does not get
// away from the same place, it takes something to stand right ahead and drives around that; if that does not
// help either, it waits for 10 s, tries once more, and goes on to what it can do from where it is. After 12
// such drives from one place it tries each further drive once.
#pragma once

#include <cstdint>
#include <optional>
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
  std::vector<Vec2> obstacles;  ///< what the robot takes to stand in its way: their middles
};

/// The next step after a drive.
enum class AfterDrive { go_on, drive_again, wait };

/// How far the robot keeps from the middles of the obstacles, m.
double obstacle_gap_m(const GuardProblem& problem);

/// Returns the reason to add if drives were given up; else an empty text.
std::string why_held_up(const CutDrives& cut);

}  // namespace outrider
