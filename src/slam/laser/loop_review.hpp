// Finds loops that were closed wrongly, from what came later.
//
// A loop is closed when the last scans are recognised at an earlier place. Two things can speak against it
// afterwards: scans taken further on, which look through what the earlier visit saw, or hit where it looked
// through; and other loops, with which it cannot be reconciled.
#pragma once

#include <optional>
#include <span>
#include <utility>

#include "laser/keyframe_graph.hpp"

namespace outrider {

/// The keyframes of a closed loop: the earlier, the later.
using KeyframePair = std::pair<std::uint32_t, std::uint32_t>;

/// Returns true if the scans since the loop disagree with those of the earlier visit on what is free.
bool is_contradicted_since(const KeyframeGraph& graph, const Pose2& robot_T_laser, const KeyframePair& loop);

/// Removes the constraint of a loop, and all between keyframes since then and older ones, and optimises.
/// Returns false, and changes nothing, if the scans contradict each other all the same: then something moved,
/// and the loop is not to blame.
bool undo_loop(KeyframeGraph& graph, const Pose2& robot_T_laser, const KeyframePair& loop);

/// Returns the constraints that are left if those that contradict most of the others and of `rivals` are
/// refused, by graduated non-convexity (graduated.hpp) over all but those between keyframes that follow each
/// other. Nothing if that is not better than to refuse the rivals. `most_chi2` is the largest plausible
/// r^T W r of a loop.
std::optional<std::vector<KeyframeConstraint>> reconciled(const KeyframeGraph& graph,
                                                          std::span<const KeyframeConstraint> rivals,
                                                          double most_chi2);

}  // namespace outrider
