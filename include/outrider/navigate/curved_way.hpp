// A way for a robot that steers like a car, around what stands on the ground of a navigator.
//
// Hybrid A* (hybrid_a_star.hpp) on the cells of the ground, with curves a tenth wider than the robot's
// tightest, so that whoever follows them can still steer to either side. The robot is its footprint, exact to
// a cell. The first search wants room beside the robot; where that finds nothing, a second one takes ways on
// which it just fits. Start and goal may have less room than the rest. Each search has a
// bounded number of expansions, so a way may be missed in a large maze, or where it takes many turns.
//
// Faults: start_blocked, goal_blocked if something stands there; no_path if not even a point gets there;
// budget_exhausted if no curves were found, though a point gets there. O(cells + obstacles * cells near them
// + n log n) for n expansions. Thread rule: one workspace per thread.
#pragma once

#include <optional>

#include "outrider/core/outcome.hpp"
#include "outrider/navigate/goal_field.hpp"
#include "outrider/navigate/track_follower.hpp"
#include "outrider/search/workspace.hpp"

namespace outrider {

/// The ends of a curved way, and the room that it keeps.
struct CurveQuery {
  Pose2 start;
  Vec2 goal;
  double within_m = 0.1;                   ///< the way may end so far from the goal, where that is not free
  std::optional<double> heading_rad = {};  ///< at the goal; nothing: any
  double wide_m = 0.3;                     ///< room beside the robot that is wanted
  double margin_m = 0.03;                  ///< the least room
};

/// Plans a way of curves and straight pieces, ahead and backwards. It is empty if the robot is there.
Outcome<TrackPieces> plan_curved_way(const GoalGround& ground, const Footprint& footprint,
                                     const RobotModel& robot, const CurveQuery& query, Workspace& workspace);

}  // namespace outrider
