// The places that an exploration leaves over, and the reasons.
//
// A frontier is left over if at least least_left_m2 of unknown area would be seen from it, if it is at least
// least_opening_m wide itself, and if some way over known free cells leads to it, however narrow. A smaller
// one is a gap that noise has left in a wall. The reason is the first that holds: the robot has touched
// something there; the way is too narrow; going there failed; looking at it showed nothing; there is no way;
// the exploration ended before. An exploration is complete if nothing is left over but what lies behind gaps
// that are too narrow.
//
// Areas are upper estimates: unknown cells within the range of the laser of a frontier that no occupied cell
// hides from it. Each cell counts for one frontier only.
#pragma once

#include <string>
#include <vector>

#include "outrider/jobs/explore/choose/decide.hpp"

namespace outrider {

/// The reason why a place is left over.
enum class LeftReason : std::uint8_t { narrow, touched, no_way, failed, not_seen, not_tried };
/// Returns the reason in a few words: "too narrow", "touched there", ...
std::string_view to_string(LeftReason reason);

/// A frontier that is left over.
struct LeftOver {
  std::uint32_t frontier = 0;  ///< id
  Vec2 place;                  ///< its centroid
  LeftReason reason = LeftReason::not_tried;
  double width_m = 0.0;  ///< of the narrowest place on the way there; 0 unless too narrow
  Vec2 narrowest;        ///< that place
  double area_m2 = 0.0;  ///< unknown area that would be seen from the frontier, without that of others
  std::string sentence;  ///< the reason, with numbers
};

/// Places of narrow ways this near to each other are one.
inline constexpr double same_place_m = 0.4;

/// A place where the robot does not fit, as it found out there.
struct NarrowPlace {
  Vec2 place;
  double width_m = 0.0;  ///< measured from near, where `measured`
  bool measured = false;
  int tries = 0;  ///< how often the robot got stuck there
};

/// A way on which the robot may fit although the map leaves it no room: the cells of the map are too coarse
/// to tell.
struct NarrowWay {
  std::uint32_t frontier = 0;
  std::vector<Vec2> points;  ///< from drivable ground to the frontier
  Vec2 narrowest;
};

/// The result of left_over().
struct LeftOvers {
  std::vector<LeftOver> places;        ///< by the id of the frontier
  std::vector<NarrowWay> worth_a_try;  ///< to some of these places, the roomiest first

  [[nodiscard]] double area_m2() const;
  /// Returns a sentence: "left over: up to 12.3 m2, because: ...", with how many places each reason holds of.
  /// The robot enters a gap that is `wanted_m` wide.
  [[nodiscard]] std::string sentence(double wanted_m) const;
  /// Returns the same of places that all lie behind narrow gaps: "up to 12.3 m2 lie behind 1 gap, ...".
  [[nodiscard]] std::string behind_gaps(double wanted_m) const;
};

/// Returns the width of the narrowest gap that the robot enters.
double wanted_width_m(const RobotModel& robot, const ExploreOptions& options);

/// Judges the frontiers that a decision has refused; `others` have not been tried. `narrow` are the places
/// that the robot knows to be too narrow. O(cells log cells).
LeftOvers left_over(const ExploreState& state, const ExploreOptions& options,
                    const std::vector<RefusedFrontier>& refused, bool others,
                    const std::vector<NarrowPlace>& narrow);

/// Takes out and returns the places behind gaps that are too narrow, as was measured from near, or as the map
/// shows though its walls may be drawn too thick.
LeftOvers take_behind_gaps(LeftOvers& left, const std::vector<NarrowPlace>& narrow);

}  // namespace outrider
