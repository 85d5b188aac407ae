#include "outrider/path/mesh.hpp"

#include <algorithm>
#include <cmath>

#include "mesh_blocks.hpp"
#include "mesh_polygons.hpp"

namespace outrider {
namespace {

constexpr std::uint32_t none = NavigationMesh::none;
using Side = NavigationMesh::Side;

/// The quadrant of the only blocked cell around a corner, or none.
std::uint32_t only_blocked(const GridGround& ground, Cell v) {
  std::uint32_t only = none;
  for (unsigned q = 0; q < 4; ++q) {
    const Cell cell{v.x - ((q & 1U) != 0 ? 0 : 1), v.y - ((q & 2U) != 0 ? 0 : 1)};
    if ((ground.marks[ground.index(cell)] & GridGround::blocked_bit) == 0) continue;
    if (only != none) return none;
    only = q;
  }
  return only;
}

/// Gives the cells whose centres lie in a polygon to it: row by row between its left and right border. Those
/// of other cells are half a cell away from there.
void fill(NavigationMesh& mesh, const GridFrame& frame, std::uint32_t polygon, std::vector<double>& left,
          std::vector<double>& right) {
  const std::uint32_t begin = mesh.first[polygon], end = mesh.first[polygon + 1];
  int low = mesh.sides[begin].at.y, high = low;
  for (std::uint32_t s = begin; s < end; ++s) {
    low = std::min(low, mesh.sides[s].at.y);
    high = std::max(high, mesh.sides[s].at.y);
  }
  for (std::uint32_t s = begin; s < end; ++s) {
    const Cell a = mesh.sides[s].at, b = mesh.sides[s + 1 == end ? begin : s + 1].at;
    std::vector<double>& border = b.y > a.y ? right : left;
    const double slope = a.y == b.y ? 0.0 : static_cast<double>(b.x - a.x) / (b.y - a.y);
    for (int y = std::min(a.y, b.y); y < std::max(a.y, b.y); ++y) {
      border[static_cast<std::size_t>(y)] = a.x + slope * (y + 0.5 - a.y);
    }
  }
  for (int y = low; y < high; ++y) {
    const auto row = static_cast<std::size_t>(y);
    const int first = static_cast<int>(std::ceil(left[row] - 0.5 - 1e-9));
    const int last = static_cast<int>(std::floor(right[row] - 0.5 + 1e-9));
    if (first > last) continue;
    std::fill_n(mesh.polygon_of.begin() + static_cast<std::ptrdiff_t>(frame.index({first, y})),
                last - first + 1, polygon);
  }
}

void locate(NavigationMesh& mesh, const GridGround& ground) {
  mesh.polygon_of.assign(ground.frame.size(), none);
  std::vector<double> left(static_cast<std::size_t>(ground.frame.height)), right(left);
  for (std::uint32_t p = 0; p + 1 < mesh.first.size(); ++p) fill(mesh, ground.frame, p, left, right);
}

/// Turns, in the order of the corners, and the polygons around each.
void add_turns(NavigationMesh& mesh, const GridGround& ground, const std::vector<Cell>& corners,
               const ConvexPolygons& polygons) {
  std::vector<std::uint32_t> turn_of(corners.size(), NavigationMesh::no_turn), blocked_at(corners.size(), 0);
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const std::uint32_t blocked = only_blocked(ground, corners[i]);
    if (blocked == none) continue;
    turn_of[i] = static_cast<std::uint32_t>(mesh.turns.size());
    blocked_at[i] = blocked;
    mesh.turns.push_back({corners[i], 0});
  }
  mesh.turns.emplace_back();
  for (std::size_t s = 0; s < mesh.sides.size(); ++s) {
    const std::uint32_t corner = polygons.sides[s].corner;
    mesh.sides[s].turn = turn_of[corner] & NavigationMesh::no_turn;
    mesh.sides[s].blocked = blocked_at[corner] & 3U;
    if (mesh.sides[s].turn != NavigationMesh::no_turn) ++mesh.turns[mesh.sides[s].turn + 1].around;
  }
  for (std::size_t t = 1; t < mesh.turns.size(); ++t) mesh.turns[t].around += mesh.turns[t - 1].around;
  mesh.around.resize(mesh.turns.back().around);
  for (std::size_t s = mesh.sides.size(); s-- > 0;) {
    const std::uint32_t turn = mesh.sides[s].turn;
    if (turn != NavigationMesh::no_turn)
      mesh.around[--mesh.turns[turn + 1].around] = {polygons.sides[s].polygon, static_cast<std::uint32_t>(s)};
  }
  for (std::size_t t = 0; t + 1 < mesh.turns.size(); ++t) mesh.turns[t].around = mesh.turns[t + 1].around;
  mesh.turns.back().around = static_cast<std::uint32_t>(mesh.around.size());
}

template <class T>
std::size_t bytes(const std::vector<T>& v) {
  return v.capacity() * sizeof(T);
}

}  // namespace

