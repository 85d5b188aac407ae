// IncrementalSearch: A* along the eight moves from a root to a target that is kept, and repaired where the
// grid has changed or the target has moved.
//
// Each reached vertex has g, and rhs: the least g of a neighbour plus the move from it (0 at the root). The
// queue holds the vertices at which the two differ: `raised` ones, whose g is too small, and lowered ones.
// Their key is f = min(g, rhs) + h + shift, where h is the octile distance to the target and `shift` the sum
// of the distances that the target has moved: kept keys are then never too large.
//
// The order is least f; raised before lowered; largest min(g, rhs); least state. The search ends when the
// target is consistent (g = rhs) and no vertex with f <= g(target) is raised or with f < g(target) lowered.
// Then g(target) is the least cost:
//  - A path of that cost exists. Follow the parents from the target. None is raised, because its f is at most
//    g(target); so each has g >= rhs, and the next one a smaller g. They lead to the root.
//  - No path costs less. On a cheaper path take the first vertex v with g(v) larger than its cost so far. All
//    before v have g at most that, so v has rhs at most that, is lowered, and has f < g(target).
// The same argument shows that a lowered vertex has its final g when it is expanded, so a repair expands each
// vertex at most twice.
#pragma once

#include <bit>
#include <cstdint>
#include <memory>
#include <vector>

#include "cell_at.hpp"
#include "incremental_vertices.hpp"
#include "octile.hpp"
#include "outrider/core/budget.hpp"
#include "outrider/core/trace.hpp"
#include "outrider/path/grid/grid_map.hpp"
#include "outrider/search/labels.hpp"
#include "quad_heap.hpp"

namespace outrider {

class IncrementalSearch {
 public:
  /// Prepares a search. Keeps what is known if `anew` is false, the root is the same, and at most one cell in
  /// 32 differs from the grid of the previous call.
  void prepare(const std::shared_ptr<const GridMap>& ground, Cell root, Cell target, bool anew);

  /// Searches until the cost of the target is known. Faults: no_path; budget_exhausted and cancelled, after
  /// which the search can be continued.
  Status run(BudgetMeter& meter, Trace* trace);

  [[nodiscard]] Octile cost() const { return vertices_[target_].g; }
  /// Returns the vertices from the target to the root.
  [[nodiscard]] std::vector<Cell> path() const;
  /// Returns the number of neighbours considered since prepare().
  [[nodiscard]] std::uint64_t generated() const { return generated_; }

 private:
  /// An entry of the queue, with its order in numbers.
  struct Entry {
    double f = 0.0;
    std::uint64_t order = 0;  // of equal f: raised before lowered, then the largest min(g, rhs)
    State state = 0;

    [[nodiscard]] bool raised() const { return order >> 63U == 0; }
    [[nodiscard]] double least() const { return std::bit_cast<double>(~order & ~(std::uint64_t{1} << 63U)); }
    friend bool before(const Entry& a, const Entry& b) {
      const bool same = a.f == b.f;
      return ((a.f < b.f) | (same & (a.order < b.order)) |
              (same & (a.order == b.order) & (a.state < b.state))) != 0;
    }
  };

  void begin();
  void move_target(Cell target);
  void look_around(Cell changed);
  void look_again(State s);
  void expand(State s);
  void lower(State s, IncrementalVertex vertex);
  void raise(State s, IncrementalVertex vertex);
  void set(State s, const IncrementalVertex& vertex);
  void drop_stale_entries();
  [[nodiscard]] bool settled() const;
  [[nodiscard]] Entry entry_of(State s, const IncrementalVertex& vertex) const;
  [[nodiscard]] bool passable(State s) const;
  [[nodiscard]] State neighbour(State s, unsigned move) const;
  [[nodiscard]] State parent(State s) const;

  std::shared_ptr<const GridMap> ground_;
  CellAt cell_at_;
  State root_ = 0, target_ = 0;
  Cell target_cell_;
  Octile shift_;
  IncrementalVertices vertices_;  // by GridMap::index()
  QuadHeap<Entry> queue_;         // may hold entries of vertices that have changed since
  std::uint64_t generated_ = 0;
  Trace* trace_ = nullptr;
};

}  // namespace outrider
