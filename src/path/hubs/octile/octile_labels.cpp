#include "outrider/path/hubs/octile/octile_labels.hpp"

#include <algorithm>

#include "hubs/hub_memory.hpp"
#include "octile_index.hpp"
#include "outrider/path/grid/jps/jps.hpp"
#include "outrider/path/grid/jps/jps_plus.hpp"

namespace outrider {

std::vector<Option> describe(OctileLabelsOptions& options) {
  return {
      {"hub_memory", "MiB", 1.0, 65536.0,
       "most memory for the index; where labels do not fit, it holds landmarks, and where these do not, jps "
       "answers",
       &options.hub_memory_mib}};
}

Outcome<Plan> octile_labels(const Problem& problem, const OctileLabelsOptions& options, const Budget& budget,
                            Workspace& workspace) {
  auto query = grid_query(problem);
  if (!query) return pass_on(query);
  const GridMap& ground = query->ground;
  if (ground.model != GridModel::cells) {
    return bad_input("octile_labels takes grids of the model 'cells', not 'corners'; take hub_labels instead",
                     "planner");
  }
  constexpr std::size_t bytes_a_cell_of_jps_plus = 16;
  const std::size_t most_bytes = static_cast<std::size_t>(options.hub_memory_mib) << 20U;
  return hub_labelling::plan_by_hubs<hub_labelling::OctileIndex>(
      problem, *query, options.hub_memory_mib, budget, workspace, [&] {
        const bool fits =
            std::max(ground.frame.width, ground.frame.height) <= hub_labelling::longest_side_of_runs &&
            ground.marks.size() * bytes_a_cell_of_jps_plus <= most_bytes;
        return fits ? jps_plus(problem, {}, budget, workspace) : jps(problem, {}, budget, workspace);
      });
}

Outcome<std::string> save_octile_labels(const IndexedGround& ground, const OctileLabelsOptions& options,
                                        const Budget& budget, Workspace& workspace) {
  return hub_labelling::save_index<hub_labelling::OctileIndex>(ground.grid, options.hub_memory_mib, budget,
                                                               workspace);
}

Status load_octile_labels(const IndexedGround& ground, const StoredIndex& stored,
                          const OctileLabelsOptions& options, Workspace& workspace) {
  return hub_labelling::load_index<hub_labelling::OctileIndex>(ground.grid, stored, options.hub_memory_mib,
                                                               workspace);
}

}  // namespace outrider
