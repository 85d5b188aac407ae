#include "outrider/path/mesh/mesh.hpp"

#include <algorithm>

#include "mesh_add.hpp"
#include "mesh_blocks.hpp"

namespace outrider {
namespace {

template <class T>
std::size_t bytes(const std::vector<T>& v) {
  return v.capacity() * sizeof(T);
}

}  // namespace

void NavigationMesh::polygons_at(Cell corner, Cell free_cell, const GridFrame& frame,
                                 std::vector<std::uint32_t>& found) const {
  // In half cells, from the centre of the cell to its corner. This segment touches no lattice corner but its
  // last point.
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
      if (sides[s].polygon != NavigationMesh::none && on_side(sides[s].at, end_of(p, s)))
        add(sides[s].polygon);
    }
  }
}

std::size_t NavigationMesh::memory() const {
  return bytes(sides) + bytes(first) + bytes(turns) + bytes(around) + bytes(polygon_of) + bytes(up) +
         bytes(order) + bytes(top) + bytes(core);
}

NavigationMesh navigation_mesh(const GridMap& ground, const std::stop_token& stop) {
  const Triangulation cut = cut_into_triangles(ground, stop);
  const ConvexPolygons polygons = join_triangles(cut, stop);
  NavigationMesh mesh;
  if (stop.stop_requested()) return mesh;
  mesh.polygon_of.assign(ground.frame.size(), NavigationMesh::none);
  add_polygons(mesh, ground, cut.corners, polygons, {}, stop);
  if (!stop.stop_requested()) find_blocks(mesh, stop);
  if (stop.stop_requested()) return {};
  return mesh;
}

}  // namespace outrider
