// Looks a path up in the labels of its ends.
#include <algorithm>

#include "any_angle_index.hpp"

namespace outrider::hub_labelling {
namespace {

/// The list of a tile, read by one of its corners.
struct Reading {
  Reading(const TileList& list, Cell of)
      : next(list.entries.data()),
        end(next + list.entries.size()),
        turns(list.turns.data()),
        corner(of),
        bit(corner_bit(of)) {}
  [[nodiscard]] bool mine() const { return (next->corners & bit) != 0; }
  /// Returns the distance to the hub, cells.
  [[nodiscard]] double distance() const {
    return length_between(corner, turns[next->turn]) + static_cast<double>(next->beyond);
  }

  const HubEntry* next;
  const HubEntry* end;
  const Cell* turns;
  Cell corner;
  unsigned bit;
};

class Query {
 public:
  Query(const AnyAngleLabels& labels, Cell start, Cell goal)
      : labels_(labels), nodes_(labels.nodes.all()), start_(start), goal_(goal) {}

  bool find_way(std::vector<Cell>& way) const {
    const Meeting meeting = best_meeting();
    if (!(meeting.length < std::numeric_limits<double>::infinity())) return false;
    for (std::uint32_t node = meeting.start_node;; node = nodes_[node].next) {
      way.push_back(at(node));
      if (nodes_[node].next == node) break;
    }
    const auto middle = static_cast<std::ptrdiff_t>(way.size());
    for (std::uint32_t node = meeting.goal_node; nodes_[node].next != node; node = nodes_[node].next)
      way.push_back(at(node));
    std::reverse(way.begin() + middle, way.end());
    way.push_back(goal_);
    return true;
  }

 private:
  [[nodiscard]] Cell at(std::uint32_t node) const { return labels_.turns[nodes_[node].turn]; }
  [[nodiscard]] TileList list_of(Cell corner) const {
    return labels_.rows[static_cast<std::size_t>(corner.y / tile_side)].at(corner.x);
  }
  [[nodiscard]] Meeting exactly(Meeting meeting) const {
    meeting.length = length_between(start_, at(meeting.start_node)) + nodes_[meeting.start_node].distance +
                     nodes_[meeting.goal_node].distance + length_between(at(meeting.goal_node), goal_);
    return meeting;
  }

  /// Finds the best meeting. Distances in the lists are rounded, so those close to the least are computed
  /// again.
  [[nodiscard]] Meeting best_meeting() const {
    constexpr double rounding = 1.0 + 4.0 * std::numeric_limits<float>::epsilon();
    Reading from(list_of(start_), start_);
    Reading to(list_of(goal_), goal_);
    Meeting best;
    double least = std::numeric_limits<double>::infinity();
    while (from.next != from.end && to.next != to.end) {
      const std::uint32_t hub = from.next->hub, other = to.next->hub;
      if (hub == other && from.mine() && to.mine()) {
        const double rounded = from.distance() + to.distance();
        if (rounded <= least * rounding) {
          least = std::min(least, rounded);
          const Meeting meeting = exactly({0.0, from.next->node, to.next->node});
          if (meeting.length < best.length) best = meeting;
        }
      }
      const bool advance = hub < other || (hub == other && !from.mine());
      from.next += advance ? 1 : 0;
      to.next += advance ? 0 : 1;
    }
    return best;
  }

  const AnyAngleLabels& labels_;
  std::span<const HubTrees::HubNode> nodes_;
  Cell start_, goal_;
};

}  // namespace

bool AnyAngleLabels::find(Cell start, Cell goal, std::vector<Cell>& way) const {
  return Query(*this, start, goal).find_way(way);
}

}  // namespace outrider::hub_labelling
