// Octile labels: looks up the shortest path along the eight moves in an index, for many queries on one grid.
//
// A shortest path along the moves needs to turn only at subgoals: cells at a convex corner of the blocked
// cells. For each free cell, the index lists a few hubs (subgoals that lie on many shortest paths) and the
// path to each. A start and a goal that are not joined by a diagonal run and then a straight one have a
// common hub on a shortest path between them. A query merges their two lists, finds the best common hub and
// follows its paths to both.
//
// Complete and optimal among paths along the eight moves of the grid; lengths are kept exactly as m + sqrt(2)
// n cells, and lower_bound is the cost. Accepts only the model `cells`. The first query builds the index,
// which the workspace keeps, in at most `hub_memory`. A small sample tells early whether the lists of all
// cells fit, with work that goes with the memory: some seconds for 64 MiB. Where they do not, or a path to a
// hub has more than 65535 straight or diagonal moves, the index holds the subgoals with landmarks instead
// (guided_graph.hpp), and a query is a search among the subgoals, exact as well. Where these do not fit, most
// subgoals reach more than 40 others, the runs take more than half, or a side is longer than 32767 cells,
// jps_plus answers if its distances fit into `hub_memory`, else jps. save_octile_labels() and
// load_octile_labels() keep the index between runs.
//
// On a changed ground, the index of the old ground answers if its answer is proven (hub_kept.hpp): its path
// is still free, and no shorter path can touch a cell that has become free. Otherwise jps_plus (or jps)
// answers. The index is rebuilt if more than one cell in 32 differs, or when jps_plus has used as much work
// on changed grounds as building the index took, in expansions. Cost, bound and status equal those of a new
// workspace if the budget suffices for the expansions of jps_plus. Of several paths of equal length another
// one may be found.
//
// With labels a query takes O(labels + legs of the path), on a changed ground also O(cells on the path +
// boxes of freed cells). An expansion is one query answered by labels, one subgoal of a search among
// landmarks, or one expansion of jps_plus. Faults: those of grid_query(); bad_input for the model `corners`;
// no_path (proven at this resolution); budget_exhausted; cancelled.
// Sources: Uras, Koenig and Hernandez, Subgoal graphs for optimal pathfinding in eight-neighbor grids (2013);
// Abraham, Delling, Goldberg and Werneck, Hierarchical hub labelings for shortest paths (2012); Goldberg and
// Harrelson, Computing the shortest path: A* search meets graph theory (2005).
#pragma once

#include "outrider/core/budget.hpp"
#include "outrider/core/options.hpp"
#include "outrider/path/plan.hpp"
#include "outrider/path/stored_index.hpp"
#include "outrider/search/workspace.hpp"

namespace outrider {

/// Options of octile_labels().
struct OctileLabelsOptions {
  std::int64_t hub_memory_mib = 64;  ///< maximum memory of the index, MiB
};
std::vector<Option> describe(OctileLabelsOptions& options);

/// Plans a path as described above.
Outcome<Plan> octile_labels(const Problem& problem, const OctileLabelsOptions& options, const Budget& budget,
                            Workspace& workspace);

/// Returns the index of the ground as bytes, for load_octile_labels(); builds it if the workspace has none.
/// The ground must be of a model that octile_labels() accepts. Faults: cancelled.
Outcome<std::string> save_octile_labels(const IndexedGround& ground, const OctileLabelsOptions& options,
                                        const Budget& budget, Workspace& workspace);

/// Puts an index into the workspace, for that ground and these options. Faults: bad_input with the remedy,
/// for bytes that were made for another ground, other options or another planner, or are not whole.
Status load_octile_labels(const IndexedGround& ground, const StoredIndex& stored,
                          const OctileLabelsOptions& options, Workspace& workspace);

}  // namespace outrider
