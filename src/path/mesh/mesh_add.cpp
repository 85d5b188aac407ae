#include "mesh_add.hpp"

#include <algorithm>
#include <cmath>

namespace outrider {
namespace {

/// Returns the quadrant of the only blocked cell around a corner, or none.
std::uint32_t only_blocked(const GridMap& ground, Cell v) {
  std::uint32_t only = NavigationMesh::none;
  for (unsigned q = 0; q < 4; ++q) {
    const Cell cell{v.x - ((q & 1U) != 0 ? 0 : 1), v.y - ((q & 2U) != 0 ? 0 : 1)};
    if ((ground.marks[ground.index(cell)] & GridMap::blocked_bit) == 0) continue;
    if (only != NavigationMesh::none) return NavigationMesh::none;
    only = q;
  }
  return only;
}

/// Assigns to a polygon the cells whose centres lie in it, row by row between its left and right border.
/// Centres of other cells are at least half a cell away from the border.
class CellsOf {
 public:
  CellsOf(NavigationMesh& mesh, const GridFrame& frame) : mesh_(mesh), frame_(frame) {}

  void give(std::uint32_t polygon) {
    const std::uint32_t begin = mesh_.first[polygon], end = mesh_.first[polygon + 1];
    int low = mesh_.sides[begin].at.y, high = low;
    for (std::uint32_t s = begin; s < end; ++s) {
      low = std::min(low, mesh_.sides[s].at.y);
      high = std::max(high, mesh_.sides[s].at.y);
    }
    if (left_.size() < static_cast<std::size_t>(high - low)) {
      left_.resize(static_cast<std::size_t>(high - low));
      right_.resize(left_.size());
    }
    for (std::uint32_t s = begin; s < end; ++s) {
      const Cell a = mesh_.sides[s].at, b = mesh_.sides[s + 1 == end ? begin : s + 1].at;
      std::vector<double>& border = b.y > a.y ? right_ : left_;
      const double slope = a.y == b.y ? 0.0 : static_cast<double>(b.x - a.x) / (b.y - a.y);
      for (int y = std::min(a.y, b.y); y < std::max(a.y, b.y); ++y)
        border[static_cast<std::size_t>(y - low)] = a.x + slope * (y + 0.5 - a.y);
    }
    for (int y = low; y < high; ++y) {
      const auto row = static_cast<std::size_t>(y - low);
      const int first = static_cast<int>(std::ceil(left_[row] - 0.5 - 1e-9));
      const int last = static_cast<int>(std::floor(right_[row] - 0.5 + 1e-9));
      if (first > last) continue;
      std::fill_n(mesh_.polygon_of.begin() + static_cast<std::ptrdiff_t>(frame_.index({first, y})),
                  last - first + 1, polygon);
    }
  }

 private:
  NavigationMesh& mesh_;
  const GridFrame& frame_;
  std::vector<double> left_, right_;  // by row, from the lowest of the polygon
};

/// Sets the turns of the sides from `begin` on, and adds their polygons to those around them.
void add_turns(NavigationMesh& mesh, const GridMap& ground, const std::vector<Cell>& corners,
               const ConvexPolygons& polygons, std::uint32_t begin, std::uint32_t polygons_before,
               const std::vector<std::uint32_t>& known, const std::stop_token& stop) {
  std::vector<std::uint32_t> turn_of(corners.size(), NavigationMesh::no_turn), blocked_at(corners.size(), 0);
  std::vector<std::uint32_t> more(corners.size(), 0);
  for (const ConvexPolygons::Side& side : polygons.sides) ++more[side.corner];
  for (std::size_t i = 0; i < corners.size(); ++i) {
    if (stop.stop_requested()) return;
    const std::uint32_t blocked = only_blocked(ground, corners[i]);
    if (blocked == NavigationMesh::none) continue;
    turn_of[i] = known.empty() ? NavigationMesh::no_turn : known[i];
    if (turn_of[i] == NavigationMesh::no_turn) {
      turn_of[i] = static_cast<std::uint32_t>(mesh.turns.size());
      mesh.turns.push_back({corners[i], 0, 0});
    }
    blocked_at[i] = blocked;
    NavigationMesh::Turn& turn = mesh.turns[turn_of[i]];
    const auto from = static_cast<std::ptrdiff_t>(turn.around);
    turn.around = static_cast<std::uint32_t>(mesh.around.size());
    mesh.around.resize(mesh.around.size() + turn.polygons + more[i]);
    std::copy_n(mesh.around.begin() + from, turn.polygons, mesh.around.begin() + turn.around);
  }
  for (std::uint32_t s = begin; s < mesh.sides.size(); ++s) {
    const ConvexPolygons::Side& side = polygons.sides[s - begin];
    mesh.sides[s].turn = turn_of[side.corner] & NavigationMesh::no_turn;
    mesh.sides[s].blocked = blocked_at[side.corner] & 3U;
    if (mesh.sides[s].turn == NavigationMesh::no_turn) continue;
    NavigationMesh::Turn& turn = mesh.turns[mesh.sides[s].turn];
    mesh.around[turn.around + turn.polygons++] = {polygons_before + side.polygon, s};
  }
}

}  // namespace

void add_polygons(NavigationMesh& mesh, const GridMap& ground, const std::vector<Cell>& corners,
                  const ConvexPolygons& polygons, const std::vector<std::uint32_t>& known,
                  const std::stop_token& stop) {
  const auto begin = static_cast<std::uint32_t>(mesh.sides.size());
  const auto before = static_cast<std::uint32_t>(mesh.polygons());
  mesh.sides.reserve(begin + polygons.sides.size());
  for (const ConvexPolygons::Side& side : polygons.sides) {
    const bool open = side.behind != ConvexPolygons::no_side;
    mesh.sides.push_back({corners[side.corner],
                          open ? before + polygons.sides[side.behind].polygon : NavigationMesh::none,
                          open ? begin + side.behind : NavigationMesh::none, NavigationMesh::none,
                          NavigationMesh::no_turn, 0});
  }
  for (std::size_t p = 1; p < polygons.first.size(); ++p) mesh.first.push_back(begin + polygons.first[p]);
  add_turns(mesh, ground, corners, polygons, begin, before, known, stop);
  CellsOf cells(mesh, ground.frame);
  for (std::uint32_t p = before; p < mesh.polygons() && !stop.stop_requested(); ++p) cells.give(p);
}

}  // namespace outrider
