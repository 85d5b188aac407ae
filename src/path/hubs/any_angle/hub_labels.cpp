#include "outrider/path/hubs/any_angle/hub_labels.hpp"

#include "any_angle_index.hpp"
#include "hubs/hub_memory.hpp"
#include "outrider/path/mesh/polyanya/polyanya.hpp"

namespace outrider {

std::vector<Option> describe(HubLabelsOptions& options) {
  return {{"hub_memory", "MiB", 1.0, 65536.0,
           "most memory for the index; where labels do not fit, it holds landmarks, and where these do not, "
           "polyanya answers",
           &options.hub_memory_mib}};
}

Outcome<Plan> hub_labels(const Problem& problem, const HubLabelsOptions& options, const Budget& budget,
                         Workspace& workspace) {
  auto query = grid_query(problem);
  if (!query) return pass_on(query);
  if (query->ground.model != GridModel::corners) {
    return bad_input("hub_labels takes grids of the model 'corners', not 'cells'; take octile_labels instead",
                     "planner");
  }
  return hub_labelling::plan_by_hubs<hub_labelling::AnyAngleIndex>(
      problem, *query, options.hub_memory_mib, budget, workspace,
      [&] { return polyanya(problem, {}, budget, workspace); });
}

Outcome<std::string> save_hub_labels(const IndexedGround& ground, const HubLabelsOptions& options,
                                     const Budget& budget, Workspace& workspace) {
  return hub_labelling::save_index<hub_labelling::AnyAngleIndex>(ground.grid, options.hub_memory_mib, budget,
                                                                 workspace);
}

Status load_hub_labels(const IndexedGround& ground, const StoredIndex& stored,
                       const HubLabelsOptions& options, Workspace& workspace) {
  return hub_labelling::load_index<hub_labelling::AnyAngleIndex>(ground.grid, stored, options.hub_memory_mib,
                                                                 workspace);
}

}  // namespace outrider
