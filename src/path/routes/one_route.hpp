// The label search of routes.hpp from one place to one other.
#pragma once

#include <vector>

#include "outrider/core/budget.hpp"
#include "outrider/geometry/pose.hpp"
#include "outrider/motion/robot_model.hpp"
#include "outrider/world/collision_map.hpp"
#include "routes_graph.hpp"

namespace outrider::routes {

/// The nodes of a ground with what they see of each other.
struct NodeGraph {
  const CollisionMap& ground;
  const RobotModel& robot;
  const std::vector<Node>& nodes;
  const SightLines& lines;
};

/// Returns the waypoints of the fastest route on the graph, with the turn before it; none if there is no
/// route. Faults: those of the budget.
///
/// A* over pairs (node, heading). The bound is the straight drive to the goal, which is consistent as a drive
/// takes no longer than its parts with a halt between them. Legs from the start and to the goal are tested
/// only when one is the most promising, so that O(nodes) are looked at and few tested.
Outcome<std::vector<Vec2>> one_route(const NodeGraph& graph, const Pose2& start, Vec2 goal,
                                     BudgetMeter& meter);

}  // namespace outrider::routes
