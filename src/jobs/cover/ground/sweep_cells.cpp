#include "ground/sweep_cells.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "ground/slab_cuts.hpp"

namespace outrider::cover {
namespace {

constexpr double same_m = 4e-6;  // some roundings of a region

Vec2 turned(Vec2 p, Vec2 axis) { return {dot(axis, p), cross(axis, p)}; }
Vec2 turned_back(Vec2 p, Vec2 axis) { return p.x * axis + p.y * perpendicular(axis); }

template <class Turn>
RingedPolygon each(const RingedPolygon& polygon, Turn turn) {
  RingedPolygon result = polygon;
  for (Vec2& p : result.outer) p = turn(p);
  for (auto& hole : result.holes) {
    for (Vec2& p : hole) p = turn(p);
  }
  return result;
}

/// A part of the region within one slab, lanes along x.
struct Part {
  RingedPolygon area;
  Segment lane;
  std::vector<std::size_t> below;  ///< parts of the slab before that it touches
  std::vector<std::size_t> above;
};

/// The stretches of a polygon's edges that lie at that height.
std::vector<Interval> stretches_at(const RingedPolygon& polygon, double y) {
  std::vector<Interval> found;
  const auto look_at = [&](const std::vector<Vec2>& ring) {
    for (std::size_t i = 0; i < ring.size(); ++i) {
      const Vec2 a = ring[i], b = ring[(i + 1) % ring.size()];
      if (std::abs(a.y - y) > same_m || std::abs(b.y - y) > same_m) continue;
      found.push_back({std::min(a.x, b.x), std::max(a.x, b.x)});
    }
  };
  look_at(polygon.outer);
  for (const auto& hole : polygon.holes) look_at(hole);
  return found;
}

bool touch(const RingedPolygon& low, const RingedPolygon& high, double y) {
  const auto tops = stretches_at(low, y), bottoms = stretches_at(high, y);
  return std::any_of(tops.begin(), tops.end(), [&](const Interval& a) {
    return std::any_of(bottoms.begin(), bottoms.end(), [&](const Interval& b) {
      return std::min(a.high, b.high) - std::max(a.low, b.low) > same_m;
    });
  });
}

Segment lane_of(const RingedPolygon& part, double y, double least_m) {
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (const Vec2 p : part.outer) {
    low = std::min(low, p.x);
    high = std::max(high, p.x);
  }
  const double more = 0.5 * std::max(0.0, least_m - (high - low));
  return {{low - more, y}, {high + more, y}};
}

/// One connected polygon cut into slabs; parts in the order of their slabs.
std::vector<Part> parts_of(const RingedPolygon& polygon, double stride_m, double least_m, double change_m,
                           const std::stop_token& stop) {
  const Box2 box = bounds_of({polygon});
  const std::vector<double> cuts = slab_cuts(polygon, stride_m, change_m, stop);
  std::vector<Part> parts;
  std::size_t before = 0, here = 0;  // where the parts of the slab before and of this one begin
  for (std::size_t k = 0; k + 1 < cuts.size() && !stop.stop_requested(); ++k) {
    const double low = cuts[k], high = cuts[k + 1];
    const double left = box.low.x - 1.0, right = box.high.x + 1.0;
    const Region cut = common({polygon}, {{{{left, low}, {right, low}, {right, high}, {left, high}}, {}}});
    before = here;
    here = parts.size();
    for (const RingedPolygon& area : cut) {
      Part part{area, lane_of(area, 0.5 * (low + high), least_m), {}, {}};
      for (std::size_t i = before; i < here; ++i) {
        if (!touch(parts[i].area, area, low)) continue;
        parts[i].above.push_back(parts.size());
        part.below.push_back(i);
      }
      parts.push_back(std::move(part));
    }
  }
  return parts;
}

/// The part that goes on after this one in the same cell.
std::size_t next_of(const std::vector<Part>& parts, std::size_t i) {
  const bool goes_on = parts[i].above.size() == 1 && parts[parts[i].above[0]].below.size() == 1;
  return goes_on ? parts[i].above[0] : parts.size();
}

}  // namespace

std::vector<SweepCell> sweep_cells(const Region& region, double heading_rad, double stride_m, double least_m,
                                   double change_m, const std::stop_token& stop) {
  const Vec2 axis = direction(heading_rad);
  const auto back = [&](Vec2 p) { return turned_back(p, axis); };
  std::vector<SweepCell> cells;
  for (const RingedPolygon& polygon : region) {
    const auto parts =
        parts_of(each(polygon, [&](Vec2 p) { return turned(p, axis); }), stride_m, least_m, change_m, stop);
    std::vector<bool> used(parts.size(), false);
    for (std::size_t begin = 0; begin < parts.size(); ++begin) {
      if (used[begin]) continue;
      SweepCell cell;
      std::vector<Region> areas;
      for (std::size_t i = begin; i < parts.size(); i = next_of(parts, i)) {
        used[i] = true;
        cell.lanes.push_back({back(parts[i].lane.a), back(parts[i].lane.b)});
        areas.push_back({each(parts[i].area, back)});
      }
      cell.area = united(areas);
      cells.push_back(std::move(cell));
    }
  }
  return cells;
}

}  // namespace outrider::cover
