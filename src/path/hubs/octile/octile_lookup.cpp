// Looks a path along the moves up in the labels of its ends.
#include <algorithm>

#include "octile_index.hpp"

namespace outrider::hub_labelling {
namespace {

/// An end of the query with the row of its list.
struct End {
  Cell cell;
  const OctileTileRow& row;
  unsigned bit = corner_bit(cell);

  [[nodiscard]] Octile distance(const OctilePath& path) const {
    return octile_distance(cell, {path.x, path.y}) + Octile{path.straight, path.diagonal};
  }
};

/// Takes the hubs that two blocks of the same number have in common, until none can be better.
void take_common(const End& start, const HubBlock& a, const End& goal, const HubBlock& b, double least,
                 Meeting& best) {
  for (std::uint64_t bits = a.bits & b.bits; bits != 0 && best.length > least; bits &= bits - 1) {
    const std::uint64_t bit = bits & (~bits + 1);
    const std::size_t i = a.path_of(bit), j = b.path_of(bit);
    if ((start.row.cells[i] & start.bit) == 0 || (goal.row.cells[j] & goal.bit) == 0) continue;
    const OctilePath &from = start.row.paths[i], &to = goal.row.paths[j];
    const double length = (start.distance(from) + goal.distance(to)).value();
    if (length < best.length) best = {length, from.node, to.node};
  }
}

Meeting best_meeting(const End& start, const End& goal) {
  Meeting best;
  const double least = octile_distance(start.cell, goal.cell).value();  // of any path
  const std::span<const HubBlock> from = start.row.at(start.cell.x), to = goal.row.at(goal.cell.x);
  auto a = from.begin(), b = to.begin();
  while (a != from.end() && b != to.end() && best.length > least) {
    if (a->block == b->block) {
      for (auto copy = b; copy != to.end() && copy->block == a->block; ++copy)
        take_common(start, *a, goal, *copy, least, best);
      ++a;
    } else {
      a->block < b->block ? ++a : ++b;
    }
  }
  return best;
}

/// Adds the path from the last cell of `way` over a node to its hub. The first leg is diagonal first, the
/// others are diagonal first from their end nearer to the hub. Bends may equal an end of their leg.
void add_path(std::vector<Cell>& way, const StoredArray<OctileNode>& nodes, const OctileNode* node) {
  way.push_back(bend_of(way.back(), node->cell()));
  way.push_back(node->cell());
  for (const OctileNode* next = &nodes[node->next]; next != node; next = &nodes[node->next]) {
    way.push_back(bend_of(next->cell(), node->cell()));
    way.push_back(next->cell());
    node = next;
  }
}

}  // namespace

bool find_in(const OctileLists& labels, Cell start, Cell goal, std::vector<Cell>& way) {
  const auto row_of = [&](Cell cell) -> const OctileTileRow& {
    return labels.rows[static_cast<std::size_t>(cell.y / tile_side)];
  };
  const Meeting meeting = best_meeting({start, row_of(start)}, {goal, row_of(goal)});
  if (!(meeting.length < std::numeric_limits<double>::infinity())) return false;
  add_path(way, labels.nodes, &labels.nodes[meeting.start_node]);
  const auto hub = static_cast<std::ptrdiff_t>(way.size());
  way.push_back(goal);
  add_path(way, labels.nodes, &labels.nodes[meeting.goal_node]);
  way.pop_back();  // the hub again
  std::reverse(way.begin() + hub, way.end());
  return true;
}

}  // namespace outrider::hub_labelling
