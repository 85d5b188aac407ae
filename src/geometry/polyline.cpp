#include "outrider/geometry/polyline.hpp"

#include <cstddef>
#include <utility>

#include "outrider/geometry/convex.hpp"

namespace outrider {

double length_of(const std::vector<Vec2>& points) {
  double length = 0.0;
  for (std::size_t i = 1; i < points.size(); ++i) length += distance(points[i - 1], points[i]);
  return length;
}

std::vector<Vec2> simplified(const std::vector<Vec2>& points, double tolerance_m) {
  if (points.size() < 3) return points;
  std::vector<char> kept(points.size(), 0);
  kept.front() = kept.back() = 1;
  std::vector<std::pair<std::size_t, std::size_t>> open{{0, points.size() - 1}};
  while (!open.empty()) {
    const auto [first, last] = open.back();
    open.pop_back();
    double farthest = tolerance_m;
    std::size_t split = first;
    for (std::size_t i = first + 1; i < last; ++i) {
      const double away = distance(points[i], Segment{points[first], points[last]});
      if (away > farthest) {
        farthest = away;
        split = i;
      }
    }
    if (split == first) continue;
    kept[split] = 1;
    open.emplace_back(first, split);
    open.emplace_back(split, last);
  }
  std::vector<Vec2> result;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (kept[i] != 0) result.push_back(points[i]);
  }
  return result;
}

}  // namespace outrider
