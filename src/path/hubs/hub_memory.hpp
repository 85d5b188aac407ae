// The memory of an index of hub labels in the workspace, and the queries that it answers as far as it proves
// the answers.
//
// The index of the first ground answers on grounds that differ in few cells where hub_kept.hpp proves its
// answer. It is rebuilt if more than one cell in 32 differs, or when the searches on changed grounds have
// taken as much work as building it.
//
// An `Index` has
//   planner                              name of its planner
//   Scratch                              memory of its queries
//   static of(ground, most_bytes, stop)  the index; null if it does not fit or `stop` is requested
//   work                                 work of building it, in expansions of the search
//   work_of_search                       work of the search to prepare for a changed ground, in its
//                                        expansions
//   straight(ground, start, goal, way)   adds the path that needs no hub to `way`, which holds the start;
//                                        false, and nothing added, if there is none
//   static straight_on(ground, start, goal, way)  the same on a ground that has no index
//   find(ground, start, goal, way, scratch, meter)  adds the shortest path that turns to `way`
//   static length_of(way)                cells
//   static none_shorter(boxes, way)      true if no path that touches a box of freed cells is shorter
//   write(writer), static read(reader, ground)  as stored bytes
#pragma once

#include <fmt/format.h>

#include <memory>
#include <optional>
#include <stop_token>
#include <vector>

#include "hub_index.hpp"
#include "hub_kept.hpp"
#include "index_bytes.hpp"
#include "outrider/path/plan.hpp"
#include "outrider/search/workspace.hpp"

namespace outrider::hub_labelling {

template <class Index>
struct HubMemory {
  std::shared_ptr<const GridMap> ground;  ///< ground of the index
  std::int64_t hub_memory_mib = 0;
  std::shared_ptr<const void> stored;    ///< keeps the bytes to which a loaded index refers
  std::unique_ptr<const Index> index;    ///< none when it would be too large
  std::shared_ptr<const GridMap> asked;  ///< ground of the last query; differs from `ground` in few cells
  bool changed = false;                  ///< some cells differ
  bool searched = false;                 ///< the search has been used and has prepared for the ground
  std::vector<CellBox> freed;            ///< blocked in `ground`, free in `asked`
  std::uint64_t spent = 0;               ///< work of the search on changed grounds, in expansions
  std::vector<Cell> way;
  std::optional<typename Index::Scratch> scratch;

  void renew(const std::shared_ptr<const GridMap>& now, std::int64_t mib, const std::stop_token& stop) {
    const bool made = ground != nullptr && hub_memory_mib == mib;
    const bool near = made && (asked == now || compare(now));
    if (near && (!changed || index == nullptr || spent <= index->work)) return;
    make(now, mib, stop);
  }

