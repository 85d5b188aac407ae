// The parts of the execution of an exploration: where it goes next, and how it drives there.
#pragma once

#include <string>

#include "outrider/jobs/explore/mission.hpp"

namespace outrider {

inline constexpr double arrived_m = 0.03;  ///< of the end of a path
inline constexpr double nearby_m = 0.9;    ///< within which obstacles are kept in sight

void add_event(ExploreMission& mission, std::string kind, std::string text);
/// Ends the mission.
void end(ExploreMission& mission, std::string stop_reason, std::string reason);
ExploreState state_of(ExploreMission& mission);
/// Counts as progress.
void moved_on(ExploreMission& mission);
/// Follows the points from now on.
void follow(ExploreMission& mission, std::vector<Vec2> points);

/// Returns true if nothing new was seen for longer than it takes to drive to and fro on the map.
bool sees_nothing_new(const ExploreMission& mission);
/// Decides where to go, and finds the way there, or ends the mission.
void decide_anew(ExploreMission& mission);

/// Returns the twist that drives the robot along its path; decides anew when that is due.
Twist2 drive(ExploreMission& mission);

/// Notes that the bumper was pressed.
void note_touch(ExploreMission& mission, const Observation& seen);
/// Brings the marks on the ground up to date: the driven trail, and what was touched.
void mark_ground(ExploreMission& mission);
/// Opens the roomiest way that is worth a try. Returns false if there is none.
bool open_narrow_way(ExploreMission& mission, const LeftOvers& left);
/// Notes that the robot does not fit through the gap ahead, as far as it knows its width.
void note_too_narrow(ExploreMission& mission, bool measured);

}  // namespace outrider
