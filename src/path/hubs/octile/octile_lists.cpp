#include "octile_lists.hpp"

#include <algorithm>
#include <numeric>
#include <tuple>

#include "grid/octile.hpp"

namespace outrider::hub_labelling {
namespace {

/// Reaches a subgoal itself, and from other cells the first subgoals on the legs.
class OctileReach {
 public:
  OctileReach(const GridMap& ground, const OctileRuns& runs, const Subgoals& subgoals, const HubTrees& trees)
      : ground_(ground), subgoals_(subgoals), trees_(trees), reach_(ground, runs, subgoals) {}

  template <class Take>
  std::size_t labels_from(Cell cell, Take take) {
    const auto labels_of = [&](std::uint32_t subgoal) {
      const double leg = octile_distance(cell, subgoals_.cells[subgoal]).value();
      for (const HubTrees::HubLabel& label : trees_.labels[subgoal]) take(leg, label);
    };
    const std::uint32_t own = subgoals_.number[ground_.index(cell)];
    if (own != Subgoals::none) {
      labels_of(own);
      return 1;
    }
    const std::vector<std::uint32_t>& reached = reach_.from(cell);
    for (const std::uint32_t subgoal : reached) labels_of(subgoal);
    return reached.size();
  }

 private:
  const GridMap& ground_;
  const Subgoals& subgoals_;
  const HubTrees& trees_;
  SubgoalReach reach_;
};

/// Returns the exact distances of all nodes to their hubs; nothing if one is too long for an entry.
std::optional<std::vector<Octile>> distances_of(const Subgoals& subgoals, const HubTrees& trees) {
  constexpr std::int32_t most = std::numeric_limits<std::uint16_t>::max();
  std::vector<Octile> distances(trees.nodes.size());
  for (std::size_t node = 0; node < distances.size(); ++node) {  // the next node has been computed before
    const HubTrees::HubNode& at = trees.nodes[node];
    distances[node] = distances[at.next] +
                      octile_distance(subgoals.cells[at.turn], subgoals.cells[trees.nodes[at.next].turn]);
    if (distances[node].straight > most || distances[node].diagonal > most) return std::nullopt;
  }
  return distances;
}

StoredArray<OctileNode> nodes_of(const Subgoals& subgoals, const HubTrees& trees) {
  std::vector<OctileNode> nodes;
  nodes.reserve(trees.nodes.size());
  for (const HubTrees::HubNode& node : trees.nodes) {
    const Cell at = subgoals.cells[node.turn];
    nodes.push_back({node.next, static_cast<std::int16_t>(at.x), static_cast<std::int16_t>(at.y)});
  }
  return StoredArray(std::move(nodes));
}

/// Returns the position of a cell on a curve that visits one quarter of a square after the other, and within
/// each likewise (Morton order).
std::uint32_t along_curve(Cell c) {
  std::uint32_t place = 0;
  for (unsigned bit = 0; bit < 15; ++bit) {
    const std::uint32_t x = (static_cast<std::uint32_t>(c.x) >> bit) & 1U;
    const std::uint32_t y = (static_cast<std::uint32_t>(c.y) >> bit) & 1U;
    place |= (x | (y << 1U)) << (2 * bit);
  }
  return place;
}

/// Returns the number of each hub, by rank.
std::vector<std::uint32_t> numbers_of(const Subgoals& subgoals, const HubTrees& trees) {
  constexpr std::ptrdiff_t of_most_lists = 64;  // hubs that are in lists everywhere
  std::vector<std::uint32_t> ranks(trees.hubs.size()), numbers(ranks.size());
  std::iota(ranks.begin(), ranks.end(), 0U);
  const auto place = [&](std::uint32_t rank) { return along_curve(subgoals.cells[trees.hubs[rank]]); };
  std::sort(ranks.begin() + std::min(of_most_lists, std::ssize(ranks)), ranks.end(),
            [&](std::uint32_t a, std::uint32_t b) { return place(a) < place(b); });
  for (std::uint32_t number = 0; number < ranks.size(); ++number) numbers[ranks[number]] = number;
  return numbers;
}

/// Makes the rows of tiles.
class RowMaker {
 public:
  RowMaker(const GridMap& ground, const OctileRuns& runs, const Subgoals& subgoals, const HubTrees& trees,
           const std::vector<Octile>& distances)
      : ground_(ground),
        runs_(runs),
        subgoals_(subgoals),
        trees_(trees),
        distances_(distances),
        numbers_(numbers_of(subgoals, trees)) {}

  [[nodiscard]] OctileTileRow row(std::span<const Cell> tiles) const {
    Arrays row;
    std::vector<NumberedLabel> shared;
    TileLabels<OctileReach> labels(trees_, OctileReach(ground_, runs_, subgoals_, trees_));
    each_tile(tiles, ground_, labels, [&](Cell low, const std::vector<TileLabel>& list) {
      row.tiles.push_back(static_cast<std::uint32_t>(row.blocks.size()));
      share_paths(list, low, shared);
      for (const NumberedLabel& label : shared) add(label, row);
    });
    row.tiles.push_back(static_cast<std::uint32_t>(row.blocks.size()));
    return {StoredArray(std::move(row.tiles)), StoredArray(std::move(row.blocks)),
            StoredArray(std::move(row.cells)), StoredArray(std::move(row.paths)), labels.work()};
  }

