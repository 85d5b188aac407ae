#include "forced_turns.hpp"

#include <algorithm>
#include <cstdlib>

namespace outrider::polyanya_search {
namespace {

/// Returns the only side of a polygon towards the root of its tree; none if there is none or more than one.
std::uint32_t only_side_up(const NavigationMesh& mesh, std::uint32_t polygon) {
  std::uint32_t only = NavigationMesh::none;
  for (std::uint32_t s = mesh.first[polygon]; s < mesh.first[polygon + 1]; ++s) {
    if (mesh.sides[s].polygon == NavigationMesh::none || mesh.sides[s].block != mesh.up[polygon]) continue;
    if (only != NavigationMesh::none) return NavigationMesh::none;
    only = s;
  }
  return only;
}

/// Returns true if a is nearer than b, which lies in line with it.
bool nearer(Arrow a, Arrow b) { return std::abs(a.x) + std::abs(a.y) < std::abs(b.x) + std::abs(b.y); }

/// A corner of a side, as seen.
struct Edge {
  Arrow way;
  std::uint32_t turn = NavigationMesh::no_turn;
};

}  // namespace

void ForcedTurns::find(const NavigationMesh& mesh, const std::stop_token& stop) {
  std::vector<std::uint32_t> by_order(mesh.polygons(), NavigationMesh::none), behind(mesh.polygons(), 0);
  for (std::uint32_t p = 0; p < mesh.polygons(); ++p) {
    if (!mesh.is_gone(p)) by_order[mesh.order[p]] = p;
  }
  std::erase(by_order, NavigationMesh::none);
  last_ = mesh.order;
  up_.assign(mesh.polygons(), NavigationMesh::none);
  for (const std::uint32_t p : by_order) up_[p] = only_side_up(mesh, p);
  for (auto p = by_order.rbegin(); p != by_order.rend(); ++p) {
    last_[*p] = mesh.order[*p] + behind[*p];
    if (mesh.up[*p] != NavigationMesh::none) behind[mesh.top[mesh.up[*p]]] += behind[*p] + 1;
  }

  after_.assign(mesh.turns.size(), {});
  for (std::uint32_t turn = 0; turn < mesh.turns.size() && !stop.stop_requested(); ++turn) {
    const auto& [at, around, polygons] = mesh.turns[turn];
    if (polygons == 0) continue;
    const auto begin = mesh.around.begin() + around;
    const auto first = std::min_element(begin, begin + polygons, [&](const auto& a, const auto& b) {
      return mesh.order[a.polygon] < mesh.order[b.polygon];
    });
    after_[turn] = from(mesh, at, first->polygon);
  }
}

ForcedTurn ForcedTurns::from(const NavigationMesh& mesh, Cell corner, std::uint32_t polygon) const {
  Edge right, left;
  const auto forced = [&](const Edge& edge) {
    return ForcedTurn{edge.turn, mesh.order[polygon], last_[polygon]};
  };
  for (bool begins = true;; begins = false) {
    const std::uint32_t s = up_[polygon];
    if (s == NavigationMesh::none) return {};
    const std::uint32_t next = s + 1 == mesh.first[polygon + 1] ? mesh.first[polygon] : s + 1;
    const NavigationMesh::Side &from = mesh.sides[s], &to = mesh.sides[next];
    const Edge now_right{arrow(corner, from.at), from.turn}, now_left{arrow(corner, to.at), to.turn};
    if (begins && turned(now_right.way, now_left.way) == 0)  // the corner lies in line with the side
      return forced(nearer(now_right.way, now_left.way) ? now_right : now_left);
    if (!begins && turned(left.way, now_right.way) >= 0) return forced(left);
    if (!begins && turned(now_left.way, right.way) >= 0) return forced(right);
    if (begins || turned(right.way, now_right.way) > 0) right = now_right;
    if (begins || turned(now_left.way, left.way) > 0) left = now_left;
    polygon = from.polygon;
  }
}

}  // namespace outrider::polyanya_search
