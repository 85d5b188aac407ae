// The label search of routes.hpp: from one place to all others.
#pragma once

#include <span>
#include <vector>

#include "outrider/core/budget.hpp"
#include "outrider/path/routes/routes.hpp"
#include "routes_graph.hpp"

namespace outrider::routes {

inline constexpr std::uint32_t no_label = 0xffffffffU;

/// A node and the label from which its best known arrival came.
struct Step {
  std::uint32_t node = 0;
  std::uint32_t before = no_label;
};

/// The result of a search for one target.
struct Arrival {
  Drive drive;
  std::uint32_t last = no_label;  ///< the step before the last leg; no_label for a direct leg
};

struct RouteTree {
  std::vector<Step> steps;
  std::vector<Arrival> arrivals;  ///< by target
};

struct RouteQuery {
  std::span<const SightLine> nodes;   ///< lines of sight from the start to nodes
  std::span<const SightLine> direct;  ///< lines of sight from the start to targets
  std::uint32_t first_target = 0;     ///< earlier targets are ignored
  std::uint32_t targets = 0;          ///< number of targets
};

/// Runs the search. `node_lines` lead from node to node, `target_lines` from node to target. Returns false if
/// the meter refused.
bool search_routes(const RobotModel& robot, const SightLines& node_lines, const SightLines& target_lines,
                   const RouteQuery& query, BudgetMeter& meter, RouteTree& tree);

/// Returns the nodes of the path to a target, in the order of driving.
std::vector<std::uint32_t> nodes_to(const RouteTree& tree, std::uint32_t target);

}  // namespace outrider::routes
