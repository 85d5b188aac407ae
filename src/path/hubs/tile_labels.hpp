// Hub labels of all vertices of a grid at which a path may start or end, tile by tile.
//
// A vertex reaches a hub over a turn to which a free leg leads: first the leg, then the path given by the
// label of the turn. For each hub the shortest path is kept, and only if no earlier hub lies on an equally
// short one. Two vertices whose shortest path turns then share a hub on such a path, unless they are not
// connected. The 16 vertices of a tile have much in common, so they share a list in which each entry tells to
// which vertices it belongs. Tiles are independent of each other.
#pragma once

#include <algorithm>
#include <bit>
#include <limits>
#include <stop_token>
#include <tuple>
#include <vector>

#include "hub_trees.hpp"
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

/// Calls end_tile(labels) for each tile of a row of tiles, from the left.
template <class Reach, class EndTile>
void each_tile(int low_y, const GridMap& ground, TileLabels<Reach>& labels, EndTile end_tile) {
  for (int low_x = 0; low_x <= ground.frame.width; low_x += tile_side) {
    for (int y = low_y; y < low_y + tile_side; ++y) {
      for (int x = low_x; x < low_x + tile_side; ++x) {
        if (ground.place({x, y})) labels.add({x, y});
      }
    }
    end_tile(labels.list());
  }
}

/// Total of the work of rows after which no more of them are built.
inline constexpr std::uint64_t most_work = std::uint64_t{1} << 34U;

/// Builds the rows of tiles by `row_of(low_y)` from the lowest up, in parallel, as many as fit into
/// `most_bytes` and `most_work`. Ends early if `stop` is requested. A row has memory(), bytes, and `work`,
/// the labels visited; one that was not built is empty.
template <class Row, class RowOf>
std::vector<Row> tile_rows(const GridMap& ground, std::size_t most_bytes, const std::stop_token& stop,
                           RowOf row_of) {
  constexpr std::size_t block = 8;  // rows between two looks at the memory
  std::vector<Row> rows(static_cast<std::size_t>(ground.frame.height / tile_side) + 1);
  std::size_t bytes = 0;
  std::uint64_t work = 0;
  for (std::size_t low = 0; low < rows.size() && work < most_work && !stop.stop_requested(); low += block) {
    const std::size_t high = std::min(rows.size(), low + block);
    parallel_for(high - low,
                 [&](std::size_t k) { rows[low + k] = row_of(static_cast<int>(low + k) * tile_side); });
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
