// Is each step of a path confirmed by what was measured?
//
// A step from one keyframe to the next is confirmed by the odometry, if the two agree within the error of the
// odometry, or by the scans, if those of both keyframes show the same surfaces and fit each other best where
// the map has them, within 0.1 m and 0.05 rad. Two scans from nearly the same pose must show the same, so a
// short step needs both. A robot that was carried, or whose odometry stood still meanwhile, may be recognised
// at another place; then neither confirms the step, and a building with two places that look alike is folded
// without any scan that contradicts another one. Nor does odometry confirm a step after a minute without a
// scan, because nobody knows what it missed, or a step whose error is so large that several places within it
// may look like the one that was matched. The overlap is computed from the points themselves and not by the
// map with which scans are matched.
#pragma once

#include <vector>

#include "laser/keyframe_surfaces.hpp"
#include "outrider/slam/map/map_check.hpp"

namespace outrider {

/// Returns the share of the points of `a` that have a point of `b` within 0.15 m that faces the same way;
/// 0 if one of them has no point with a normal. O((n + m) log m) for evenly spaced points.
double share_on(const Surface& a, const Pose2& b_T_a, const Surface& b);

/// Returns the larger of the shares of two keyframes on each other, at their present poses.
double shared_surface(const KeyframeGraph& graph, KeyframeSurfaces& surfaces, std::uint32_t a,
                      std::uint32_t b);

/// Returns the steps that are not confirmed, by the numbers of their keyframes. Where a scan was released,
/// the share is that at the time of the keyframe.
std::vector<Jump> find_jumps(const KeyframeGraph& graph, KeyframeSurfaces& surfaces);

}  // namespace outrider
