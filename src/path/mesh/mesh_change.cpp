#include "mesh_change.hpp"

#include <algorithm>

#include "mesh_add.hpp"
#include "mesh_blocks.hpp"
#include "mesh_sweep.hpp"

namespace outrider {
namespace {

/// Returns true if a side and a cell, both closed, have a point in common.
bool touches(Cell a, Cell b, Cell cell) {
  if (std::max(a.x, b.x) < cell.x || std::min(a.x, b.x) > cell.x + 1) return false;
  if (std::max(a.y, b.y) < cell.y || std::min(a.y, b.y) > cell.y + 1) return false;
  const std::int64_t x = b.x - a.x, y = b.y - a.y;
  const std::int64_t low = x * (cell.y - a.y) - y * (cell.x - a.x);  // > 0 when on its left
  const auto [least, most] = std::minmax({low, low + x, low - y, low + x - y});
  return least <= 0 && most >= 0;
}

/// Returns the one of the four cells around a corner that is on this side of a lattice direction from the
/// corner.
Cell left_of(Cell v, Cell way) { return {v.x + (way.x - way.y - 1) / 2, v.y + (way.x + way.y - 1) / 2}; }
Cell right_of(Cell v, Cell way) { return {v.x + (way.x + way.y - 1) / 2, v.y + (way.y - way.x - 1) / 2}; }

class Change {
 public:
  Change(NavigationMesh& mesh, const GridMap& ground, const std::vector<Cell>& changed)
      : mesh_(mesh), ground_(ground), changed_(changed), block_(add_to_core(mesh)) {}

  bool run(std::size_t most_sides) {
    take_out();
    if (mesh_.sides.size() + sides_taken_ > most_sides) return false;
    for (const std::uint32_t p : taken_) keep_border(p);
    for (const Cell cell : changed_) add_walls(cell);
    const Triangulation cut = cut_region(border_);
    const auto before = static_cast<std::uint32_t>(mesh_.polygons());
    add_polygons(mesh_, ground_, cut.corners, join_triangles(cut), turns_at(cut.corners));
    mesh_.up.resize(mesh_.polygons(), block_);
    mesh_.order.resize(mesh_.polygons(), 0);
    std::sort(rim_.begin(), rim_.end());
    for (std::uint32_t p = before; p < mesh_.polygons(); ++p) link(p);
    return true;
  }

 private:
  /// A side between a removed polygon and one that stays.
  struct Rim {
    Cell from, to;          ///< the removed polygon is on the left
    std::uint32_t polygon;  ///< the polygon that stays
    std::uint32_t side;     ///< index of the side in that polygon
    friend bool operator<(const Rim& a, const Rim& b) {
      return a.from == b.from ? earlier(a.to, b.to) : earlier(a.from, b.from);
    }
  };

  [[nodiscard]] Cell end_of(std::uint32_t polygon, std::uint32_t s) const {
    return mesh_.sides[s + 1 == mesh_.first[polygon + 1] ? mesh_.first[polygon] : s + 1].at;
  }
  /// Returns the polygon of a cell in the old mesh.
  [[nodiscard]] std::uint32_t polygon_of(Cell cell) const {
    return ground_.frame.contains(cell) ? mesh_.polygon_of[ground_.frame.index(cell)] : NavigationMesh::none;
  }

  /// Removes all polygons that touch a changed cell: those at its corners, and those that cross it.
  void take_out() {
    std::vector<Cell> corners;
    for (const Cell c : changed_) {
      for (const Cell v : {c, Cell{c.x + 1, c.y}, Cell{c.x, c.y + 1}, Cell{c.x + 1, c.y + 1}})
        corners.push_back(v);
    }
    std::sort(corners.begin(), corners.end(), earlier);
    corners.erase(std::unique(corners.begin(), corners.end()), corners.end());
    std::vector<std::uint32_t> found;
    for (const Cell v : corners) {
      found.clear();
      for (const Cell c : {v, Cell{v.x - 1, v.y}, Cell{v.x, v.y - 1}, Cell{v.x - 1, v.y - 1}}) {
        const std::uint32_t p = polygon_of(c);
        if (p != NavigationMesh::none && std::find(found.begin(), found.end(), p) == found.end())
          mesh_.polygons_at(v, c, ground_.frame, found);
      }
      for (const std::uint32_t p : found) take_out(p);
    }
    for (const Cell cell : changed_) {
      found.clear();
      if (polygon_of(cell) != NavigationMesh::none) found.push_back(polygon_of(cell));
      for (std::size_t next = 0; next < found.size(); ++next) {
        const std::uint32_t p = found[next];
        take_out(p);
        for (std::uint32_t s = mesh_.first[p]; s < mesh_.first[p + 1]; ++s) {
          const std::uint32_t other = mesh_.sides[s].polygon;
          if (other == NavigationMesh::none || !touches(mesh_.sides[s].at, end_of(p, s), cell)) continue;
          if (std::find(found.begin(), found.end(), other) == found.end()) found.push_back(other);
        }
      }
    }
  }