 private:
  /// The arrays of a row.
  struct Arrays {
    std::vector<std::uint32_t> tiles;
    std::vector<HubBlock> blocks;
    std::vector<std::uint16_t> cells;
    std::vector<OctilePath> paths;
  };
  struct NumberedLabel {
    std::uint32_t block = 0, copy = 0, bit = 0;  ///< of several paths to one hub, each is a copy
    TileLabel label;

    [[nodiscard]] auto key() const { return std::tie(block, copy, bit); }
  };

  [[nodiscard]] Cell subgoal_of(const TileLabel& label) const {
    return subgoals_.cells[trees_.nodes[label.node].turn];
  }
  [[nodiscard]] Octile distance(Cell cell, const TileLabel& label) const {
    return octile_distance(cell, subgoal_of(label)) + distances_[label.node];
  }

  /// Moves to the first label the cells of the second, of the same hub, whose path may as well be the first.
  void take_over(TileLabel& first, TileLabel& second, Cell low) const {
    for (unsigned bits = second.corners; bits != 0; bits &= bits - 1) {
      const int k = std::countr_zero(bits);
      const Cell cell{low.x + k % tile_side, low.y + k / tile_side};
      const bool equal = distance(cell, first) == distance(cell, second);
      if (!equal || !runs_.leg(cell, subgoal_of(first))) continue;
      const auto bit = static_cast<std::uint16_t>(1U << static_cast<unsigned>(k));
      first.corners = static_cast<std::uint16_t>(first.corners | bit);
      second.corners = static_cast<std::uint16_t>(second.corners & ~bit);
    }
  }

  /// Writes the labels of a tile in the order of blocks, with as few paths to a hub as can be told easily.
  void share_paths(const std::vector<TileLabel>& list, Cell low, std::vector<NumberedLabel>& shared) const {
    shared.clear();
    std::vector<TileLabel> same;
    for (auto next = list.begin(); next != list.end();) {
      const std::uint32_t hub = next->hub;
      same.clear();
      for (; next != list.end() && next->hub == hub; ++next) same.push_back(*next);
      std::sort(same.begin(), same.end(), [](const TileLabel& a, const TileLabel& b) {
        const int of_a = std::popcount(a.corners), of_b = std::popcount(b.corners);
        return of_a != of_b ? of_a > of_b : a.node < b.node;
      });
      std::uint32_t copy = 0;
      for (auto first = same.begin(); first != same.end(); ++first) {
        if (first->corners == 0) continue;
        for (auto second = std::next(first); second != same.end(); ++second) take_over(*first, *second, low);
        shared.push_back({numbers_[hub] / 64, copy++, numbers_[hub] % 64, *first});
      }
    }
    std::sort(shared.begin(), shared.end(),
              [](const NumberedLabel& a, const NumberedLabel& b) { return a.key() < b.key(); });
  }

  void add(const NumberedLabel& added, Arrays& row) const {
    const bool first_of_tile = row.blocks.size() == row.tiles.back();
    const std::uint64_t bit = std::uint64_t{1} << added.bit;
    if (first_of_tile || row.blocks.back().block != added.block || row.blocks.back().bits >= bit)
      row.blocks.push_back({0, added.block, static_cast<std::uint32_t>(row.paths.size())});
    row.blocks.back().bits |= bit;
    const auto [straight, diagonal] = distances_[added.label.node];
    const Cell at = subgoal_of(added.label);
    row.cells.push_back(added.label.corners);
    row.paths.push_back({added.label.node, static_cast<std::uint16_t>(straight),
                         static_cast<std::uint16_t>(diagonal), static_cast<std::int16_t>(at.x),
                         static_cast<std::int16_t>(at.y)});
  }

  const GridMap& ground_;
  const OctileRuns& runs_;
  const Subgoals& subgoals_;
  const HubTrees& trees_;
  const std::vector<Octile>& distances_;
  std::vector<std::uint32_t> numbers_;
};

}  // namespace

std::optional<OctileLists> octile_lists(const GridMap& ground, const OctileRuns& runs,
                                        const Subgoals& subgoals, const HubTrees& trees,
                                        const ListLimits& limits, const std::stop_token& stop) {
  const auto distances = distances_of(subgoals, trees);
  if (!distances) return std::nullopt;
  const RowMaker maker(ground, runs, subgoals, trees, *distances);
  auto rows = tile_rows<OctileTileRow>(ground, limits, stop,
                                       [&](std::span<const Cell> tiles) { return maker.row(tiles); });
  if (!rows) return std::nullopt;
  return OctileLists{nodes_of(subgoals, trees), std::move(*rows)};
}

}  // namespace outrider::hub_labelling