  /// Takes an index that was made for that ground.
  void take(const std::shared_ptr<const GridMap>& now, std::int64_t mib, std::unique_ptr<const Index> made,
            std::shared_ptr<const void> bytes) {
    clear();
    index = std::move(made);
    stored = std::move(bytes);
    ground = asked = now;
    hub_memory_mib = mib;
    scratch.emplace();
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

  void clear() {
    ground.reset();
    asked.reset();
    freed.clear();
    changed = searched = false;
    spent = 0;
    scratch.reset();
    index.reset();
    stored.reset();
  }

  void make(const std::shared_ptr<const GridMap>& now, std::int64_t mib, const std::stop_token& stop) {
    clear();
    auto made = Index::of(*now, static_cast<std::size_t>(mib) << 20U, stop);
    if (!stop.stop_requested()) take(now, mib, std::move(made), nullptr);
  }
};

enum class Answer { way, no_path, unknown, out_of_budget };

/// Answers a query as far as the index proves an answer on the present ground; the path is in memory.way.
template <class Index>
Answer look_up(HubMemory<Index>& memory, Cell start, Cell goal, BudgetMeter& meter) {
  const Index& index = *memory.index;
  std::vector<Cell>& way = memory.way;
  way.assign(1, start);
  if (start == goal) return Answer::way;
  const auto find = [&] { return index.find(*memory.ground, start, goal, way, *memory.scratch, meter); };
  if (!memory.changed) {
    if (index.straight(*memory.ground, start, goal, way)) return Answer::way;
    switch (find()) {
      case Found::way: return Answer::way;
      case Found::no_path: return Answer::no_path;
      case Found::out_of_budget: return Answer::out_of_budget;
    }
  }
  if (Index::straight_on(*memory.asked, start, goal, way)) return Answer::way;
  const GridMap& before = *memory.ground;
  if (!before.place(start) || !before.place(goal) || index.straight(*memory.ground, start, goal, way))
    return Answer::unknown;
  switch (find()) {
    case Found::way: break;
    case Found::no_path: return memory.freed.empty() ? Answer::no_path : Answer::unknown;
    case Found::out_of_budget: return Answer::out_of_budget;
  }
  return Index::none_shorter(memory.freed, way) && legal_way(*memory.asked, way) ? Answer::way
                                                                                 : Answer::unknown;
}

/// Plans by the index, and by `search(budget)` what it does not know; on a changed ground the work of the
/// search counts towards the next index.
template <class Index, class Search>
Outcome<Plan> plan_by_hubs(const Problem& problem, const GridQuery& query, std::int64_t hub_memory_mib,
                           const Budget& budget, Workspace& workspace, Search search) {
  const auto& [ground, start, goal] = query;
  BudgetMeter meter(budget);
  if (!meter.spend()) return meter.refusal();
  auto& memory = workspace.get<HubMemory<Index>>();
  memory.renew(problem.grid, hub_memory_mib, budget.stop);
  if (memory.ground == nullptr) return meter.refusal();
  if (memory.index == nullptr) return search();

  const Answer answer = look_up(memory, start, goal, meter);
  if (answer == Answer::out_of_budget) return meter.refusal();
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

/// The options of an index as text.
inline std::string text_of_options(std::int64_t hub_memory_mib) {
  return fmt::format("hub_memory {}", hub_memory_mib);
}

/// Returns the index of the ground as bytes; builds it if the workspace has none. Faults: cancelled.
template <class Index>
Outcome<std::string> save_index(const std::shared_ptr<const GridMap>& ground, std::int64_t hub_memory_mib,
                                const Budget& budget, Workspace& workspace) {
  auto& memory = workspace.get<HubMemory<Index>>();
  if (memory.ground != ground || memory.hub_memory_mib != hub_memory_mib) {
    auto made = Index::of(*ground, static_cast<std::size_t>(hub_memory_mib) << 20U, budget.stop);
    if (budget.stop.stop_requested()) return BudgetMeter(budget).refusal();
    memory.take(ground, hub_memory_mib, std::move(made), nullptr);
  }
  IndexWriter writer;
  if (memory.index == nullptr) {
    writer.number(static_cast<std::uint64_t>(IndexKind::none));
  } else {
    memory.index->write(writer);
  }
  return std::move(writer).finish({Index::planner, text_of_options(hub_memory_mib), *ground});
}

/// Puts an index from save_index() into the workspace. Faults: bad_input, with the remedy.
template <class Index>
Status load_index(const std::shared_ptr<const GridMap>& ground, const StoredIndex& stored,
                  std::int64_t hub_memory_mib, Workspace& workspace) {
  const auto content = content_of(stored, {Index::planner, text_of_options(hub_memory_mib), *ground});
  if (!content) return pass_on(content);
  IndexReader reader(*content);
  auto index = Index::read(reader, *ground);
  if (index == nullptr && !holds_none(*content)) return damaged_index();
  workspace.get<HubMemory<Index>>().take(ground, hub_memory_mib, std::move(index), stored.owner);
  return {};
}

}  // namespace outrider::hub_labelling
