// Hub labels of all vertices of a grid at which a path may start or end, tile by tile.
//
// A vertex reaches a hub over a turn to which a free leg leads: first the leg, then the path given by the
// label of the turn. For each hub the shortest path is kept, and only if no earlier hub lies on an equally
// short one. Two vertices whose shortest path turns then share a hub on such a path, unless they are not
// connected. The 16 vertices of a tile have much in common, so they share a list in which each entry tells to
// which vertices it belongs. Tiles are independent of each other.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <limits>
#include <optional>
#include <span>
#include <stop_token>
#include <tuple>
#include <vector>

#include "hubs/any_angle/hub_trees.hpp"
#include "outrider/core/parallel.hpp"

namespace outrider::hub_labelling {

inline constexpr int tile_side = 4;  // vertices

/// Returns the bit of a vertex in its tile.
inline unsigned corner_bit(Cell corner) {
  return 1U << static_cast<unsigned>(corner.y % tile_side * tile_side + corner.x % tile_side);
}

/// The label of some vertices of a tile.
struct TileLabel {
  std::uint32_t hub = 0;      ///< its rank
  std::uint32_t node = 0;     ///< node of the turn on the path to the hub
  std::uint16_t corners = 0;  ///< a bit for each vertex to which the label belongs
};

/// Finds the labels of some vertices of a tile: O(labels of the turns reached) for each.
///
/// `Reach` has labels_from(vertex, take), which calls take(leg, label) for each label of each turn to which a
/// leg leads, and returns the number of turns; the leg is in cells. It may omit labels over a turn that are
/// not on a shortest path.
template <class Reach>
class TileLabels {
 public:
  TileLabels(const HubTrees& trees, Reach reach)
      : trees_(trees),
        reach_(std::move(reach)),
        ways_(trees.hubs.size(), Way{}),
        kept_(trees.hubs.size(), far),
        met_((trees.hubs.size() + 63) / 64),
        witness_(trees.hubs.size(), nullptr) {}

  void add(Cell corner) {
    gather(corner);
    const auto bit = static_cast<std::uint16_t>(corner_bit(corner));
    each_met([&](std::uint32_t hub) {
      if (known(hub)) return;
      kept_[hub] = ways_[hub].distance;
      found_.push_back({hub, ways_[hub].node, bit});
    });
    each_met([&](std::uint32_t hub) {
      ways_[hub] = {};
      kept_[hub] = far;
    });
    std::fill(met_.begin(), met_.end(), 0);
  }

  /// Returns the labels of the vertices added since the last call, by rank of the hub; valid until the next
  /// call.
  const std::vector<TileLabel>& list() {
    const auto key = [](const TileLabel& label) { return std::tie(label.hub, label.node); };
    std::sort(found_.begin(), found_.end(),
              [&](const TileLabel& a, const TileLabel& b) { return key(a) < key(b); });
    list_.clear();
    for (const TileLabel& label : found_) {
      if (list_.empty() || key(list_.back()) != key(label)) list_.push_back(label);
      list_.back().corners = static_cast<std::uint16_t>(list_.back().corners | label.corners);
    }
    found_.clear();
    return list_;
  }
  /// Returns the number of labels and turns visited so far.
  [[nodiscard]] std::uint64_t work() const { return work_; }

 private:
  static constexpr double far = std::numeric_limits<double>::infinity();
  struct Way {
    double distance = far;
    std::uint32_t node = 0;
  };

  template <class Visit>
  void each_met(Visit visit) const {
    for (std::size_t word = 0; word < met_.size(); ++word) {
      for (std::uint64_t bits = met_[word]; bits != 0; bits &= bits - 1)
        visit(static_cast<std::uint32_t>(64 * word) + static_cast<std::uint32_t>(std::countr_zero(bits)));
    }
  }

  void gather(Cell corner) {
    work_ += reach_.labels_from(corner, [this](double leg, const HubTrees::HubLabel& label) {
      ++work_;
      Way& way = ways_[label.hub];
      if (!(leg + label.distance < way.distance)) return;
      met_[label.hub / 64] |= std::uint64_t{1} << label.hub % 64;
      way = {leg + label.distance, label.node};
    });
  }

  /// Returns true if an earlier hub lies on a path as short. Neighbouring vertices mostly share this hub.
  bool known(std::uint32_t hub) {
    const double enough = ways_[hub].distance * (1.0 + equal_within);
    const auto covers = [&](const HubTrees::HubLabel& label) {
      return kept_[label.hub] + label.distance <= enough;
    };
    if (witness_[hub] != nullptr && covers(*witness_[hub])) return true;
    for (const HubTrees::HubLabel& label : trees_.labels[trees_.hubs[hub]]) {
      if (label.distance > enough) return false;  // so are those that follow
      ++work_;
      if (!covers(label)) continue;
      witness_[hub] = &label;
      return true;
    }
    return false;
  }

