#include "terrain_index.hpp"

#include <algorithm>
#include <bit>
#include <limits>
#include <numbers>
#include <queue>

#include "dissection_order.hpp"

namespace outrider::hub_labelling {
namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();
constexpr double as_cheap = 1.0 + 1e-12;  // a path that costs no more than this counts as equally cheap

constexpr unsigned move_back(unsigned move) { return move ^ 2U; }

std::size_t neighbour(const GridMap& ground, std::size_t cell, unsigned move) {
  const Cell step = grid_moves[move];
  return static_cast<std::size_t>(static_cast<std::ptrdiff_t>(cell) +
                                  step.y * static_cast<std::ptrdiff_t>(ground.stride) + step.x);
}

}  // namespace

/// Builds the labels: from each cell in turn a search of Dijkstra, which does not go beyond cells to which
/// earlier hubs know a path that is as cheap.
class TerrainLabelling {
 public:
  TerrainLabelling(const GridMap& ground, const CellCosts* costs, std::size_t most_bytes,
                   const std::stop_token& stop)
      : ground_(ground),
        costs_(costs),
        most_entries_(most_bytes / (sizeof(std::uint32_t) + sizeof(double))),
        most_work_(std::uint64_t{most_bytes} << 4U),
        order_(dissection_order(ground, stop)),
        labels_(ground.marks.size()),
        cost_(ground.marks.size(), infinite),
        back_(ground.marks.size(), 0),
        to_hub_(order_.size(), infinite) {}

  std::unique_ptr<const TerrainIndex> build(const std::stop_token& stop) {
    for (std::uint32_t rank = 0; rank < order_.size(); ++rank) {
      if (entries_ > most_entries_ || work_ > most_work_ || stop.stop_requested()) return nullptr;
      search_from(rank, stop);
    }
    return entries_ > most_entries_ || stop.stop_requested() ? nullptr : collect();
  }

 private:
  struct Entry {
    std::uint32_t hub = 0;
    double cost = 0.0;
  };
  struct Waiting {
    double cost = 0.0;
    std::uint32_t cell = 0;
    friend bool operator<(const Waiting& a, const Waiting& b) {  // the cheapest is on top
      return a.cost != b.cost ? a.cost > b.cost : a.cell > b.cell;
    }
  };

  [[nodiscard]] double price(std::uint32_t index) const {
    return costs_ == nullptr ? 1.0 : double{costs_->per_m[ground_.at(index)]};
  }

  void search_from(std::uint32_t rank, const std::stop_token& stop) {
    const std::uint32_t hub = order_[rank];
    for (const Entry& entry : labels_[hub]) to_hub_[entry.hub >> 3U] = entry.cost;
    reach(hub, 0.0, 0);
    while (!queue_.empty() && !stop.stop_requested()) {
      const auto [cost, cell] = queue_.top();
      queue_.pop();
      if (cost > cost_[cell] || known(cell, cost)) continue;
      labels_[cell].push_back({8 * rank + back_[cell], cost});
      ++entries_;
      expand(cell, cost);
    }
    for (const std::uint32_t cell : reached_) cost_[cell] = infinite;
    reached_.clear();
    for (const Entry& entry : labels_[hub]) to_hub_[entry.hub >> 3U] = infinite;
  }

  void expand(std::uint32_t cell, double cost) {
    const double here = price(cell);
    for (unsigned left = ground_.moves[cell]; left != 0; left &= left - 1) {
      const auto move = static_cast<unsigned>(std::countr_zero(left));
      const auto next = static_cast<std::uint32_t>(neighbour(ground_, cell, move));
      const double length = move < 4 ? 1.0 : std::numbers::sqrt2;
      reach(next, cost + length * (0.5 * (here + price(next))), move_back(move));
    }
  }

  void reach(std::uint32_t cell, double cost, unsigned back) {
    if (!(cost < cost_[cell])) return;
    if (cost_[cell] == infinite) reached_.push_back(cell);
    cost_[cell] = cost;
    back_[cell] = static_cast<std::uint8_t>(back);
    queue_.push({cost, cell});
  }

  /// Returns true if an earlier hub lies on a path that is as cheap.
  bool known(std::uint32_t cell, double cost) {
    work_ += labels_[cell].size() + 8;
    return std::any_of(labels_[cell].begin(), labels_[cell].end(), [&](const Entry& entry) {
      return to_hub_[entry.hub >> 3U] + entry.cost <= cost * as_cheap;
    });
  }

  std::unique_ptr<const TerrainIndex> collect() {
    auto index = std::make_unique<TerrainIndex>();
    std::vector<std::uint64_t> first;
    std::vector<std::uint32_t> hubs;
    std::vector<double> costs;
    first.reserve(labels_.size() + 1);
    hubs.reserve(entries_);
    costs.reserve(entries_);
    for (auto& label : labels_) {
      first.push_back(hubs.size());
      for (const Entry& entry : label) {
        hubs.push_back(entry.hub);
        costs.push_back(entry.cost);
      }
      std::vector<Entry>().swap(label);
    }
    first.push_back(hubs.size());
    index->work_ = work_;
    index->first_ = StoredArray(std::move(first));
    index->hubs_ = StoredArray(std::move(hubs));
    index->costs_ = StoredArray(std::move(costs));
    return index;
  }