void NavigationMesh::polygons_at(Cell corner, Cell free_cell, const GridFrame& frame,
                                 std::vector<std::uint32_t>& found) const {
  // In half cells, from the centre of the cell to its corner: the way touches no corner but its last.
  const std::int64_t from_x = 2 * free_cell.x + 1, from_y = 2 * free_cell.y + 1;
  const std::int64_t to_x = 2 * corner.x, to_y = 2 * corner.y;
  const auto left_of = [](Cell a, Cell b, std::int64_t x, std::int64_t y) {
    return (b.x - a.x) * (y - 2 * a.y) - (b.y - a.y) * (x - 2 * a.x);
  };
  const auto end_of = [&](std::uint32_t polygon, std::uint32_t s) {
    return sides[s + 1 == first[polygon + 1] ? first[polygon] : s + 1].at;
  };
  const auto on_way = [&](Cell v) {
    return (to_x - from_x) * (2 * v.y - from_y) - (to_y - from_y) * (2 * v.x - from_x);
  };
  std::uint32_t polygon = polygon_of[frame.index(free_cell)];
  for (bool inside = false; !inside;) {
    inside = true;
    for (std::uint32_t s = first[polygon]; s < first[polygon + 1]; ++s) {
      const Cell a = sides[s].at, b = end_of(polygon, s);
      if (left_of(a, b, to_x, to_y) >= 0 || on_way(a) > 0 || on_way(b) < 0) continue;
      polygon = sides[s].polygon;
      inside = false;
      break;
    }
  }
  const auto add = [&found](std::uint32_t p) {
    if (std::find(found.begin(), found.end(), p) == found.end()) found.push_back(p);
  };
  const auto on_side = [&](Cell a, Cell b) {
    return left_of(a, b, to_x, to_y) == 0 && std::min(a.x, b.x) <= corner.x &&
           corner.x <= std::max(a.x, b.x) && std::min(a.y, b.y) <= corner.y && corner.y <= std::max(a.y, b.y);
  };
  std::size_t next = found.size();
  add(polygon);
  for (; next < found.size(); ++next) {
    const std::uint32_t p = found[next];
    for (std::uint32_t s = first[p]; s < first[p + 1]; ++s) {
      if (sides[s].polygon != none && on_side(sides[s].at, end_of(p, s))) add(sides[s].polygon);
    }
  }
}

std::size_t NavigationMesh::memory() const {
  return bytes(sides) + bytes(first) + bytes(turns) + bytes(around) + bytes(polygon_of) + bytes(part) +
         bytes(up) + bytes(depth) + bytes(top);
}

NavigationMesh navigation_mesh(const GridGround& ground) {
  const Triangulation cut = cut_into_triangles(ground);
  const ConvexPolygons polygons = join_triangles(cut);
  NavigationMesh mesh;
  mesh.first = polygons.first;
  mesh.sides.reserve(polygons.sides.size());
  for (const ConvexPolygons::Side& side : polygons.sides) {
    const bool open = side.behind != ConvexPolygons::no_side;
    mesh.sides.push_back({cut.corners[side.corner], open ? polygons.sides[side.behind].polygon : none,
                          side.behind, none, NavigationMesh::no_turn, 0});
  }
  add_turns(mesh, ground, cut.corners, polygons);
  locate(mesh, ground);
  find_blocks(mesh);
  return mesh;
}

}  // namespace outrider
