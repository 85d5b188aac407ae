#include "outrider/world/ground.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace outrider {
namespace {

constexpr double touch_m = 1e-9;
constexpr int most_tiles = 256;  // a side

struct TileRange {
  int x0, x1, y0, y1;
};

}  // namespace

Ground::Ground(const Box2& bounds, std::vector<RoundedPolygon> obstacles)
    : bounds_(bounds), obstacles_(std::move(obstacles)) {
  const double side = std::max({bounds_.size().x, bounds_.size().y, 1e-6});
  tile_m_ = std::max(0.5, side / most_tiles);
  columns_ = std::max(1, static_cast<int>(std::ceil(bounds_.size().x / tile_m_)));
  rows_ = std::max(1, static_cast<int>(std::ceil(bounds_.size().y / tile_m_)));
  boxes_.reserve(obstacles_.size());
  for (const RoundedPolygon& obstacle : obstacles_) boxes_.push_back(obstacle.bounds());

  const auto clamped = [](double t, int count) {
    return static_cast<int>(std::clamp(std::floor(t), 0.0, static_cast<double>(count - 1)));
  };
  const auto tiles_of = [&](const Box2& box) {
    return TileRange{clamped((box.low.x - bounds_.low.x) / tile_m_, columns_),
                     clamped((box.high.x - bounds_.low.x) / tile_m_, columns_),
                     clamped((box.low.y - bounds_.low.y) / tile_m_, rows_),
                     clamped((box.high.y - bounds_.low.y) / tile_m_, rows_)};
  };
  const auto for_each_tile = [&](const Box2& box, auto visit) {
    const TileRange r = tiles_of(box);
    for (int y = r.y0; y <= r.y1; ++y) {
      for (int x = r.x0; x <= r.x1; ++x) visit(static_cast<std::size_t>(y * columns_ + x));
    }
  };
  first_.assign(static_cast<std::size_t>(columns_ * rows_) + 1, 0);
  for (const Box2& box : boxes_) for_each_tile(box, [&](std::size_t t) { ++first_[t + 1]; });
  for (std::size_t t = 1; t < first_.size(); ++t) first_[t] += first_[t - 1];
  items_.resize(first_.back());
  std::vector<std::uint32_t> next(first_.begin(), first_.end() - 1);
  for (std::uint32_t i = 0; i < boxes_.size(); ++i) {
    for_each_tile(boxes_[i], [&](std::size_t t) { items_[next[t]++] = i; });
  }
}

Ground Ground::of(const World& world, double robot_height_m, double step_m) {
  std::vector<RoundedPolygon> obstacles;
  for (const Solid& solid : world.solids) {
    for (RoundedPolygon& piece :
         footprint(solid, world.floor_z_m + step_m, world.floor_z_m + robot_height_m)) {
      obstacles.push_back(std::move(piece));
    }
  }
  return {world.bounds, std::move(obstacles)};
}

/// Visits the obstacles whose boxes overlap `box`, some perhaps twice, until one visit returns true.
template <class Visit>
bool Ground::any_near(const Box2& box, Visit visit) const {
  const auto tile = [](double t, int count) {
    return static_cast<int>(std::clamp(std::floor(t), 0.0, static_cast<double>(count - 1)));
  };
  const int x1 = tile((box.high.x - bounds_.low.x) / tile_m_, columns_);
  const int y1 = tile((box.high.y - bounds_.low.y) / tile_m_, rows_);
  for (int y = tile((box.low.y - bounds_.low.y) / tile_m_, rows_); y <= y1; ++y) {
    for (int x = tile((box.low.x - bounds_.low.x) / tile_m_, columns_); x <= x1; ++x) {
      const auto t = static_cast<std::size_t>(y * columns_ + x);
      for (std::uint32_t k = first_[t]; k < first_[t + 1]; ++k) {
        if (boxes_[items_[k]].overlaps(box) && visit(obstacles_[items_[k]])) return true;
      }
    }
  }
  return false;
}

double Ground::edge_distance(Vec2 p) const {
  return std::min({p.x - bounds_.low.x, bounds_.high.x - p.x, p.y - bounds_.low.y, bounds_.high.y - p.y});
}

double Ground::clearance(Vec2 p, double most_m) const {
  double nearest = std::min(most_m, edge_distance(p));
  any_near(Box2{p, p}.grown(most_m), [&](const RoundedPolygon& obstacle) {
    nearest = std::min(nearest, signed_distance(p, obstacle));
    return false;
  });
  return nearest;
}

bool Ground::segment_free(Segment s, double radius_m) const {
  if (std::min(edge_distance(s.a), edge_distance(s.b)) < radius_m - touch_m) return false;
  Box2 box;
  box.include(s.a);
  box.include(s.b);
  return !any_near(box.grown(radius_m), [&](const RoundedPolygon& obstacle) {
    return signed_distance(s, obstacle) < radius_m - touch_m;
  });
}

}  // namespace outrider
