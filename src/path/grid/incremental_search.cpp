#include "incremental_search.hpp"

#include <bit>
#include <optional>

namespace outrider {
namespace {

constexpr Octile unreached = IncrementalVertex::unreached;
constexpr double most_shift = 4e6;  // keys are exact below 1e7, see octile.hpp

constexpr unsigned opposite(unsigned move) { return move ^ 2U; }

Octile length_of_move(unsigned move) { return move < 4 ? Octile{1, 0} : Octile{0, 1}; }

/// Returns the cells that differ, or nothing if the search cannot follow.
std::optional<std::vector<Cell>> changes_between(const std::shared_ptr<const GridMap>& before,
                                                 const std::shared_ptr<const GridMap>& now) {
  if (before == nullptr) return std::nullopt;
  if (before == now) return std::vector<Cell>{};
  return cells_changed(*before, *now, now->frame.size() / 32);
}

}  // namespace

void IncrementalSearch::prepare(const std::shared_ptr<const GridMap>& ground, Cell root, Cell target,
                                bool anew) {
  const bool kept = !anew && ground_ != nullptr && ground_->contains(root) && ground_->index(root) == root_;
  const auto changed = kept ? changes_between(ground_, ground) : std::nullopt;
  ground_ = ground;
  cell_at_ = CellAt(*ground);
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
  vertices_.begin(ground_->marks.size());
  shift_ = {};
  queue_.clear();
  set(root_, {unreached, {}, IncrementalVertex::no_parent});
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
  unsigned to_parent = IncrementalVertex::no_parent;
  for (unsigned left = ground_->moves[s]; left != 0; left &= left - 1) {
    const auto move = static_cast<unsigned>(std::countr_zero(left));
    const State from = neighbour(s, move);
    ++generated_;
    const Octile g = vertices_[from].g;
    if (g == unreached || !passable(from)) continue;
    const Octile through = g + length_of_move(move);
    if (!(through < least)) continue;
    least = through;
    to_parent = move;
  }
  if (least == unreached && !vertices_.reached(s)) return;
  const IncrementalVertex vertex = vertices_[s];
  const IncrementalVertex now{vertex.g, least, to_parent};
  vertex.rhs == least ? vertices_.set(s, now) : set(s, now);
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
    queue_.pop();
    if (trace_ != nullptr) {
      const double h = octile_distance(cell_at_(first.state), target_cell_).value();
      trace_->record({first.state, parent(first.state), first.f, first.least(), h});
    }
    expand(first.state);
  }
}

void IncrementalSearch::expand(State s) {
  const IncrementalVertex vertex = vertices_[s];
  if (vertex.rhs < vertex.g) {
    lower(s, vertex);
  } else {
    raise(s, vertex);
  }
}

/// Settles a vertex that has become cheaper, and offers its cost to the neighbours.
void IncrementalSearch::lower(State s, IncrementalVertex vertex) {
  const Octile g = vertex.g = vertex.rhs;
  vertices_.set(s, vertex);
  if (!passable(s)) return;
  for (unsigned left = ground_->moves[s]; left != 0; left &= left - 1) {
    const auto move = static_cast<unsigned>(std::countr_zero(left));
    const State next = neighbour(s, move);
    ++generated_;
    const Octile through = g + length_of_move(move);
    const IncrementalVertex there = vertices_[next];
    if (!(through < there.rhs)) continue;
    if (trace_ != nullptr && !vertices_.reached(next)) trace_->open(next);
    set(next, {there.g, through, opposite(move)});
  }
}

/// Forgets the cost of a vertex that is too small, and lets the neighbours that relied on it look again.
void IncrementalSearch::raise(State s, IncrementalVertex vertex) {
  vertex.g = unreached;
  set(s, vertex);
  for (unsigned left = ground_->moves[s]; left != 0; left &= left - 1) {
    const auto move = static_cast<unsigned>(std::countr_zero(left));
    const State next = neighbour(s, move);
    if (vertices_[next].to_parent == opposite(move)) look_again(next);
  }
}

IncrementalSearch::Entry IncrementalSearch::entry_of(State s, const IncrementalVertex& vertex) const {
  const bool raised = vertex.g < vertex.rhs;
  const Octile least = raised ? vertex.g : vertex.rhs;
  const Octile f = least + octile_distance(cell_at_(s), target_cell_) + shift_;
  const std::uint64_t lowered = raised ? 0 : std::uint64_t{1} << 63U;
  return {f.value(), lowered | (~std::bit_cast<std::uint64_t>(least.value()) & ~(std::uint64_t{1} << 63U)),
          s};
}

/// Writes a vertex, and puts it into the queue unless it is consistent.
void IncrementalSearch::set(State s, const IncrementalVertex& vertex) {
  vertices_.set(s, vertex);
  if (!vertex.consistent()) queue_.push(entry_of(s, vertex));
}

/// Makes the first entry one that holds: drops those of vertices that have changed, and renews smaller keys.
void IncrementalSearch::drop_stale_entries() {
  while (!queue_.empty()) {
    const Entry first = queue_.front();
    const IncrementalVertex vertex = vertices_[first.state];
    const Entry now = entry_of(first.state, vertex);
    const bool holds = !vertex.consistent() && first.order == now.order;
    if (holds && first.f == now.f) return;
    queue_.pop();
    if (holds) queue_.push(now);
  }
}

/// Returns true if the cost of the target is proven; see the header.
bool IncrementalSearch::settled() const {
  const IncrementalVertex target = vertices_[target_];
  if (target.g == unreached || !target.consistent()) return false;
  if (queue_.empty()) return true;
  const double cost = (target.g + shift_).value();
  const Entry& first = queue_.front();
  return first.f > cost || (first.f == cost && !first.raised());
}

/// Returns true if a path may go on from the vertex: only its ends may be pinches.
bool IncrementalSearch::passable(State s) const {
  return (ground_->marks[s] & GridMap::pinch_bit) == 0 || s == root_;
}

State IncrementalSearch::neighbour(State s, unsigned move) const {
  const auto [x, y] = grid_moves[move];
  return static_cast<State>(static_cast<std::int64_t>(s) + std::int64_t{y} * ground_->stride + x);
}

/// Returns the neighbour over which the least cost leads; for the root itself.
State IncrementalSearch::parent(State s) const {
  const std::uint32_t move = vertices_[s].to_parent;
  return move == IncrementalVertex::no_parent ? s : neighbour(s, move);
}

std::vector<Cell> IncrementalSearch::path() const {
  std::vector<Cell> cells{target_cell_};
  for (State s = target_; s != root_;) {
    s = parent(s);
    cells.push_back(cell_at_(s));
  }
  return cells;
}

}  // namespace outrider
