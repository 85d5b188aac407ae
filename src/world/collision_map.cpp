#include "outrider/world/collision_map.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "outrider/world/steep_ground.hpp"

namespace outrider {
namespace {

constexpr double touch_m = 1e-9;
constexpr int most_tiles = 256;  // on each side of the map

int tile_at(double t, int count) {
  return static_cast<int>(std::clamp(std::floor(t), 0.0, static_cast<double>(count - 1)));
}

double squared_distance(Vec2 p, Vec2 a, Vec2 along, double length2) {
  const double t = length2 > 0.0 ? std::clamp(dot(p - a, along) / length2, 0.0, 1.0) : 0.0;
  return squared_norm(p - a - t * along);
}

/// Returns true if the segment passes through the core shrunk by `touch_m`. A core of two points is a fence
/// that must not be crossed.
bool pierces(Segment s, const std::vector<Vec2>& core) {
  const Vec2 along = s.b - s.a;
  if (core.size() == 2) {
    const Vec2 fence = core[1] - core[0];
    return cross(along, core[0] - s.a) * cross(along, core[1] - s.a) < 0.0 &&
           cross(fence, s.a - core[0]) * cross(fence, s.b - core[0]) < 0.0;
  }
  double t_low = 0.0;
  double t_high = 1.0;
  for (std::size_t i = 0; i < core.size(); ++i) {
    const Vec2 edge = core[(i + 1) % core.size()] - core[i];
    const double outside = cross(s.a - core[i], edge) + touch_m * norm(edge);
    const double rate = cross(along, edge);
    if (rate == 0.0 && outside > 0.0) return false;
    if (rate < 0.0) t_low = std::max(t_low, -outside / rate);
    if (rate > 0.0) t_high = std::min(t_high, -outside / rate);
  }
  return core.size() > 2 && t_low < t_high;
}

/// Returns true if a point of the segment is nearer to the core than `reach` > 0. Compares squared distances.
/// Most pairs are rejected by the extents of the core along and across the segment.
bool comes_nearer(Segment s, const std::vector<Vec2>& core, double reach) {
  const Vec2 along = s.b - s.a;
  const double length2 = squared_norm(along);
  const double reach2 = reach * reach;
  double left_low = std::numeric_limits<double>::infinity();
  double left_high = -left_low;
  double ahead_low = left_low;
  double ahead_high = -left_low;
  for (const Vec2 c : core) {
    const double left = cross(along, c - s.a);
    const double ahead = dot(along, c - s.a);
    left_low = std::min(left_low, left);
    left_high = std::max(left_high, left);
    ahead_low = std::min(ahead_low, ahead);
    ahead_high = std::max(ahead_high, ahead);
  }
  const double aside = std::max({left_low, -left_high, 0.0});
  const double beyond = std::max({ahead_low - length2, -ahead_high, 0.0});
  if (std::max(aside * aside, beyond * beyond) >= reach2 * length2 && length2 > 0.0) return false;

  const std::size_t edges = core.size() <= 2 ? 1 : core.size();
  bool start_inside = core.size() > 2;
  for (std::size_t i = 0; i < edges; ++i) {
    const Vec2 a = core[i];
    const Vec2 edge = core[(i + 1) % core.size()] - a;
    const double edge2 = squared_norm(edge);
    if (squared_distance(a, s.a, along, length2) < reach2) return true;
    if (squared_distance(s.a, a, edge, edge2) < reach2 || squared_distance(s.b, a, edge, edge2) < reach2) {
      return true;
    }
    const double from_a = cross(edge, s.a - a);
    if (from_a * cross(edge, s.b - a) < 0.0 && cross(along, a - s.a) * cross(along, a + edge - s.a) < 0.0) {
      return true;
    }
    start_inside = start_inside && from_a >= 0.0;
  }
  return start_inside || (core.size() == 2 && squared_distance(core[1], s.a, along, length2) < reach2);
}

/// Returns true if the disk swept along the segment overlaps the obstacle by more than `touch_m`.
bool collides(Segment s, const RoundedPolygon& obstacle, double radius_m) {
  const double reach = radius_m + obstacle.radius_m - touch_m;
  return reach > 0.0 ? comes_nearer(s, obstacle.core, reach) : pierces(s, obstacle.core);
}

}  // namespace

CollisionMap::CollisionMap(const Box2& bounds, std::vector<RoundedPolygon> obstacles,
                           std::shared_ptr<const HeightField> terrain)
    : bounds_(bounds), terrain_(std::move(terrain)), obstacles_(std::move(obstacles)) {
  const double side = std::max({bounds_.size().x, bounds_.size().y, 1e-6});
  tile_m_ = std::max(0.5, side / most_tiles);
  columns_ = static_cast<int>(std::max(1.0, std::ceil(bounds_.size().x / tile_m_)));
  rows_ = static_cast<int>(std::max(1.0, std::ceil(bounds_.size().y / tile_m_)));
  boxes_.reserve(obstacles_.size());
  for (const RoundedPolygon& obstacle : obstacles_) boxes_.push_back(obstacle.bounds());

  const auto for_each_tile = [&](const TileRange& r, auto visit) {
    for (int y = r.y0; y <= r.y1; ++y) {
      for (int x = r.x0; x <= r.x1; ++x) visit(tile_index(x, y));
    }
  };
  tiles_.reserve(boxes_.size());
  for (const Box2& box : boxes_) tiles_.push_back(tiles_of(box));
  first_.assign(tile_index(0, rows_) + 1, 0);
  for (const TileRange& range : tiles_) for_each_tile(range, [&](std::size_t t) { ++first_[t + 1]; });
  for (std::size_t t = 1; t < first_.size(); ++t) first_[t] += first_[t - 1];
  items_.resize(first_.back());
  std::vector<std::uint32_t> next(first_.begin(), first_.end() - 1);
  for (std::uint32_t i = 0; i < boxes_.size(); ++i) {
    for_each_tile(tiles_[i], [&](std::size_t t) { items_[next[t]++] = i; });
  }
}

CollisionMap CollisionMap::of(const World& world, double robot_height_m, double step_m,
                              double max_slope_rad) {
  std::vector<RoundedPolygon> obstacles;
  for (const Solid& solid : world.solids) {
    const Interval under = world.terrain ? world.terrain->heights_over(outrider::bounds(solid).ground())
                                         : Interval{world.floor_z_m, world.floor_z_m};
    for (RoundedPolygon& piece : footprint(solid, under.low + step_m, under.high + robot_height_m)) {
      obstacles.push_back(std::move(piece));
    }
  }
  if (world.terrain) {
    for (RoundedPolygon& patch : steep_ground(*world.terrain, max_slope_rad)) {
      obstacles.push_back(std::move(patch));
    }
  }
  return {world.bounds, std::move(obstacles), world.terrain};
}

CollisionMap::TileRange CollisionMap::tiles_of(const Box2& box) const {
  return {tile_at((box.low.x - bounds_.low.x) / tile_m_, columns_),
          tile_at((box.high.x - bounds_.low.x) / tile_m_, columns_),
          tile_at((box.low.y - bounds_.low.y) / tile_m_, rows_),
          tile_at((box.high.y - bounds_.low.y) / tile_m_, rows_)};
}

/// Visits the obstacles that may lie within `reach_m` of the segment, one row of tiles after another, until a
/// visit returns true. An obstacle is visited twice only if its tiles leave the strip around the segment and
/// return.
template <class Visit>
bool CollisionMap::any_along(Segment s, double reach_m, Visit visit) const {
  constexpr double inf = std::numeric_limits<double>::infinity();
  Box2 box;
  box.include(s.a);
  box.include(s.b);
  box = box.grown(reach_m);
  const TileRange all = tiles_of(box);
  const double slope = (s.b.x - s.a.x) / (s.b.y - s.a.y);
  int below_x0 = 0;  // the tiles visited in the row below
  int below_x1 = -1;
  for (int y = all.y0; y <= all.y1; ++y) {
    int x0 = all.x0;
    int x1 = all.x1;
    if (std::isfinite(slope)) {
      const double low = y == 0 ? -inf : bounds_.low.y + y * tile_m_ - reach_m;
      const double high = y == rows_ - 1 ? inf : bounds_.low.y + (y + 1) * tile_m_ + reach_m;
      const auto x_at = [&](double v) {
        const double within = std::clamp(v, std::min(s.a.y, s.b.y), std::max(s.a.y, s.b.y));
        return s.a.x + (within - s.a.y) * slope;
      };
      const auto [left, right] = std::minmax({x_at(low), x_at(high)});
      x0 = tile_at((left - reach_m - bounds_.low.x) / tile_m_, columns_);
      x1 = tile_at((right + reach_m - bounds_.low.x) / tile_m_, columns_);
    }
    for (int x = x0; x <= x1; ++x) {
      const std::size_t t = tile_index(x, y);
      for (std::uint32_t k = first_[t]; k < first_[t + 1]; ++k) {
        const std::uint32_t i = items_[k];
        const TileRange& own = tiles_[i];
        const bool met = x > std::max(x0, own.x0) ||
                         (y > std::max(all.y0, own.y0) && below_x0 <= own.x1 && below_x1 >= own.x0);
        if (!met && boxes_[i].overlaps(box) && visit(obstacles_[i])) return true;
      }
    }
    below_x0 = x0;
    below_x1 = x1;
  }
  return false;
}

double CollisionMap::edge_distance(Vec2 p) const {
  return std::min({p.x - bounds_.low.x, bounds_.high.x - p.x, p.y - bounds_.low.y, bounds_.high.y - p.y});
}

double CollisionMap::clearance(Vec2 p, double most_m) const {
  double nearest = std::min(most_m, edge_distance(p));
  any_along({p, p}, most_m, [&](const RoundedPolygon& obstacle) {
    const double to_box_m = boxes_[static_cast<std::size_t>(&obstacle - obstacles_.data())].distance_to(p);
    if (to_box_m == 0.0 || to_box_m < nearest) nearest = std::min(nearest, signed_distance(p, obstacle));
    return false;
  });
  return nearest;
}

bool CollisionMap::segment_free(Segment s, double radius_m) const {
  if (std::min(edge_distance(s.a), edge_distance(s.b)) < radius_m - touch_m) return false;
  return !any_along(s, radius_m,
                    [&](const RoundedPolygon& obstacle) { return collides(s, obstacle, radius_m); });
}

}  // namespace outrider
