#include "mesh_polygons.hpp"

#include <algorithm>

namespace outrider {
namespace {

constexpr std::uint32_t none = ConvexPolygons::no_side;

/// Sides of triangles, three by three, linked into cycles that become the merged polygons.
struct Sides {
  Sides(const Triangulation& cut, const std::stop_token& stop)
      : corners(cut.corners),
        corner(3 * cut.triangles.size()),
        next(corner),
        before(corner),
        twin(corner.size(), none) {
    std::vector<std::uint32_t> first(corners.size(), none), later(corner.size(), none);  // by lower corner
    for (std::uint32_t h = 0; h < corner.size(); ++h) {
      corner[h] = cut.triangles[h / 3][h % 3];
      next[h] = h % 3 == 2 ? h - 2 : h + 1;
      before[h] = h % 3 == 0 ? h + 2 : h - 1;
    }
    for (std::uint32_t h = 0; h < corner.size() && !stop.stop_requested(); ++h) {
      const std::uint32_t a = corner[h], b = corner[next[h]], low = std::min(a, b);
      std::uint32_t other = first[low];
      while (other != none && !(corner[other] == b && corner[next[other]] == a)) other = later[other];
      if (other != none) {
        twin[h] = other;
        twin[other] = h;
      }
      later[h] = first[low];
      first[low] = h;
    }
  }

  /// Returns each side between two triangles once.
  [[nodiscard]] std::vector<std::uint32_t> inner() const {
    std::vector<std::uint32_t> all;
    for (std::uint32_t h = 0; h < twin.size(); ++h) {
      if (twin[h] != none && h < twin[h]) all.push_back(h);
    }
    return all;
  }
  [[nodiscard]] Cell along(std::uint32_t h) const {
    const Cell a = corners[corner[h]], b = corners[corner[next[h]]];
    return {b.x - a.x, b.y - a.y};
  }
  [[nodiscard]] Vec2 vector(std::uint32_t h) const {
    return {static_cast<double>(along(h).x), static_cast<double>(along(h).y)};
  }
  [[nodiscard]] std::int64_t squared_length(std::uint32_t h) const {
    const std::int64_t x = along(h).x, y = along(h).y;
    return x * x + y * y;
  }
  [[nodiscard]] bool convex(std::uint32_t in, std::uint32_t out) const {
    const Cell a = along(in), b = along(out);
    return std::int64_t{a.x} * b.y >= std::int64_t{a.y} * b.x;
  }
  /// Removes the side if the two polygons together are convex.
  void join_over(std::uint32_t h) {
    const std::uint32_t g = twin[h];
    if (!convex(before[h], next[g]) || !convex(before[g], next[h])) return;
    link(before[h], next[g]);
    link(before[g], next[h]);
    corner[h] = corner[g] = none;
  }
  /// Replaces the side between two triangles by the other diagonal if the circumcircle of one contains the
  /// far corner of the other.
  bool flip(std::uint32_t h) {
    const std::uint32_t g = twin[h];
    const std::uint32_t h1 = next[h], h2 = next[h1], g1 = next[g], g2 = next[g1];
    const Vec2 a = vector(h1), b = vector(h2), c = vector(g1), d = vector(g2);
    if (!(-dot(a, b) * cross(c, d) - dot(c, d) * cross(a, b) < 0.0)) return false;  // sine of the far angles
    corner[h] = corner[g2];
    corner[g] = corner[h2];
    link(h, h2), link(h2, g1), link(g1, h);
    link(g, g2), link(g2, h1), link(h1, g);
    return true;
  }
  void link(std::uint32_t a, std::uint32_t b) {
    next[a] = b;
    before[b] = a;
  }

  const std::vector<Cell>& corners;
  std::vector<std::uint32_t> corner, next, before, twin;  // corner: none when taken away
};

/// Flips sides until the triangulation is Delaunay. The number of flips is bounded in case rounding causes a
/// cycle; any triangulation is valid.
void flip_to_delaunay(Sides& sides, const std::stop_token& stop) {
  std::vector<std::uint32_t> doubtful = sides.inner();
  for (std::size_t left = 64 * doubtful.size(); left > 0 && !doubtful.empty(); --left) {
    if (stop.stop_requested()) return;
    const std::uint32_t h = doubtful.back(), g = sides.twin[h];
    doubtful.pop_back();
    if (!sides.flip(h)) continue;
    for (const std::uint32_t s : {sides.next[h], sides.before[h], sides.next[g], sides.before[g]}) {
      if (sides.twin[s] != none) doubtful.push_back(s);
    }
  }
}

void join_longest_first(Sides& sides, const std::stop_token& stop) {
  std::vector<std::pair<std::int64_t, std::uint32_t>> order;
  for (const std::uint32_t h : sides.inner()) order.emplace_back(-sides.squared_length(h), h);
  std::sort(order.begin(), order.end());
  for (const auto& [length, h] : order) {
    if (stop.stop_requested()) return;
    sides.join_over(h);
  }
}

}  // namespace

ConvexPolygons join_triangles(const Triangulation& cut, const std::stop_token& stop) {
  Sides sides(cut, stop);
  const auto count = static_cast<std::uint32_t>(sides.corner.size());
  flip_to_delaunay(sides, stop);
  join_longest_first(sides, stop);

  ConvexPolygons polygons;
  std::vector<std::uint32_t> place(count, none);
  for (std::uint32_t h = 0; h < count && !stop.stop_requested(); ++h) {
    if (sides.corner[h] == none || place[h] != none) continue;
    const auto id = static_cast<std::uint32_t>(polygons.first.size());
    polygons.first.push_back(static_cast<std::uint32_t>(polygons.sides.size()));
    for (std::uint32_t s = h; place[s] == none; s = sides.next[s]) {
      place[s] = static_cast<std::uint32_t>(polygons.sides.size());
      polygons.sides.push_back({sides.corner[s], sides.twin[s], id});
    }
  }
  polygons.first.push_back(static_cast<std::uint32_t>(polygons.sides.size()));
  for (ConvexPolygons::Side& side : polygons.sides)
    side.behind = side.behind == none ? none : place[side.behind];
  return polygons;
}

}  // namespace outrider
