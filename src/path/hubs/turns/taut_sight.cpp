#include "taut_sight.hpp"

#include <algorithm>

namespace outrider::hub_labelling {

const std::vector<std::uint32_t>& TautSight::seen_from(Cell corner, bool taut) {
  corner_ = corner;
  taut_ = taut;
  seen_.clear();
  around_.clear();
  for (unsigned q = 0; q < 4; ++q) {
    const Cell cell{corner.x - ((q & 1U) != 0 ? 0 : 1), corner.y - ((q & 2U) != 0 ? 0 : 1)};
    if (!ground_.blocked(cell)) mesh_.polygons_at(corner, cell, ground_.frame, around_);
  }
  for (const std::uint32_t polygon : around_) look_everywhere(polygon);
  while (!cones_.empty()) {
    const Cone cone = cones_.back();
    cones_.pop_back();
    look_through(cone);
  }
  std::sort(seen_.begin(), seen_.end());
  seen_.erase(std::unique(seen_.begin(), seen_.end()), seen_.end());
  return seen_;
}

void TautSight::see(const NavigationMesh::Side& side, Arrow way) {
  if (side.turn == NavigationMesh::no_turn || (way.x == 0 && way.y == 0)) return;
  if (!taut_ || Winding(side.blocked).side({way.x, way.y}) != Winding::Side::neither)
    seen_.push_back(side.turn);
}

void TautSight::look_everywhere(std::uint32_t polygon) {
  for (std::uint32_t s = mesh_.first[polygon]; s < mesh_.first[polygon + 1]; ++s) {
    const NavigationMesh::Side& side = mesh_.sides[s];
    const Arrow from = arrow(side.at), to = arrow(mesh_.sides[after(s, polygon)].at);
    see(side, from);
    if (side.polygon != NavigationMesh::none && turned(from, to) > 0) {
      cones_.push_back({from, to, side.behind, side.polygon});
    }
  }
}

void TautSight::look_through(const Cone& cone) {
  std::uint32_t s = after(cone.side, cone.polygon);
  Arrow from = arrow(mesh_.sides[s].at);
  bool past_right = turned(cone.right, from) > 0;
  while (s != cone.side) {
    const NavigationMesh::Side& side = mesh_.sides[s];
    s = after(s, cone.polygon);
    const Arrow to = arrow(mesh_.sides[s].at);
    if (turned(from, cone.left) <= 0) return;
    if (past_right) see(side, from);
    const bool next_past_right = turned(cone.right, to) > 0;
    if (next_past_right && side.polygon != NavigationMesh::none && turned(from, to) > 0) {
      cones_.push_back({past_right ? from : cone.right, turned(to, cone.left) > 0 ? to : cone.left,
                        side.behind, side.polygon});
    }
    from = to;
    past_right = next_past_right;
  }
}

}  // namespace outrider::hub_labelling
