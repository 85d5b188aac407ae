// TurningPath: arcs of one radius and straight pieces, the motions of a robot that steers and cannot turn in
// place.
//
// dubins_paths() only drives forwards, reeds_shepp_paths() also backwards. Both return one path for each word
// (such as left, straight, right) that leads from one pose to the other, shortest first: the first is the
// shortest of all paths whose curvature is nowhere above 1 / radius, the others are for where that one meets
// an obstacle. Every path is integrated before it is returned and ends at the goal within 1e-9 of the radius
// or distance. Sources: L. E. Dubins, On curves of minimal length with a constraint on average curvature,
// American Journal of Mathematics 79 (1957); J. A. Reeds and L. A. Shepp, Optimal paths for a car that goes
// both forwards and backwards, Pacific Journal of Mathematics 145 (1990). Thread rule: pure functions. O(1).
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "outrider/geometry/pose.hpp"

namespace outrider {

/// An arc or a straight piece.
struct TurningPiece {
  int side = 0;           ///< 1: steers to the left, 0: straight, -1: steers to the right
  double length_m = 0.0;  ///< negative: backwards
};

struct TurningPath {
  std::array<TurningPiece, 5> pieces{};
  std::size_t count = 0;
  double length_m = 0.0;  ///< driven, forwards and backwards

  void add(TurningPiece piece);
};

/// Returns the pose after the piece, its heading not wrapped.
Pose2 after(const Pose2& pose, const TurningPiece& piece, double radius_m);
/// Returns the pose at the end of the path.
Pose2 end_of(const TurningPath& path, const Pose2& from, double radius_m);

/// Returns the paths that only drive forwards. `radius_m` must be above 0.
std::vector<TurningPath> dubins_paths(const Pose2& from, const Pose2& to, double radius_m);
/// Returns the paths that may drive backwards too.
std::vector<TurningPath> reeds_shepp_paths(const Pose2& from, const Pose2& to, double radius_m);

/// Returns the length of the shortest path of all, m, with reversing or without. Faster than the paths.
double shortest_turning_length(const Pose2& from, const Pose2& to, double radius_m, bool reverse);

}  // namespace outrider
