#include <algorithm>
#include <cmath>

#include "polygon_ground_free.hpp"

namespace outrider {
namespace {

constexpr int most_cells_a_side = 128;

int column_of(const EdgeIndex& index, double x) {
  return static_cast<int>(
      std::clamp(std::floor((x - index.origin.x) / index.cell_m), 0.0, index.width - 1.0));
}
int row_of(const EdgeIndex& index, double y) {
  return static_cast<int>(
      std::clamp(std::floor((y - index.origin.y) / index.cell_m), 0.0, index.height - 1.0));
}

/// Calls visit(cell, edge) for every cell within reach of the edge.
template <class Visit>
void for_each_entry(const PolygonGround& ground, const EdgeIndex& index, Visit visit) {
  const double reach = ground.radius_m * (1.0 + 1e-6) + 2.0 * contact_m + index.cell_m * 0.70711;
  for (std::uint32_t e = 0; e < ground.edges.size(); ++e) {
    Box2 box;
    box.include(ground.edges[e].a);
    box.include(ground.edges[e].b);
    box = box.grown(ground.radius_m + index.cell_m);
    for (int y = row_of(index, box.low.y); y <= row_of(index, box.high.y); ++y) {
      for (int x = column_of(index, box.low.x); x <= column_of(index, box.high.x); ++x) {
        const Vec2 centre = index.origin + index.cell_m * Vec2{x + 0.5, y + 0.5};
        if (distance(centre, ground.edges[e]) > reach) continue;
        visit(
            static_cast<std::size_t>(y) * static_cast<std::size_t>(index.width) + static_cast<std::size_t>(x),
            e);
      }
    }
  }
}

/// Returns true if the disk's centre, moving along s, stays clear of the edge.
bool clear_of(const Segment& edge, const Segment& s, Vec2 along, double length, double least) {
  const Vec2 a = edge.a - s.a, b = edge.b - s.a;
  const double ay = cross(along, a), by = cross(along, b);
  if ((ay >= least && by >= least) || (ay <= -least && by <= -least)) return true;
  const double ax = dot(along, a), bx = dot(along, b);
  if ((ax <= -least && bx <= -least) || (ax >= length + least && bx >= length + least)) return true;
  return distance(edge, s) >= least;
}

}  // namespace

EdgeIndex index_of(const PolygonGround& ground) {
  EdgeIndex index;
  const Vec2 size = ground.bounds.size();
  const double wide = std::max(size.x, size.y);
  const double per_side = std::clamp(2.0 * std::sqrt(static_cast<double>(ground.edges.size())), 8.0,
                                     static_cast<double>(most_cells_a_side));
  index.cell_m = std::max(wide / per_side, 0.5 * ground.radius_m);
  index.origin = ground.bounds.low;
  index.width = 1 + std::min(most_cells_a_side, static_cast<int>(size.x / index.cell_m));
  index.height = 1 + std::min(most_cells_a_side, static_cast<int>(size.y / index.cell_m));
  index.first.assign(static_cast<std::size_t>(index.width) * static_cast<std::size_t>(index.height) + 1, 0);
  std::vector<std::pair<std::size_t, std::uint32_t>> entries;
  for_each_entry(ground, index, [&](std::size_t cell, std::uint32_t e) {
    ++index.first[cell + 1];
    entries.emplace_back(cell, e);
  });
  for (std::size_t i = 1; i < index.first.size(); ++i) index.first[i] += index.first[i - 1];
  index.items.resize(entries.size());
  std::vector<std::uint32_t> next = index.first;
  for (const auto& [cell, e] : entries) index.items[next[cell]++] = e;
  index.rows.resize(static_cast<std::size_t>(index.height));
  for (std::uint32_t e = 0; e < ground.edges.size(); ++e) {
    const auto [low, high] = std::minmax(ground.edges[e].a.y, ground.edges[e].b.y);
    for (int y = row_of(index, low); y <= row_of(index, high); ++y) {
      index.rows[static_cast<std::size_t>(y)].push_back(e);
    }
  }
  return index;
}

std::size_t cell_of(const EdgeIndex& index, Vec2 p) {
  return static_cast<std::size_t>(row_of(index, p.y)) * static_cast<std::size_t>(index.width) +
         static_cast<std::size_t>(column_of(index, p.x));
}

bool clear_of(const PolygonGround& ground, const Segment& edge, Segment s) {
  if (s.a.y > s.b.y) std::swap(s.a, s.b);
  const double length = distance(s.a, s.b);
  if (length == 0.0) return true;
  return clear_of(edge, s, (1.0 / length) * (s.b - s.a), length, ground.radius_m - contact_m);
}

bool PolygonGround::point_free(Vec2 p) const {
  if (!bounds.contains(p)) return false;
  const std::size_t cell = cell_of(index, p);
  for (std::uint32_t i = index.first[cell]; i < index.first[cell + 1]; ++i) {
    if (distance(p, edges[index.items[i]]) < radius_m - contact_m) return false;
  }
  return !solid(p);
}

bool PolygonGround::solid(Vec2 p) const {
  if (!bounds.contains(p)) return true;
  int turns = 0;  // winding number around p: boundary -1, each obstacle 1
  for (const std::uint32_t e : index.rows[static_cast<std::size_t>(row_of(index, p.y))]) {
    const Segment& edge = edges[e];
    const bool up = edge.b.y > p.y;
    if ((edge.a.y > p.y) == up) continue;
    const double side = cross(edge.b - edge.a, p - edge.a);
    if (up == (side > 0.0)) turns += up ? 1 : -1;
  }
  return turns != -1;
}

bool PolygonGround::segment_free(Segment s) const {
  if (s.a.y > s.b.y) std::swap(s.a, s.b);
  const double length = distance(s.a, s.b);
  if (length == 0.0) return true;
  const Vec2 along = (1.0 / length) * (s.b - s.a);
  const double slack = 1e-9 * index.cell_m + 1e-9;
  const double rise = s.b.y - s.a.y;
  for (int row = row_of(index, s.a.y - slack); row <= row_of(index, s.b.y + slack); ++row) {
    double low_x = s.a.x, high_x = s.b.x;
    if (rise > slack) {
      const double bottom = index.origin.y + row * index.cell_m;
      const auto x_at = [&](double y) {
        return s.a.x + (s.b.x - s.a.x) * std::clamp((y - s.a.y) / rise, 0.0, 1.0);
      };
      low_x = x_at(bottom - slack);
      high_x = x_at(bottom + index.cell_m + slack);
    }
    if (low_x > high_x) std::swap(low_x, high_x);
    const std::size_t line = static_cast<std::size_t>(row) * static_cast<std::size_t>(index.width);
    const std::size_t from = line + static_cast<std::size_t>(column_of(index, low_x - slack));
    const std::size_t to = line + static_cast<std::size_t>(column_of(index, high_x + slack));
    for (std::uint32_t i = index.first[from]; i < index.first[to + 1]; ++i) {
      if (!clear_of(edges[index.items[i]], s, along, length, radius_m - contact_m)) return false;
    }
  }
  return true;
}

}  // namespace outrider
