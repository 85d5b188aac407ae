#include "ground/slab_cuts.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "outrider/core/units.hpp"
#include "outrider/geometry/convex.hpp"

namespace outrider::cover {
namespace {

constexpr double beside_m = 1e-5;  // a cut along an edge would leave the parts beside it joined by a line
constexpr double corner_rad = radians(20.0);  // smoother bends are no corners
constexpr double even_part = 1e-3;            // of the stride, for which even slabs are better than others
constexpr int grid_of_stride = 8;
constexpr std::size_t most_heights = 4000;

template <class Look>
void each_ring(const RingedPolygon& polygon, Look look) {
  look(polygon.outer);
  for (const auto& hole : polygon.holes) look(hole);
}

void add_corners(const std::vector<Vec2>& ring, std::vector<double>& heights) {
  const std::size_t n = ring.size();
  for (std::size_t i = 0; i < n; ++i) {
    const Vec2 in = ring[i] - ring[(i + n - 1) % n], out = ring[(i + 1) % n] - ring[i];
    if (std::abs(std::atan2(cross(in, out), dot(in, out))) < corner_rad) continue;
    heights.push_back(ring[i].y - beside_m);
    heights.push_back(ring[i].y + beside_m);
  }
}

/// Returns the heights to choose from.
std::vector<double> heights_of(const RingedPolygon& polygon, double stride_m) {
  const Box2 box = bounds_of({polygon});
  const double all_m = box.size().y;
  std::vector<double> heights{box.low.y, box.high.y};
  const auto slabs = std::max(1.0, std::ceil(all_m / stride_m - 1e-9));
  for (double k = 1.0; k < slabs; ++k) heights.push_back(box.low.y + all_m * k / slabs);
  if (slabs * grid_of_stride < most_heights) {
    for (double y = stride_m / grid_of_stride; y < all_m; y += stride_m / grid_of_stride) {
      heights.push_back(box.low.y + y);
      heights.push_back(box.high.y - y);
    }
    each_ring(polygon, [&](const auto& ring) { add_corners(ring, heights); });
  }
  std::erase_if(heights, [&](double y) { return y < box.low.y || y > box.high.y; });
  std::sort(heights.begin(), heights.end());
  std::vector<double> apart{heights.front()};
  for (const double y : heights) {
    if (y - apart.back() > beside_m) apart.push_back(y);
  }
  apart.back() = box.high.y;
  return apart;
}

/// Returns the stretches of a ray within the polygon, from low x to high x.
std::vector<Interval> stretches(const RingedPolygon& polygon, double y) {
  std::vector<double> crossings;
  each_ring(polygon, [&](const auto& ring) {
    for (std::size_t i = 0; i < ring.size(); ++i) {
      const Vec2 a = ring[i], b = ring[(i + 1) % ring.size()];
      if ((a.y > y) == (b.y > y)) continue;
      crossings.push_back(a.x + (b.x - a.x) * (y - a.y) / (b.y - a.y));
    }
  });
  std::sort(crossings.begin(), crossings.end());
  std::vector<Interval> found;
  for (std::size_t i = 0; i + 1 < crossings.size(); i += 2) found.push_back({crossings[i], crossings[i + 1]});
  return found;
}

/// Adds intervals to disjoint ones in rising order.
void unite(std::vector<Interval>& all, const std::vector<Interval>& more) {
  all.insert(all.end(), more.begin(), more.end());
  std::sort(all.begin(), all.end(), [](const Interval& a, const Interval& b) { return a.low < b.low; });
  std::vector<Interval> disjoint;
  for (const Interval& one : all) {
    if (disjoint.empty() || one.low > disjoint.back().high) {
      disjoint.push_back(one);
    } else {
      disjoint.back().high = std::max(disjoint.back().high, one.high);
    }
  }
  all = std::move(disjoint);
}

double cost_of(const std::vector<Interval>& lanes, double change_m) {
  double cost = change_m * static_cast<double>(lanes.size());
  for (const Interval& lane : lanes) cost += lane.high - lane.low;
  return cost;
}

}  // namespace

std::vector<double> slab_cuts(const RingedPolygon& polygon, double stride_m, double change_m,
                              const std::stop_token& stop) {
  const std::vector<double> heights = heights_of(polygon, stride_m);
  std::vector<std::vector<Interval>> strips;  // what lies between two heights
  for (std::size_t i = 0; i + 1 < heights.size(); ++i) {
    if (stop.stop_requested()) return {heights.front(), heights.back()};
    const double low = heights[i], rise = heights[i + 1] - low;
    std::vector<Interval> strip;
    for (const double part : {0.02, 0.5, 0.98}) unite(strip, stretches(polygon, low + part * rise));
    strips.push_back(std::move(strip));
  }
  std::vector<double> least(heights.size(), std::numeric_limits<double>::infinity());
  std::vector<std::size_t> from(heights.size(), 0);
  least[0] = 0.0;
  for (std::size_t i = 0; i + 1 < heights.size(); ++i) {
    if (stop.stop_requested()) return {heights.front(), heights.back()};
    std::vector<Interval> lanes;
    for (std::size_t k = i; k + 1 < heights.size(); ++k) {
      if (heights[k + 1] - heights[i] > stride_m * (1.0 + 1e-9)) break;
      unite(lanes, strips[k]);
      const double height_m = heights[k + 1] - heights[i];
      const double cost = least[i] + cost_of(lanes, change_m) + even_part * height_m * height_m / stride_m;
      if (cost >= least[k + 1] - 1e-9) continue;
      least[k + 1] = cost;
      from[k + 1] = i;
    }
  }
  std::vector<double> cuts{heights.back()};
  for (std::size_t at = heights.size() - 1; at > 0; at = from[at]) cuts.push_back(heights[from[at]]);
  std::reverse(cuts.begin(), cuts.end());
  return cuts;
}

}  // namespace outrider::cover
