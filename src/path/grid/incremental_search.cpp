#include "incremental_search.hpp"

#include <algorithm>
#include <bit>
#include <limits>
#include <optional>

namespace outrider {
namespace {

constexpr Octile unreached{1 << 29, 0};  // more than any path, and two of them still fit
constexpr double most_shift = 4e6;       // keys are exact below 1e7, see octile.hpp

Octile length_of_move(unsigned move) { return move < 4 ? Octile{1, 0} : Octile{0, 1}; }

/// Returns the cells that differ, or nothing if the search cannot follow.
std::optional<std::vector<Cell>> changes_between(const std::shared_ptr<const GridMap>& before,
                                                 const std::shared_ptr<const GridMap>& now) {
  if (before == nullptr) return std::nullopt;
  if (before == now) return std::vector<Cell>{};
  return cells_changed(*before, *now, now->frame.size() / 32);
}

}  // namespace

struct IncrementalSearch::After {
  bool operator()(const Entry& a, const Entry& b) const {
    if (a.f != b.f) return a.f > b.f;
    if (a.raised != b.raised) return b.raised;
    if (a.least != b.least) return a.least < b.least;
    return a.state > b.state;
  }
};

void IncrementalSearch::prepare(const std::shared_ptr<const GridMap>& ground, Cell root, Cell target,
                                bool anew) {
  const bool kept = !anew && ground_ != nullptr && ground_->contains(root) && ground_->index(root) == root_;
  const auto changed = kept ? changes_between(ground_, ground) : std::nullopt;
  ground_ = ground;
  root_ = ground->index(root);
  generated_ = 0;
  trace_ = nullptr;
  move_target(target);
  if (!changed || shift_.value() > most_shift) {
    begin();
  } else {
    for (const Cell c : *changed) look_around(c);
  }
}

void IncrementalSearch::begin() {
  if (stamp_ == std::numeric_limits<std::uint32_t>::max() || vertices_.size() < ground_->marks.size()) {
    vertices_.assign(ground_->marks.size(), {});
    stamp_ = 0;
  }
  ++stamp_;
  shift_ = {};
  queue_.clear();
  Vertex& root = reach(root_);
  root.rhs = {};
  root.parent = root_;
  enqueue(root_);
}

void IncrementalSearch::move_target(Cell target) {
  shift_ = shift_ + octile_distance(target_cell_, target);
  target_cell_ = target;
  target_ = ground_->index(target);
}

/// Corrects the vertices whose moves, or whose neighbours' pinches, depend on a cell.
void IncrementalSearch::look_around(Cell changed) {
  for (int y = changed.y - 1; y <= changed.y + 2; ++y) {
    for (int x = changed.x - 1; x <= changed.x + 2; ++x) {
      if (ground_->contains({x, y})) look_again(ground_->index({x, y}));
    }
  }
}

/// Finds the least cost over all neighbours.
void IncrementalSearch::look_again(State s) {
  if (s == root_) return;
  Octile least = unreached;
  State parent = s;
  for (unsigned left = ground_->moves[s]; left != 0; left &= left - 1) {
    const auto move = static_cast<unsigned>(std::countr_zero(left));
    const State from = neighbour(s, move);
    ++generated_;
    if (!reached(from) || vertices_[from].g == unreached || !passable(from)) continue;
    const Octile through = vertices_[from].g + length_of_move(move);
    if (!(through < least)) continue;
    least = through;
    parent = from;
  }
  if (least == unreached && !reached(s)) return;
  Vertex& vertex = reach(s);
  vertex.parent = parent;
  if (vertex.rhs == least) return;
  vertex.rhs = least;
  enqueue(s);
}

Status IncrementalSearch::run(BudgetMeter& meter, Trace* trace) {
  trace_ = trace;
  if (trace_ != nullptr) trace_->open(root_);
  for (;;) {
    drop_stale_entries();
    if (settled()) return {};
    if (queue_.empty()) return fault(FaultCode::no_path, "nothing joins the start and the goal");
    if (!meter.spend()) return meter.refusal();
    const Entry first = queue_.front();
    pop();
    if (trace_ != nullptr) {
      const double h = octile_distance(ground_->at(first.state), target_cell_).value();
      trace_->record({first.state, vertices_[first.state].parent, first.f, first.least, h});
    }
    expand(first.state);
  }
}

void IncrementalSearch::expand(State s) {
  if (vertices_[s].rhs < vertices_[s].g) {
    lower(s);
  } else {
    raise(s);
  }
}

/// Settles a vertex that has become cheaper, and offers its cost to the neighbours.
void IncrementalSearch::lower(State s) {
  vertices_[s].g = vertices_[s].rhs;
  if (!passable(s)) return;
  const Octile g = vertices_[s].g;
  for (unsigned left = ground_->moves[s]; left != 0; left &= left - 1) {
    const auto move = static_cast<unsigned>(std::countr_zero(left));
    const State next = neighbour(s, move);
    ++generated_;
    const Octile through = g + length_of_move(move);
    const bool known = reached(next);
    if (known && !(through < vertices_[next].rhs)) continue;
    if (trace_ != nullptr && !known) trace_->open(next);
    Vertex& vertex = reach(next);
    vertex.rhs = through;
    vertex.parent = s;
    enqueue(next);
  }
}

/// Forgets the cost of a vertex that is too small, and lets the neighbours that relied on it look again.
void IncrementalSearch::raise(State s) {
  vertices_[s].g = unreached;
  enqueue(s);
  for (unsigned left = ground_->moves[s]; left != 0; left &= left - 1) {
    const State next = neighbour(s, static_cast<unsigned>(std::countr_zero(left)));
    if (reached(next) && vertices_[next].parent == s) look_again(next);
  }
}

IncrementalSearch::Entry IncrementalSearch::entry_of(State s) const {
  const Vertex& vertex = vertices_[s];
  const bool raised = vertex.g < vertex.rhs;
  const Octile least = raised ? vertex.g : vertex.rhs;
  const Octile f = least + octile_distance(ground_->at(s), target_cell_) + shift_;
  return {f.value(), least.value(), s, raised};
}

void IncrementalSearch::enqueue(State s) {
  if (!(vertices_[s].g == vertices_[s].rhs)) push(entry_of(s));
}

void IncrementalSearch::push(const Entry& entry) {
  queue_.push_back(entry);
  std::push_heap(queue_.begin(), queue_.end(), After{});
}

void IncrementalSearch::pop() {
  std::pop_heap(queue_.begin(), queue_.end(), After{});
  queue_.pop_back();
}

/// Makes the first entry one that holds: drops those of vertices that have changed, and renews smaller keys.
void IncrementalSearch::drop_stale_entries() {
  while (!queue_.empty()) {
    const Entry first = queue_.front(), now = entry_of(first.state);
    const Vertex& vertex = vertices_[first.state];
    const bool holds = !(vertex.g == vertex.rhs) && first.raised == now.raised && first.least == now.least;
    if (holds && first.f == now.f) return;
    pop();
    if (holds) push(now);
  }
}

/// Returns true if the cost of the target is proven; see the header.
bool IncrementalSearch::settled() const {
  if (!reached(target_)) return false;
  const Vertex& target = vertices_[target_];
  if (target.g == unreached || !(target.g == target.rhs)) return false;
  if (queue_.empty()) return true;
  const double cost = (target.g + shift_).value();
  const Entry& first = queue_.front();
  return first.f > cost || (first.f == cost && !first.raised);
}

IncrementalSearch::Vertex& IncrementalSearch::reach(State s) {
  Vertex& vertex = vertices_[s];
  if (vertex.stamp != stamp_) vertex = {unreached, unreached, s, stamp_};
  return vertex;
}

/// Returns true if a path may go on from the vertex: only its ends may be pinches.
bool IncrementalSearch::passable(State s) const {
  return (ground_->marks[s] & GridMap::pinch_bit) == 0 || s == root_;
}

State IncrementalSearch::neighbour(State s, unsigned move) const {
  const auto [x, y] = grid_moves[move];
  return static_cast<State>(static_cast<std::int64_t>(s) + std::int64_t{y} * ground_->stride + x);
}

std::vector<Cell> IncrementalSearch::path() const {
  std::vector<Cell> cells{target_cell_};
  for (State s = target_; s != root_; s = vertices_[s].parent)
    cells.push_back(ground_->at(vertices_[s].parent));
  return cells;
}

}  // namespace outrider
