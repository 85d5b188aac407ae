#include "outrider/path/hubs/terrain_labels.hpp"

#include <fmt/format.h>

#include <limits>

#include "grid/terrain/terrain_query.hpp"
#include "grid/terrain/terrain_refine.hpp"
#include "outrider/path/grid/terrain/terrain_a_star.hpp"
#include "terrain_index.hpp"

namespace outrider {
namespace hub_labelling {
namespace {

/// The ground and the costs for which an index was made, or which were asked last.
struct Terrain {
  std::shared_ptr<const GridMap> ground;
  std::shared_ptr<const CellCosts> costs;

  /// Returns how many cells differ in what they cost or in being blocked; all for other frames.
  [[nodiscard]] std::size_t differing(const Terrain& other) const {
    if (ground == other.ground && costs == other.costs) return 0;
    const bool alike = ground != nullptr && other.ground != nullptr && ground->frame == other.ground->frame;
    if (!alike) return std::numeric_limits<std::size_t>::max();
    std::size_t count = 0;
    for (std::size_t i = 0; i < ground->frame.size(); ++i) {
      const Cell c = ground->frame.cell(i);
      count += ground->blocked(c) != other.ground->blocked(c) || price(c) != other.price(c) ? 1 : 0;
    }
    return count;
  }

 private:
  [[nodiscard]] float price(Cell c) const { return costs == nullptr ? 1.0F : costs->per_m[c]; }
};

struct TerrainMemory {
  Terrain made_for;
  Terrain asked;                              ///< the last one
  std::size_t differ = 0;                     ///< cells in which the two differ
  std::int64_t mib = 0;                       ///< 0: nothing has been asked
  std::shared_ptr<const void> stored;         ///< keeps the bytes to which a loaded index refers
  std::unique_ptr<const TerrainIndex> index;  ///< none if it does not fit
  std::uint64_t spent = 0;                    ///< expansions of searches on other terrain since then

  /// An expansion costs about as much as so many entries visited.
  static constexpr std::uint64_t entries_an_expansion = 32;

  /// Returns true if the index is that of the terrain. Builds it for terrain that is new or very different,
  /// and when searches on similar terrain have taken as much work. After a cancelled build there is none, as
  /// if nothing had been asked.
  bool renew(const Terrain& now, std::int64_t most_mib, const std::stop_token& stop) {
    if (mib == most_mib) {
      if (!(asked.ground == now.ground && asked.costs == now.costs)) differ = made_for.differing(now);
      asked = now;
      if (differ == 0) return true;
      const bool similar = differ <= now.ground->frame.size() / 32;
      if (similar && index != nullptr && spent * entries_an_expansion < index->work()) return false;
    }
    make(now, most_mib, stop);
    return true;
  }

  /// Builds the index; without one after a cancelled build.
  void make(const Terrain& now, std::int64_t most_mib, const std::stop_token& stop) {
    auto made =
        TerrainIndex::of(*now.ground, now.costs.get(), static_cast<std::size_t>(most_mib) << 20U, stop);
    const bool whole = !stop.stop_requested();
    take(whole ? now : Terrain{}, whole ? most_mib : 0, std::move(made), nullptr);
  }

  /// Takes an index that was made for that terrain.
  void take(const Terrain& now, std::int64_t most_mib, std::unique_ptr<const TerrainIndex> made,
            std::shared_ptr<const void> bytes) {
    index = std::move(made);
    stored = std::move(bytes);
    made_for = asked = now;
    mib = most_mib;
    differ = 0;
    spent = 0;
  }
};

/// For what an index is made.
IndexKey key_of(const IndexedGround& ground, const TerrainLabelsOptions& options) {
  return {"terrain_labels", fmt::format("hub_memory {}", options.hub_memory_mib), *ground.grid,
          ground.costs.get()};
}

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

Outcome<std::string> save_terrain_labels(const IndexedGround& ground, const TerrainLabelsOptions& options,
                                         const Budget& budget, Workspace& workspace) {
  auto& memory = workspace.get<hub_labelling::TerrainMemory>();
  const bool made = memory.mib == options.hub_memory_mib && memory.made_for.ground == ground.grid &&
                    memory.made_for.costs == ground.costs;
  if (!made) memory.make({ground.grid, ground.costs}, options.hub_memory_mib, budget.stop);
  if (memory.mib == 0) return BudgetMeter(budget).refusal();
  hub_labelling::IndexWriter writer;
  if (memory.index == nullptr) {
    writer.number(static_cast<std::uint64_t>(hub_labelling::IndexKind::none));
  } else {
    memory.index->write(writer);
  }
  return std::move(writer).finish(hub_labelling::key_of(ground, options));
}

Status load_terrain_labels(const IndexedGround& ground, const StoredIndex& stored,
                           const TerrainLabelsOptions& options, Workspace& workspace) {
  const auto content = hub_labelling::content_of(stored, hub_labelling::key_of(ground, options));
  if (!content) return pass_on(content);
  hub_labelling::IndexReader reader(*content);
  auto index = hub_labelling::TerrainIndex::read(reader, *ground.grid);
  if (index == nullptr && !hub_labelling::holds_none(*content)) return hub_labelling::damaged_index();
  workspace.get<hub_labelling::TerrainMemory>().take({ground.grid, ground.costs}, options.hub_memory_mib,
                                                     std::move(index), stored.owner);
  return {};
}

}  // namespace outrider
