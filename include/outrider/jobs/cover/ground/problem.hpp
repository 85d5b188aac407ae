// CoverProblem: the area that a disk robot covers, the overlap of its strips and its tracking error.
//
// The reach of the robot is the area opened by its disk: the places where the disk may stand, restricted to
// the part that is connected with the start, and everything that the disk touches from there. Corners sharper
// than the disk and gaps narrower than it are out of reach.
//
// Several areas that touch or overlap are one. Between areas that lie apart the robot may drive only if
// `transfers` says so: then over everything outside of the areas and over the areas, but never through a
// hole, which stands for an obstacle. Within an area it stays inside. With transfers every part of the
// standing room counts that such a drive comes to.
//
// A robot may carry a bar, which covers in place of its disk: a mower deck or a spray boom. The reach is then
// that of a disk as wide as the bar. The body of the robot is still a disk; neither it nor the bar may leave
// the area. The robot turns where a disk that contains both, whichever way they turn, has room: this is the
// standing room then.
//
// A robot with a turning radius drives no curve that is tighter, and turns nowhere in place. Its reach is
// that of a disk all the same: what its curves cannot cover counts as missed.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "outrider/core/options.hpp"
#include "outrider/io/map/area_frame.hpp"
#include "outrider/jobs/cover/ground/coverage.hpp"
#include "outrider/jobs/cover/ground/region.hpp"
#include "outrider/jobs/cover/strokes/track.hpp"
#include "outrider/path/visibility/polygon_ground.hpp"

namespace outrider {

inline constexpr double most_overlap = 0.9;  ///< of the width, that neighbouring strips may share

inline constexpr std::int64_t most_headland = 1000;  ///< laps

/// A polygon with holes.
struct AreaOutline {
  std::vector<Vec2> boundary;
  std::vector<std::vector<Vec2>> holes;
};

/// The tool that covers the ground.
struct CoverTool {
  std::string shape = "disk";  ///< disk: the robot itself; bar: a rectangle that is fixed to it
  double width_m = 0.0;        ///< of a bar, across the heading; 0: as wide as the robot
  double length_m = 0.1;       ///< of a bar, along the heading
  double forward_m = 0.0;      ///< of the middle of a bar, ahead of the robot's centre
};
std::vector<Option> describe(CoverTool& tool);

/// The question to a coverage planner.
struct CoverProblem {
  std::vector<Vec2> boundary;            ///< simple polygon of either orientation, m
  std::vector<std::vector<Vec2>> holes;  ///< simple polygons inside the boundary
  std::vector<AreaOutline> others = {};  ///< further areas of the same kind
  bool transfers = false;         ///< the robot may drive between areas, over the ground outside of them
  double width_m = 0.2;           ///< diameter of the robot; without a bar also the width of its strip
  CoverTool tool;                 ///< what covers the ground
  double overlap = 0.1;           ///< fraction of the width that neighbouring strips share, 0 to 0.9
  double tracking_error_m = 0.0;  ///< largest distance of the robot from its track
  double uncovered =
      0.002;  ///< fraction of the reach that may stay uncovered where only a detour would cover it
  double turning_radius_m = 0.0;  ///< least radius of a curve; 0: the robot turns in place
  bool reverse = false;           ///< a robot with a turning radius may drive backwards
  std::int64_t headland = 0;   ///< laps along every border, with a turning radius; 0: as many as turns need
  std::optional<Pose2> start;  ///< none: the robot starts where its track begins
  Pace pace;                   ///< speeds, accelerations and pauses
  AreaFrame frame = {};        ///< from these metres back to the coordinates of the file, for sentences

  /// Returns true if the robot cannot turn in place.
  [[nodiscard]] bool curves() const { return turning_radius_m > 0.0; }
  /// Returns the bar; nothing if the robot covers with its disk.
  [[nodiscard]] std::optional<Bar> bar() const;
  /// Radius of the robot.
  [[nodiscard]] double body_radius_m() const { return 0.5 * width_m; }
  /// Radius of the disk in which the robot turns, with its bar.
  [[nodiscard]] double radius_m() const;
  /// Width of the strip that is covered.
  [[nodiscard]] double strip_m() const;
  /// Distance between neighbouring strips.
  [[nodiscard]] double stride_m() const { return strip_m() * (1.0 - overlap); }
  /// Every point within this distance of the track is covered for every allowed tracking error; for a bar,
  /// every point beside a straight stroke.
  [[nodiscard]] double sure_radius_m() const { return 0.5 * strip_m() - tracking_error_m; }
};

/// Describes the numbers of the problem itself, without its polygons, tool and pace.
std::vector<Option> describe(CoverProblem& problem);

/// One of the areas that lie apart.
struct CoverField {
  std::shared_ptr<const PolygonGround> ground;  ///< exact: where laps, lanes and the moves between them stay
  Region area;
  Region standing;
  Region reach;
};

/// The areas prepared for the robot.
struct CoverageArea {
  std::shared_ptr<const PolygonGround> ground;  ///< exact: where the whole track stays
  std::vector<CoverField> fields;               ///< at least one; its ground is `ground` if it is alone
  Region area;                                  ///< the area to cover, of all fields
  Region standing;  ///< where the centre of the disk may be, connected with the start, within arc_m
  Region reach;  ///< what the disk touches from the standing room; a disk as wide as the bar, if there is one
  double arc_m = 0.0;  ///< largest distance between an arc and its chords
};

/// Prepares the area. Faults: bad_input on a polygon that crosses itself, a hole that is not inside the
/// boundary, a robot wider than every part of the area (with the widest that fits), numbers out of range, an
/// overlap too small for the tracking error (with the one that is enough), more than 10,000 strips side by
/// side, areas apart without transfers, an area in a hole of another, a tracking error or transfers with a
/// bar; start_blocked; outside_map. `where` is "boundary", "hole 2", "boundary of area 2", "hole 1 of area
/// 2", or the key.
Outcome<CoverageArea> cover_ground(const CoverProblem& problem);

}  // namespace outrider
