// Footprint: the area that a robot covers on the ground, in its own frame: a convex polygon, a disk, or both
// (a polygon with round corners).
#pragma once

#include <string>

#include "outrider/core/outcome.hpp"
#include "outrider/geometry/convex.hpp"
#include "outrider/geometry/pose.hpp"

namespace outrider {

class Footprint {
 public:
  /// Makes the footprint of a shape that passes check_footprint().
  explicit Footprint(RoundedPolygon shape);
  /// Makes a disk about the origin.
  static Footprint disk(double radius_m);

  [[nodiscard]] const RoundedPolygon& shape() const { return shape_; }
  /// Returns the radius of the largest disk about the origin that the footprint contains.
  [[nodiscard]] double inner_m() const { return inner_m_; }
  /// Returns the radius of the smallest disk about the origin that contains the footprint.
  [[nodiscard]] double outer_m() const { return outer_m_; }
  /// Returns the distance from a point in the frame of the robot to the footprint, m; 0 or negative inside.
  /// Exact; O(corners).
  [[nodiscard]] double gap_m(Vec2 point) const { return signed_distance(point, shape_); }
  /// Returns the distance from the footprint of a robot at a pose to a thing, m; negative if they overlap.
  /// Exact where it is positive; O(corners of one * corners of the other).
  [[nodiscard]] double gap_m(const Pose2& pose, const RoundedPolygon& thing) const;

 private:
  RoundedPolygon shape_;
  double inner_m_ = 0.0;
  double outer_m_ = 0.0;
};

/// Checks that a footprint is convex, counter-clockwise, finite, has at most 32 corners and contains the
/// origin. Fault: bad_input, which names the corner.
Status check_footprint(const RoundedPolygon& shape);

/// Reads a footprint: corners "x,y" in metres, counter-clockwise, separated by blanks; or one number, the
/// radius of a disk. Faults: bad_input for anything else, and those of check_footprint().
Outcome<RoundedPolygon> parse_footprint(const std::string& text);

}  // namespace outrider