  const GridMap& ground_;
  const CellCosts* costs_;
  std::size_t most_entries_;
  std::uint64_t most_work_;
  std::vector<std::uint32_t> order_;        // cell, by rank
  std::vector<std::vector<Entry>> labels_;  // by cell; entries as in TerrainIndex
  std::vector<double> cost_;                // by cell, of this search
  std::vector<std::uint8_t> back_;          // by cell, the move towards the hub
  std::vector<double> to_hub_;              // by rank, from the hub of this search
  std::vector<std::uint32_t> reached_;
  std::priority_queue<Waiting> queue_;
  std::size_t entries_ = 0;
  std::uint64_t work_ = 0;
};

std::unique_ptr<const TerrainIndex> TerrainIndex::of(const GridMap& ground, const CellCosts* costs,
                                                     std::size_t most_bytes, const std::stop_token& stop) {
  if (ground.marks.size() * sizeof(std::size_t) > most_bytes) return nullptr;
  return TerrainLabelling(ground, costs, most_bytes - ground.marks.size() * sizeof(std::size_t), stop)
      .build(stop);
}

/// Returns the entry of a cell for a hub, or where it would be.
std::size_t TerrainIndex::entry_of(std::size_t cell, std::uint32_t hub) const {
  const std::uint32_t* const all = hubs_.data();
  return static_cast<std::size_t>(std::lower_bound(all + first_[cell], all + first_[cell + 1], 8 * hub) -
                                  all);
}

/// Appends the cells from one on to a hub, both with it.
void TerrainIndex::follow(const GridMap& ground, Cell from, std::uint32_t hub, std::vector<Cell>& way) const {
  for (Cell c = from;;) {
    way.push_back(c);
    const std::uint32_t index = ground.index(c);
    const std::size_t at = entry_of(index, hub);
    if (costs_[at] == 0.0) return;
    const Cell step = grid_moves[hubs_[at] & 7U];
    c = {c.x + step.x, c.y + step.y};
  }
}

std::vector<Cell> TerrainIndex::find(const GridMap& ground, Cell start, Cell goal) const {
  const std::uint32_t s = ground.index(start), g = ground.index(goal);
  std::size_t i = first_[s], j = first_[g];
  double best = infinite;
  std::uint32_t hub = 0;
  while (i < first_[s + 1] && j < first_[g + 1]) {
    const std::uint32_t a = hubs_[i] >> 3U, b = hubs_[j] >> 3U;
    if (a == b && costs_[i] + costs_[j] < best) {
      best = costs_[i] + costs_[j];
      hub = a;
    }
    i += a <= b ? 1 : 0;
    j += b <= a ? 1 : 0;
  }
  std::vector<Cell> way, rest;
  if (best == infinite) return way;
  follow(ground, start, hub, way);
  follow(ground, goal, hub, rest);
  way.insert(way.end(), rest.rbegin() + 1, rest.rend());
  return way;
}

void TerrainIndex::write(IndexWriter& writer) const {
  writer.number(static_cast<std::uint64_t>(IndexKind::labels));
  writer.number(work_);
  writer.array(first_);
  writer.array(hubs_);
  writer.array(costs_);
}

std::unique_ptr<const TerrainIndex> TerrainIndex::read(IndexReader& reader, const GridMap& ground) {
  auto index = std::make_unique<TerrainIndex>();
  std::uint64_t kind = 0;
  const bool whole = reader.number(kind) && kind == static_cast<std::uint64_t>(IndexKind::labels) &&
                     reader.number(index->work_) && reader.array(index->first_) &&
                     reader.array(index->hubs_) && reader.array(index->costs_) && reader.at_end();
  return whole && index->sound(ground) ? std::move(index) : nullptr;
}

/// Returns true if following an entry to its hub stays in free cells and ends, for every entry.
bool TerrainIndex::sound(const GridMap& ground) const {
  const auto cells = first_.all();
  if (cells.size() != ground.marks.size() + 1 || !std::is_sorted(cells.begin(), cells.end()) ||
      cells.front() != 0 || cells.back() != hubs_.size() || hubs_.size() != costs_.size())
    return false;
  for (std::uint32_t cell = 0; cell < ground.marks.size(); ++cell) {
    if (!sound(ground, cell)) return false;
  }
  return true;
}

/// Returns true if the hubs of a cell ascend, and each entry that is not of the cell itself leads by a legal
/// move to a cell that is nearer to the hub.
bool TerrainIndex::sound(const GridMap& ground, std::uint32_t cell) const {
  for (std::size_t i = first_[cell]; i < first_[cell + 1]; ++i) {
    const std::uint32_t hub = hubs_[i] >> 3U, move = hubs_[i] & 7U;
    if (i > first_[cell] && hubs_[i - 1] >> 3U >= hub) return false;
    if (costs_[i] == 0.0) continue;
    if (!(costs_[i] > 0.0) || (ground.moves[cell] >> move & 1U) == 0) return false;
    const std::size_t next = neighbour(ground, cell, move), at = entry_of(next, hub);
    if (at == first_[next + 1] || hubs_[at] >> 3U != hub || !(costs_[at] < costs_[i])) return false;
  }
  return true;
}

}  // namespace outrider::hub_labelling
