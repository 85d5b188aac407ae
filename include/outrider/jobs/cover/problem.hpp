// CoverProblem: which area a disk robot is to pass over, and with how much overlap and care.
//
// What the robot can reach is the area opened by its disk: the places where the disk may stand, of those
// the part that is connected with the start, and everything the disk touches from there. Corners that are
// sharper than the disk and gaps narrower than it are out of reach.
#pragma once

#include <memory>
#include <optional>

#include "outrider/core/options.hpp"
#include "outrider/jobs/cover/region.hpp"
#include "outrider/jobs/cover/track.hpp"
#include "outrider/path/visibility/polygon_ground.hpp"

namespace outrider {

struct CoverProblem {
  std::vector<Vec2> boundary;  ///< simple, of either orientation, m
  std::vector<std::vector<Vec2>> holes;
  double width_m = 0.2;           ///< of the robot, a disk, and of the strip that it covers
  double overlap = 0.1;           ///< part of the width that neighbouring strips share, 0 to 0.9
  double tracking_error_m = 0.0;  ///< the robot is never farther than this from its track
  double uncovered = 0.002;       ///< part of the reach that may be left where only a detour would cover it
  std::optional<Pose2> start;     ///< without one the robot starts where its track begins
  Pace pace;

  [[nodiscard]] double radius_m() const { return 0.5 * width_m; }
  /// From one strip to the next.
  [[nodiscard]] double stride_m() const { return width_m * (1.0 - overlap); }
  /// A point so near to the track is covered however the robot strays.
  [[nodiscard]] double sure_radius_m() const { return radius_m() - tracking_error_m; }
};

/// The area prepared for the robot.
struct CoverageArea {
  std::shared_ptr<const PolygonGround> ground;  ///< exact, for tracks and checks
  Region area;
  Region standing;  ///< where the centre of the disk may be, connected with the start, to arc_m
  Region reach;     ///< what the disk touches from there
  double arc_m = 0.0;
};

/// Faults: bad_input on a polygon that crosses itself, a hole that is not inside the boundary, a robot that
/// is wider than every part of the area (with the widest that fits), widths and parts out of range, an
/// overlap too small for the tracking error (with the one that is enough); start_blocked; outside_map.
/// `where` is "boundary", "hole 2", or the key.
Outcome<CoverageArea> cover_ground(const CoverProblem& problem);

}  // namespace outrider
