#include "hub_lists.hpp"

#include <algorithm>
#include <bit>
#include <limits>
#include <tuple>

#include "outrider/core/parallel.hpp"
#include "taut_sight.hpp"

namespace outrider::hub_labelling {
namespace {

constexpr double far = std::numeric_limits<double>::infinity();

/// Makes the list of some corners of a tile: O(labels of the turns seen) for each.
class ListMaker {
 public:
  ListMaker(const GridMap& ground, const NavigationMesh& mesh, const HubTrees& trees);
  void add(Cell corner);
  /// Returns the list of the corners added since the last list; it is valid until the next one.
  TileList list();
  /// Returns the number of labels and turns visited so far.
  [[nodiscard]] std::uint64_t work() const { return work_; }

 private:
  struct Way {
    double distance = 0.0;
    std::uint32_t node = 0;
    bool kept = false;
  };
  void gather(Cell corner);
  bool known(std::uint32_t hub);

  const NavigationMesh& mesh_;
  const HubTrees& trees_;
  TautSight sight_;
  std::vector<Way> ways_;  ///< by hub; infinite where there is none
  std::uint64_t work_ = 0;
  std::vector<std::uint64_t> met_;                  ///< a bit for each hub
  std::vector<const HubTrees::HubLabel*> witness_;  ///< by hub: what made it known last
  std::vector<HubEntry> found_, entries_;
  std::vector<std::uint32_t> used_;  ///< turns of the list
  std::vector<Cell> turns_;
};

ListMaker::ListMaker(const GridMap& ground, const NavigationMesh& mesh, const HubTrees& trees)
    : mesh_(mesh),
      trees_(trees),
      sight_(ground, mesh),
      ways_(trees.hubs.size(), Way{far}),
      met_((trees.hubs.size() + 63) / 64),
      witness_(trees.hubs.size(), nullptr) {}

void ListMaker::add(Cell corner) {
  gather(corner);
  const auto bit = static_cast<std::uint16_t>(corner_bit(corner));
  const auto each_met = [this](auto visit) {
    for (std::size_t word = 0; word < met_.size(); ++word) {
      for (std::uint64_t bits = met_[word]; bits != 0; bits &= bits - 1)
        visit(static_cast<std::uint32_t>(64 * word) + static_cast<std::uint32_t>(std::countr_zero(bits)));
    }
  };
  each_met([&](std::uint32_t hub) {
    if (known(hub)) return;
    ways_[hub].kept = true;
    found_.push_back({hub, ways_[hub].node, 0.0F, 0, bit});
  });
  each_met([&](std::uint32_t hub) { ways_[hub] = {far}; });
  std::fill(met_.begin(), met_.end(), 0);
}

void ListMaker::gather(Cell corner) {
  for (const std::uint32_t turn : sight_.from(corner)) {
    const Cell at = mesh_.turns[turn].at;
    const double leg = length_between(corner, at);
    ++work_;
    const auto take = [&](const HubTrees::Departure& departure) {
      const HubTrees::HubLabel& label = departure.label;
      ++work_;
      Way& way = ways_[label.hub];
      if (!(leg + label.distance < way.distance)) return;
      met_[label.hub / 64] |= std::uint64_t{1} << label.hub % 64;
      way = {leg + label.distance, label.node};
    };
    trees_.departures[turn].onward(trees_.windings[turn], {at.x - corner.x, at.y - corner.y}, take);
  }
}

/// Returns true if an earlier hub lies on a path as short. Neighbouring corners mostly share this hub.
bool ListMaker::known(std::uint32_t hub) {
  const double enough = ways_[hub].distance * (1.0 + equal_within);
  const auto covers = [&](const HubTrees::HubLabel& label) {
    const Way& way = ways_[label.hub];
    return way.kept && way.distance + label.distance <= enough;
  };
  if (witness_[hub] != nullptr && covers(*witness_[hub])) return true;
  for (const HubTrees::HubLabel& label : trees_.labels[trees_.hubs[hub]]) {
    ++work_;
    if (!covers(label)) continue;
    witness_[hub] = &label;
    return true;
  }
  return false;
}

TileList ListMaker::list() {
  const auto key = [](const HubEntry& entry) { return std::tie(entry.hub, entry.node); };
  std::sort(found_.begin(), found_.end(),
            [&](const HubEntry& a, const HubEntry& b) { return key(a) < key(b); });
  entries_.clear();
  used_.clear();
  turns_.clear();
  for (const HubEntry& entry : found_) {
    if (entries_.empty() || key(entries_.back()) != key(entry)) {
      entries_.push_back(entry);
      used_.push_back(trees_.nodes[entry.node].turn);
    }
    entries_.back().corners = static_cast<std::uint16_t>(entries_.back().corners | entry.corners);
  }
  found_.clear();
  std::sort(used_.begin(), used_.end());
  used_.erase(std::unique(used_.begin(), used_.end()), used_.end());
  for (const std::uint32_t turn : used_) turns_.push_back(mesh_.turns[turn].at);
  for (HubEntry& entry : entries_) {
    const HubTrees::HubNode& node = trees_.nodes[entry.node];
    entry.beyond = static_cast<float>(node.distance);
    entry.turn =
        static_cast<std::uint16_t>(std::lower_bound(used_.begin(), used_.end(), node.turn) - used_.begin());
  }
  return {entries_, turns_};
}

TileRow row_of(int low_y, const GridMap& ground, const NavigationMesh& mesh, const HubTrees& trees) {
  TileRow row;
  ListMaker maker(ground, mesh, trees);
  const auto begin_tile = [&row] {
    row.tiles.push_back(
        {static_cast<std::uint32_t>(row.entries.size()), static_cast<std::uint32_t>(row.turns.size())});
  };
  for (int low_x = 0; low_x <= ground.frame.width; low_x += tile_side) {
    begin_tile();
    for (int y = low_y; y < low_y + tile_side; ++y) {
      for (int x = low_x; x < low_x + tile_side; ++x) {
        if (ground.place({x, y})) maker.add({x, y});
      }
    }
    const TileList list = maker.list();
    row.entries.insert(row.entries.end(), list.entries.begin(), list.entries.end());
    row.turns.insert(row.turns.end(), list.turns.begin(), list.turns.end());
  }
  begin_tile();
  row.work = maker.work();
  row.entries.shrink_to_fit();
  row.turns.shrink_to_fit();
  row.tiles.shrink_to_fit();
  return row;
}

}  // namespace

std::vector<TileRow> hub_lists(const GridMap& ground, const NavigationMesh& mesh, const HubTrees& trees,
                               std::size_t most_bytes, const std::stop_token& stop) {
  constexpr std::size_t block = 8;  // rows between two looks at the memory
  std::vector<TileRow> rows(static_cast<std::size_t>(ground.frame.height / tile_side) + 1);
  std::size_t bytes = 0;
  std::uint64_t work = 0;
  for (std::size_t low = 0; low < rows.size() && work < most_work && !stop.stop_requested(); low += block) {
    const std::size_t high = std::min(rows.size(), low + block);
    parallel_for(high - low, [&](std::size_t k) {
      rows[low + k] = row_of(static_cast<int>(low + k) * tile_side, ground, mesh, trees);
    });
    for (std::size_t y = low; y < high; ++y) {
      bytes += rows[y].memory();
      work += rows[y].work;
      if (bytes > most_bytes) rows[y] = {};
    }
    if (bytes > most_bytes) break;
  }
  return rows;
}

}  // namespace outrider::hub_labelling
