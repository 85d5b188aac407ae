// Hub labels: looks up the shortest path in any direction in an index, for many queries on one grid.
//
// For each corner of the grid, the index lists a few hubs (turning points that lie on many shortest paths)
// and the path to each. A start and a goal that do not see each other have a common hub on a shortest path
// between them. A query merges their two lists, finds the best common hub and follows its paths to both.
//
// Complete. Optimal among all paths in the model, to 1e-9 of the length; lower_bound is the cost. Accepts
// only the model `corners`. The first query builds the index, which the workspace keeps, in at most
// `hub_memory`. A small sample tells early whether the lists of all corners fit, with work that goes with the
// memory: some seconds for 64 MiB. Where they do not, the index holds the turns with landmarks instead
// (guided_graph.hpp), and a query is a search among the turns, exact as well. Where these do not fit, or most
// turns see more than 40 others, polyanya answers. save_hub_labels() and load_hub_labels() keep the index
// between runs.
//
// On a changed ground, the index of the old ground answers if its answer is proven (hub_kept.hpp): its path
// is still free, and no shorter path can touch a cell that has become free. Otherwise polyanya answers. The
// index is rebuilt if more than one cell in 32 differs, or when polyanya has used as much work on changed
// grounds as building the index took, in expansions. Cost, bound and status equal those of a new workspace
// (the cost to a relative 1e-12) if the budget suffices for polyanya's expansions. Of several paths of equal
// length another one may be found.
//
// With labels a query takes O(labels + legs of the path + cells on the straight line), on a changed ground
// also O(cells on the path + boxes of freed cells). An expansion is one query answered by labels, one turn of
// a search among landmarks, or one expansion of polyanya. Faults: those of grid_query(); bad_input for the
// model `cells`; no_path (proven at this resolution); budget_exhausted; cancelled.
// Sources: Du, Shen and Cheema, Ultrafast Euclidean shortest path computation using hub labeling (2023);
// Abraham, Delling, Goldberg and Werneck, Hierarchical hub labelings for shortest paths (2012); Goldberg and
// Harrelson, Computing the shortest path: A* search meets graph theory (2005).
#pragma once

#include "outrider/core/budget.hpp"
#include "outrider/core/options.hpp"
#include "outrider/path/plan.hpp"
#include "outrider/path/stored_index.hpp"
#include "outrider/search/workspace.hpp"

namespace outrider {

/// Options of hub_labels().
struct HubLabelsOptions {
  std::int64_t hub_memory_mib = 64;  ///< maximum memory of the index, MiB
};
std::vector<Option> describe(HubLabelsOptions& options);

/// Plans a path as described above.
Outcome<Plan> hub_labels(const Problem& problem, const HubLabelsOptions& options, const Budget& budget,
                         Workspace& workspace);

/// Returns the index of the ground as bytes, for load_hub_labels(); builds it if the workspace has none. The
/// ground must be of a model that hub_labels() accepts. Faults: cancelled.
Outcome<std::string> save_hub_labels(const IndexedGround& ground, const HubLabelsOptions& options,
                                     const Budget& budget, Workspace& workspace);

/// Puts an index into the workspace, for that ground and these options. Faults: bad_input with the remedy,
/// for bytes that were made for another ground, other options or another planner, or are not whole.
Status load_hub_labels(const IndexedGround& ground, const StoredIndex& stored,
                       const HubLabelsOptions& options, Workspace& workspace);

}  // namespace outrider
