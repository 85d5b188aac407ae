#include "outrider/path/hubs/terrain_labels.hpp"

#include <fmt/format.h>

#include <limits>

#include "grid/terrain_query.hpp"
#include "grid/terrain_refine.hpp"
#include "outrider/path/grid/terrain_a_star.hpp"
#include "terrain_index.hpp"

namespace outrider {
namespace hub_labelling {
namespace {

/// The ground and the costs for which an index was made, or which were asked last.
struct Terrain {
  std::shared_ptr<const GridMap> ground;
  std::shared_ptr<const CellCosts> costs;

  /// Returns true if both are the same, if need be cell by cell.
  [[nodiscard]] bool same(const Terrain& other) const {
    if (ground == nullptr || other.ground == nullptr) return false;
    if ((costs == nullptr) != (other.costs == nullptr)) return false;
    const bool same_costs = costs == other.costs || costs->per_m.cells == other.costs->per_m.cells;
    const bool same_ground = ground == other.ground ||
                             (ground->frame == other.ground->frame && ground->marks == other.ground->marks);
    return same_costs && same_ground;
  }
};

struct TerrainMemory {
  Terrain made_for;
  std::int64_t mib = 0;
  std::unique_ptr<const TerrainIndex> index;  ///< none if it does not fit
  std::uint64_t spent = 0;                    ///< expansions of searches on other terrain since then

  /// An expansion costs about as much as so many entries visited.
  static constexpr std::uint64_t entries_an_expansion = 32;

  /// Returns true if the index is that of the terrain. Builds it the first time, and when searches on other
  /// terrain have taken as much work. After a cancelled build there is none, as if nothing had been asked.
  bool renew(const Terrain& now, std::int64_t most_mib, const std::stop_token& stop) {
    if (mib == most_mib && made_for.same(now)) {
      made_for = now;
      return true;
    }
    const bool early = index != nullptr && mib == most_mib && spent * entries_an_expansion < index->work();
    if (early) return false;
    index = TerrainIndex::of(*now.ground, now.costs.get(), static_cast<std::size_t>(most_mib) << 20U, stop);
    made_for = stop.stop_requested() ? Terrain{} : now;
    mib = most_mib;
    spent = 0;
    return true;
  }
};

/// Searches, and says why there is no other way.
Outcome<Plan> search(const Problem& problem, const Budget& budget, Workspace& workspace, std::string remark) {
  auto plan = terrain_a_star(problem, {}, budget, workspace);
  if (plan) plan->remark = std::move(remark);
  return plan;
}

}  // namespace
}  // namespace hub_labelling

std::vector<Option> describe(TerrainLabelsOptions& options) {
  return {{"hub_memory", "MiB", 1.0, 65536.0,
           "most memory for the index; where it does not fit, terrain_a_star answers",
           &options.hub_memory_mib}};
}

Outcome<Plan> terrain_labels(const Problem& problem, const TerrainLabelsOptions& options,
                             const Budget& budget, Workspace& workspace) {
  auto query = terrain_query(problem, "terrain_labels");
  if (!query) return pass_on(query);
  BudgetMeter meter(budget);
  if (!meter.spend()) return meter.refusal();
  auto& memory = workspace.get<hub_labelling::TerrainMemory>();
  const bool ready = memory.renew({problem.grid, problem.costs}, options.hub_memory_mib, budget.stop);
  if (budget.stop.stop_requested()) return meter.refusal();
  if (!ready) {
    auto plan =
        hub_labelling::search(problem, budget, workspace,
                              "terrain_a_star answers, since the ground has changed; the index is made "
                              "again once the searches have cost as much");
    if (plan) memory.spent += plan->counters.expansions;
    return plan;
  }
  if (memory.index == nullptr) {
    return hub_labelling::search(
        problem, budget, workspace,
        fmt::format("terrain_a_star answers, since the labels of {} x {} cells do not fit into {} MiB; give "
                    "more hub_memory, or a coarser map",
                    query->ground.frame.width, query->ground.frame.height, options.hub_memory_mib));
  }
  const auto way = memory.index->find(query->ground, query->start, query->goal);
  if (way.empty()) return fault(FaultCode::no_path, "nothing joins the start and the goal");
  if (workspace.trace != nullptr) {
    const std::uint32_t start = query->ground.index(query->start);
    const double cost = path_cost(problem.costs.get(), way);
    workspace.trace->record({start, start, cost, 0.0, cost});
  }
  return priced_plan(problem, way, std::numeric_limits<double>::infinity(), {meter.spent(), 0, 0});
}

}  // namespace outrider
