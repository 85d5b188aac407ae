// RoundedPath: straight legs with rounded corners, as closely spaced points.
//
// A corner at w, from the direction d0 to the direction d1, becomes the cubic Bezier curve with the control
// points w - a d0, w, w and w + a d1:
//   p(t) = w - a (1 - t)^3 d0 + a t^3 d1,   0 <= t <= 1.
// Its curvature is continuous and zero at both ends. It lies in the triangle of the corner, no point of the
// corner is farther from it than its middle is from w, a / 4 sin(corner / 2), and its curvature there is 8 /
// 3 sin(corner / 2) / (a cos^2(corner / 2)). a is as large as the room and half of either leg allow; the
// first and the last leg have only one corner, which may take all of them. O(points).
// Source: Farin, Curves and Surfaces for CAGD (2002), chapter 4, for the curve and its curvature.
#pragma once

#include <vector>

#include "outrider/geometry/vec.hpp"

namespace outrider {

/// A point of a path.
struct PathPoint {
  Vec2 position;
  double along_m = 0.0;      ///< length of the path up to it
  double tangent_rad = 0.0;  ///< direction of the path, continuous and not wrapped
  double curvature = 0.0;    ///< 1/m, positive to the left
};

/// Returns the path through the corners. Corner i of the inner ones is cut by at most rooms[i]; it is sharp
/// if that is 0. There are at least two corners, no two in a row are equal, and there is one room for each
/// inner corner. Points on straight parts are at most `spacing_m` apart.
std::vector<PathPoint> rounded_path(const std::vector<Vec2>& corners, const std::vector<double>& rooms,
                                    double spacing_m);

/// Returns the curve of one corner between two points, which leaves at most `share_before` and `share_after`
/// of the two legs. Its ends are the first and the last point.
std::vector<Vec2> rounded_corner(Vec2 before, Vec2 corner, Vec2 after, double room_m, double share_before,
                                 double share_after);

}  // namespace outrider