  void take_out(std::uint32_t polygon) {
    if (mesh_.is_gone(polygon)) return;
    move_to_core(mesh_, polygon, block_);
    mesh_.up[polygon] = NavigationMesh::gone;
    taken_.push_back(polygon);
    sides_taken_ += mesh_.first[polygon + 1] - mesh_.first[polygon];
  }

  /// Keeps the part of the border of a removed polygon that remains a border.
  void keep_border(std::uint32_t polygon) {
    for (std::uint32_t s = mesh_.first[polygon]; s < mesh_.first[polygon + 1]; ++s) {
      const NavigationMesh::Side& side = mesh_.sides[s];
      const Cell from = side.at, to = end_of(polygon, s);
      if (side.polygon == NavigationMesh::none) {
        const Cell way{(to.x > from.x) - (to.x < from.x), (to.y > from.y) - (to.y < from.y)};
        for (Cell v = from; v != to; v = {v.x + way.x, v.y + way.y}) add_wall(v, way);
      } else if (!mesh_.is_gone(side.polygon)) {
        rim_.push_back({from, to, side.polygon, side.behind});
        border_.push_back({from, to});
      }
    }
  }

  /// Adds the new walls at a changed cell.
  void add_walls(Cell cell) {
    const bool blocked = ground_.blocked(cell);
    if (blocked) mesh_.polygon_of[ground_.frame.index(cell)] = NavigationMesh::none;
    Cell v = cell;
    for (Cell way{1, 0}; way != Cell{}; way = way == Cell{0, -1} ? Cell{} : Cell{-way.y, way.x}) {
      const Cell next{v.x + way.x, v.y + way.y};
      if (!blocked) {
        add_wall(v, way);
      } else if (!std::binary_search(changed_.begin(), changed_.end(), right_of(v, way), earlier)) {
        add_wall(next, {-way.x, -way.y});
      }
      v = next;
    }
  }

  /// Adds the wall that begins at this corner. Walls run between corners of obstacles.
  void add_wall(Cell v, Cell way) {
    if (!corner(v) || ground_.blocked(left_of(v, way)) || !ground_.blocked(right_of(v, way))) return;
    Cell end{v.x + way.x, v.y + way.y};
    while (!corner(end)) end = {end.x + way.x, end.y + way.y};
    border_.push_back({v, end});
  }
  [[nodiscard]] bool corner(Cell v) const {
    const bool ne = ground_.blocked(v), nw = ground_.blocked({v.x - 1, v.y});
    const bool se = ground_.blocked({v.x, v.y - 1}), sw = ground_.blocked({v.x - 1, v.y - 1});
    return (ne != nw || se != sw) && (ne != se || nw != sw);
  }

  /// Returns the existing turn at each corner. The turns of removed polygons keep only the polygons that
  /// stay.
  std::vector<std::uint32_t> turns_at(const std::vector<Cell>& corners) {
    std::vector<std::uint32_t> turns(corners.size(), NavigationMesh::no_turn);
    for (const std::uint32_t p : taken_) {
      for (std::uint32_t s = mesh_.first[p]; s < mesh_.first[p + 1]; ++s) {
        const std::uint32_t id = mesh_.sides[s].turn;
        if (id == NavigationMesh::no_turn) continue;
        NavigationMesh::Turn& turn = mesh_.turns[id];
        const auto begin = mesh_.around.begin() + turn.around, end = begin + turn.polygons;
        const auto kept = std::remove_if(
            begin, end, [this](const NavigationMesh::Wedge& w) { return mesh_.is_gone(w.polygon); });
        turn.polygons = static_cast<std::uint32_t>(kept - begin);
        const auto found = std::lower_bound(corners.begin(), corners.end(), turn.at, earlier);
        if (found != corners.end() && *found == turn.at)
          turns[static_cast<std::size_t>(found - corners.begin())] = id;
      }
    }
    return turns;
  }

  /// Links a new polygon with its neighbours that stayed.
  void link(std::uint32_t polygon) {
    for (std::uint32_t s = mesh_.first[polygon]; s < mesh_.first[polygon + 1]; ++s) {
      NavigationMesh::Side& side = mesh_.sides[s];
      if (side.polygon == NavigationMesh::none) {
        const Rim wanted{side.at, end_of(polygon, s), NavigationMesh::none, NavigationMesh::none};
        const auto found = std::lower_bound(rim_.begin(), rim_.end(), wanted);
        if (found == rim_.end() || wanted < *found) continue;
        side.polygon = found->polygon;
        side.behind = found->side;
        NavigationMesh::Side& behind = mesh_.sides[found->side];
        behind.polygon = polygon;
        behind.behind = s;
        behind.block = block_;
      }
      side.block = block_;
    }
  }

  NavigationMesh& mesh_;
  const GridMap& ground_;
  const std::vector<Cell>& changed_;
  std::uint32_t block_;  // block of all new sides
  std::vector<std::uint32_t> taken_;
  std::size_t sides_taken_ = 0;
  std::vector<Rim> rim_;
  std::vector<BorderSide> border_;
};

}  // namespace

bool change_mesh(NavigationMesh& mesh, const GridMap& ground, const std::vector<Cell>& changed,
                 std::size_t most_sides) {
  return changed.empty() || Change(mesh, ground, changed).run(most_sides);
}

}  // namespace outrider
