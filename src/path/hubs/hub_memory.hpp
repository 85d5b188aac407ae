// What the workspace keeps of an index of hub labels, and queries that it answers as far as it proves them.
//
// The index of the first ground answers on grounds that differ in few cells where hub_kept.hpp proves its
// answer. It is rebuilt if more than one cell in 32 differs, or when the searches on changed grounds have
// taken as much work as building it.
//
// An `Index` has
//   static of(ground, most_bytes, stop)  the index; null if it does not fit or `stop` is requested
//   work                                 work of building it, in expansions of the search
//   work_of_search                       work of the search to prepare for a changed ground, in its
//   expansions lists(vertex)                        true if the index has the list of the vertex
//   straight(ground, start, goal, way)   adds the path that needs no hub to `way`, which holds the start;
//                                        false, and nothing added, if there is none
//   static straight_on(ground, start, goal, way)  the same on a ground that has no index
//   find(start, goal, way)               adds the shortest path over a hub to `way`; false if there is none
//   static length_of(way)                cells
//   static none_shorter(boxes, way)      true if no path that touches a box of freed cells is shorter
#pragma once

#include <memory>
#include <stop_token>
#include <vector>

#include "hub_kept.hpp"
#include "outrider/path/plan.hpp"
#include "outrider/search/workspace.hpp"

namespace outrider::hub_labelling {

template <class Index>
struct HubMemory {
  std::shared_ptr<const GridMap> ground;  ///< ground of the index
  std::int64_t index_mib = 0;
  std::unique_ptr<const Index> index;    ///< none when it would be too large
  std::shared_ptr<const GridMap> asked;  ///< ground of the last query; differs from `ground` in few cells
  bool changed = false;                  ///< some cells differ
  bool searched = false;                 ///< the search has been used and has prepared for the ground
  std::vector<CellBox> freed;            ///< blocked in `ground`, free in `asked`
  std::uint64_t spent = 0;               ///< work of the search on changed grounds, in expansions
  std::vector<Cell> way;

  void renew(const std::shared_ptr<const GridMap>& now, std::int64_t mib, const std::stop_token& stop) {
    const bool made = ground != nullptr && index_mib == mib;
    const bool near = made && (asked == now || compare(now));
    if (near && (!changed || index == nullptr || spent <= index->work)) return;
    make(now, mib, stop);
  }

 private:
  /// Compares the grounds; returns false if too many cells differ.
  bool compare(const std::shared_ptr<const GridMap>& now) {
    const auto cells = cells_changed(*ground, *now, now->frame.size() / 32);
    if (!cells) return false;
    changed = !cells->empty();
    searched = false;
    freed = freed_boxes(*now, *cells);
    asked = now;
    return true;
  }

  void make(const std::shared_ptr<const GridMap>& now, std::int64_t mib, const std::stop_token& stop) {
    ground.reset();
    asked.reset();
    freed.clear();
    changed = searched = false;
    spent = 0;
    index = Index::of(*now, static_cast<std::size_t>(mib) << 20U, stop);
    if (stop.stop_requested()) return;
    ground = asked = now;
    index_mib = mib;
  }
};

enum class Answer { way, no_path, unknown };

/// Answers a query as far as the index proves an answer on the present ground; the path is in memory.way.
template <class Index>
Answer look_up(HubMemory<Index>& memory, Cell start, Cell goal) {
  const Index& index = *memory.index;
  std::vector<Cell>& way = memory.way;
  way.assign(1, start);
  if (start == goal) return Answer::way;
  const bool listed = index.lists(start) && index.lists(goal);
  if (!memory.changed) {
    if (index.straight(*memory.ground, start, goal, way)) return Answer::way;
    if (!listed) return Answer::unknown;
    return index.find(start, goal, way) ? Answer::way : Answer::no_path;
  }
  if (Index::straight_on(*memory.asked, start, goal, way)) return Answer::way;
  const GridMap& before = *memory.ground;
  if (!listed || !before.place(start) || !before.place(goal) ||
      index.straight(*memory.ground, start, goal, way))
    return Answer::unknown;
  if (!index.find(start, goal, way)) return memory.freed.empty() ? Answer::no_path : Answer::unknown;
  return Index::none_shorter(memory.freed, way) && legal_way(*memory.asked, way) ? Answer::way
                                                                                 : Answer::unknown;
}

/// Plans by the index, and by `search(budget)` what it does not know; on a changed ground the work of the
/// search counts towards the next index.
template <class Index, class Search>
Outcome<Plan> plan_by_hubs(const Problem& problem, const GridQuery& query, std::int64_t index_mib,
                           const Budget& budget, Workspace& workspace, Search search) {
  const auto& [ground, start, goal] = query;
  BudgetMeter meter(budget);
  if (!meter.spend()) return meter.refusal();
  auto& memory = workspace.get<HubMemory<Index>>();
  memory.renew(problem.grid, index_mib, budget.stop);
  if (memory.ground == nullptr) return meter.refusal();
  if (memory.index == nullptr) return search();

  const Answer answer = look_up(memory, start, goal);
  if (answer == Answer::unknown) {
    auto plan = search();
    if (!memory.changed) return plan;
    if (!memory.searched) memory.spent += memory.index->work_of_search;
    memory.searched = true;
    if (plan) memory.spent += plan->counters.expansions;
    return plan;
  }
  if (answer == Answer::no_path) return fault(FaultCode::no_path, "nothing joins the start and the goal");
  double cost = Index::length_of(memory.way);  // cells
  if (workspace.trace != nullptr)
    workspace.trace->record({ground.index(start), ground.index(start), cost, 0.0, cost});
  cost *= ground.frame.resolution_m;
  return plan_along(problem, memory.way, cost, cost, {meter.spent(), 0, 0});
}

}  // namespace outrider::hub_labelling