  const HubTrees& trees_;
  Reach reach_;
  std::vector<Way> ways_;     ///< by hub; infinite where there is none
  std::vector<double> kept_;  ///< by hub: the distance of a label that is kept, else infinite
  std::uint64_t work_ = 0;
  std::vector<std::uint64_t> met_;                  ///< a bit for each hub
  std::vector<const HubTrees::HubLabel*> witness_;  ///< by hub: what made it known last
  std::vector<TileLabel> found_, list_;
};

/// Calls end_tile(low, labels) for each tile, by its lowest vertex.
template <class Reach, class EndTile>
void each_tile(std::span<const Cell> tiles, const GridMap& ground, TileLabels<Reach>& labels,
               EndTile end_tile) {
  for (const Cell low : tiles) {
    for (int y = low.y; y < low.y + tile_side; ++y) {
      for (int x = low.x; x < low.x + tile_side; ++x) {
        if (ground.place({x, y})) labels.add({x, y});
      }
    }
    end_tile(low, labels.list());
  }
}

/// Limits of the lists of a ground.
struct ListLimits {
  std::size_t bytes = 0;
  std::uint64_t work = 0;  ///< labels and turns visited
};

/// Number of rows of tiles, and of tiles in each.
inline std::size_t tile_rows_of(const GridMap& ground) {
  return static_cast<std::size_t>(ground.frame.height / tile_side) + 1;
}
inline std::size_t tile_columns_of(const GridMap& ground) {
  return static_cast<std::size_t>(ground.frame.width / tile_side) + 1;
}

/// Returns true if the lists of all tiles probably keep the limits, by a sample of 256 tiles strewn over the
/// ground.
template <class RowOf>
bool probably_within(const ListLimits& limits, const GridMap& ground, RowOf row_of) {
  constexpr std::size_t most_samples = 256, tasks = 8;
  constexpr std::size_t stride = 0x9E3779B1;  // a prime: near the golden ratio of 2^32, so tiles are strewn
  const std::size_t columns = tile_columns_of(ground), tiles = columns * tile_rows_of(ground);
  const std::size_t samples = std::min(most_samples, tiles);
  std::array<ListLimits, tasks> used{};
  parallel_for(tasks, [&](std::size_t task) {
    std::vector<Cell> lows;
    for (std::size_t k = task; k < samples; k += tasks) {
      const std::size_t tile = samples == tiles ? k : k * stride % tiles;
      lows.push_back(
          {static_cast<int>(tile % columns) * tile_side, static_cast<int>(tile / columns) * tile_side});
    }
    const auto row = row_of(lows);
    used[task] = {row.memory(), row.work};
  });
  ListLimits sum;
  for (const ListLimits& part : used) sum = {sum.bytes + part.bytes, sum.work + part.work};
  const double times = static_cast<double>(tiles) / static_cast<double>(samples);
  return static_cast<double>(sum.bytes) * times <= static_cast<double>(limits.bytes) &&
         static_cast<double>(sum.work) * times <= static_cast<double>(limits.work);
}

/// Builds all rows of tiles by `row_of(tiles)`, in parallel. A row has memory(), bytes, and `work`, the
/// labels visited. Returns nothing if the rows do not keep the limits, mostly after a small sample of the
/// tiles, or if `stop` is requested.
template <class Row, class RowOf>
std::optional<std::vector<Row>> tile_rows(const GridMap& ground, const ListLimits& limits,
                                          const std::stop_token& stop, RowOf row_of) {
  constexpr std::size_t block = 8;  // rows between two looks at the limits
  if (!probably_within(limits, ground, row_of)) return std::nullopt;
  std::vector<Row> rows(tile_rows_of(ground));
  ListLimits used;
  for (std::size_t low = 0; low < rows.size(); low += block) {
    const std::size_t high = std::min(rows.size(), low + block);
    parallel_for(high - low, [&](std::size_t k) {
      std::vector<Cell> tiles(tile_columns_of(ground));
      for (std::size_t x = 0; x < tiles.size(); ++x)
        tiles[x] = {static_cast<int>(x) * tile_side, static_cast<int>(low + k) * tile_side};
      rows[low + k] = row_of(tiles);
    });
    for (std::size_t y = low; y < high; ++y) used = {used.bytes + rows[y].memory(), used.work + rows[y].work};
    if (used.bytes > limits.bytes || used.work > limits.work || stop.stop_requested()) return std::nullopt;
  }
  return rows;
}

}  // namespace outrider::hub_labelling
