// Hub labels: the shortest path in any direction looked up in an index, for many queries on one grid.
//
// From each corner of the grid the index names a few hubs, turns that lie on many shortest paths, with the
// way to each. A start and a goal that do not see each other share a hub on a shortest path between them; the
// query merges their two lists and follows the best common hub's paths to both.
//
// Complete; optimal among all paths in the model, to 1e-9 of the length, with lower_bound the cost. Takes the
// model `corners` alone. The first query makes the index, which the workspace keeps; its trees and lists take
// at most `index_mib`. Where the lists of all corners do not fit, or are too much work, those of the upper
// rows are left out, and polyanya answers what starts or ends there; where the hubs themselves do not fit, it
// answers all.
//
// On a changed ground the index of the old one answers where it is proven (hub_kept.hpp): its path is still
// free, and no shorter one can touch a cell that has become free. Else polyanya answers. Another index is
// made when more than a cell in 32 differs, or when polyanya has spent on changed grounds what making the
// index took, in expansions. Cost, bound and status are those of a new workspace, the cost to 1e-12 of
// itself, where the budget lasts for polyanya's expansions; of paths that are equally long another one may be
// found.
//
// A query takes O(labels + legs of the path + cells on the straight line), on a changed ground also O(cells
// on the path + boxes of freed cells). An expansion is a query, or one of polyanya's. Faults: those of
// grid_query(); bad_input on the model `cells`; no_path (proven at this resolution); budget_exhausted;
// cancelled. Sources: Du, Shen and Cheema, Ultrafast Euclidean shortest path computation using hub labeling
// (2023); Abraham, Delling, Goldberg and Werneck, Hierarchical hub labelings for shortest paths (2012).
#pragma once

#include "outrider/core/budget.hpp"
#include "outrider/core/options.hpp"
#include "outrider/path/plan.hpp"
#include "outrider/search/workspace.hpp"

namespace outrider {

struct HubLabelsOptions {
  std::int64_t index_mib = 512;
};
std::vector<Option> describe(HubLabelsOptions& options);

Outcome<Plan> hub_labels(const Problem& problem, const HubLabelsOptions& options, const Budget& budget,
                         Workspace& workspace);

}  // namespace outrider
