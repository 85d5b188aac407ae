// TangentGraph: the legs that join the arcs of a ground.
#pragma once

#include <limits>
#include <memory>
#include <vector>

#include "outrider/core/budget.hpp"
#include "outrider/search/workspace.hpp"
#include "visibility_tangents.hpp"

namespace outrider {

/// The legs by their first node; the legs of a node may be still unknown.
struct TangentGraph {
  static constexpr std::uint32_t unknown = std::numeric_limits<std::uint32_t>::max();

  std::shared_ptr<const PolygonGround> ground;
  std::vector<Departure> legs;
  std::vector<std::uint32_t> first;
  std::vector<std::uint32_t> count;
  std::uint64_t tests = 0;

  void begin(const std::shared_ptr<const PolygonGround>& on);
  void look_round(Node node);
  /// Sets all legs, one row per node, and sorts each row by the nodes to which its legs lead.
  void take(std::vector<std::vector<Departure>> rows);
};

/// The construction of the graph: by a sweep around each arc, by pairs, or by a sweep when a node is needed.
enum class TangentForm { swept, paired, implicit };

/// Returns the graph of this ground. The workspace keeps it for later queries on the same ground. Observes
/// wall time and cancellation; building counts no expansions.
Outcome<TangentGraph*> tangent_graph(const std::shared_ptr<const PolygonGround>& ground, TangentForm form,
                                     const Budget& budget, Workspace& workspace);

}  // namespace outrider
