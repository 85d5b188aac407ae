// TangentGraph: the legs that join the arcs of a ground.
#pragma once

#include <limits>
#include <memory>
#include <vector>

#include "outrider/core/budget.hpp"
#include "outrider/search/workspace.hpp"
#include "visibility_tangents.hpp"

namespace outrider {

/// The legs by the node that they leave; a node may wait to be looked at.
struct TangentGraph {
  static constexpr std::uint32_t unknown = std::numeric_limits<std::uint32_t>::max();

  std::shared_ptr<const PolygonGround> ground;
  std::vector<Departure> legs;
  std::vector<std::uint32_t> first;
  std::vector<std::uint32_t> count;
  std::uint64_t tests = 0;

  void begin(const std::shared_ptr<const PolygonGround>& on);
  void look_round(Node node);
  /// All legs at once, a row for each node; sorts each by where its legs lead.
  void take(std::vector<std::vector<Departure>> rows);
};

/// How the graph comes to be: by a sweep round each arc, by pairs, or by a sweep when it is asked for.
enum class TangentForm { swept, paired, implicit };

/// The graph of this ground, kept in the workspace from the last query when that was on it too. Wall time
/// and cancellation are heeded; building counts no expansions.
Outcome<TangentGraph*> tangent_graph(const std::shared_ptr<const PolygonGround>& ground, TangentForm form,
                                     const Budget& budget, Workspace& workspace);

}  // namespace outrider
