// The cheapest path along the eight moves on ground that costs more in some cells, looked up in an index.
//
// For each free cell the index lists hubs, cells that many cheapest paths pass, with the cost from the cell
// to the hub and the first move. Any two connected cells share a hub on a cheapest path between them, so a
// query compares two lists and then follows the moves. Answers are those of terrain_a_star(): the same cost,
// to 1e-9 of it, maybe another one of equally cheap paths.
//
// Complete and optimal among paths along the eight moves of the grid; lower_bound is the cost. Accepts only
// the model `cells`. The first query on a ground and its costs builds the index in the workspace, in at most
// `hub_memory_mib`; the work is limited too, to some seconds for 64 MiB. 64 MiB hold
// some 40,000 free cells of rooms and corridors, and 10,000 to 20,000 of open ground. If it does not fit,
// terrain_a_star() answers, and Plan::remark says so. If at most one cell in 32 changes, terrain_a_star()
// answers too, until it has done as much work as building the index took; then, and if more changes, the
// index is built again. save_terrain_labels() and load_terrain_labels() keep it between runs. Of the budget
// an answer from the index counts as one expansion; building it is not counted, but can be cancelled. A query
// takes O(length of the two lists + moves of the path * log(length of a list)). Faults: those of
// terrain_a_star(). Sources: Akiba, Iwata and Yoshida, Fast exact shortest-path distance queries on large
// networks by pruned landmark labeling (2013); George, Nested dissection of a regular finite element mesh
// (1973), for the order of the hubs.
#pragma once

#include "outrider/core/budget.hpp"
#include "outrider/core/options.hpp"
#include "outrider/path/plan.hpp"
#include "outrider/path/stored_index.hpp"
#include "outrider/search/workspace.hpp"

namespace outrider {

/// Options of terrain_labels().
struct TerrainLabelsOptions {
  std::int64_t hub_memory_mib = 64;  ///< maximum memory of the index, MiB
};
std::vector<Option> describe(TerrainLabelsOptions& options);

/// Plans a path as described above.
Outcome<Plan> terrain_labels(const Problem& problem, const TerrainLabelsOptions& options,
                             const Budget& budget, Workspace& workspace);

/// Returns the index of the ground and its costs as bytes, for load_terrain_labels(); builds it if the
/// workspace has none. The grid must be of the model `cells`, and the costs those of its frame. Faults:
/// cancelled.
Outcome<std::string> save_terrain_labels(const IndexedGround& ground, const TerrainLabelsOptions& options,
                                         const Budget& budget, Workspace& workspace);

/// Puts an index into the workspace, for that ground, its costs and these options. Faults: bad_input with the
/// remedy, for bytes that were made for another ground, other costs or options or another planner, or are not
/// whole. O(entries * log(length of a list)).
Status load_terrain_labels(const IndexedGround& ground, const StoredIndex& stored,
                           const TerrainLabelsOptions& options, Workspace& workspace);

}  // namespace outrider
