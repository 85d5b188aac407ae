#include "navigate_grid.hpp"

#include <algorithm>
#include <cmath>

namespace outrider {

void spread_distances(const GridFrame& frame, const std::vector<Vec2>& places, double most_m,
                      std::vector<float>& distance_m) {
  const auto most = static_cast<float>(most_m * most_m);
  distance_m.assign(frame.size(), most);
  const auto step = static_cast<float>(frame.resolution_m);
  for (const Vec2 place : places) {
    const Cell low = frame.cell_at(place - Vec2{most_m, most_m});
    const Cell high = frame.cell_at(place + Vec2{most_m, most_m});
    for (int y = std::max(low.y, 0); y <= std::min(high.y, frame.height - 1); ++y) {
      const Vec2 off = frame.centre({0, y}) - place;
      const double half2 = most_m * most_m - off.y * off.y;  // of the chord in this row
      if (half2 <= 0.0) continue;
      const double half = std::sqrt(half2) / frame.resolution_m, middle = -off.x / frame.resolution_m;
      const int first = std::max(static_cast<int>(std::ceil(middle - half)), 0);
      const int last = std::min(static_cast<int>(std::floor(middle + half)), frame.width - 1);
      float* const row = distance_m.data() + frame.index({0, y});
      const auto x0 = static_cast<float>(off.x), dy2 = static_cast<float>(off.y * off.y);
      for (int x = first; x <= last; ++x) {
        const float dx = x0 + step * static_cast<float>(x);
        row[x] = std::min(row[x], dx * dx + dy2);
      }
    }
  }
  for (float& squared : distance_m) squared = std::sqrt(squared);
}

void add_points(Segment edge, double apart_m, std::vector<Vec2>& points) {
  const double parts = std::max(1.0, std::ceil(distance(edge.a, edge.b) / apart_m));
  for (double i = 0.0; i <= parts; i += 1.0) points.push_back(edge.a + i / parts * (edge.b - edge.a));
}

}  // namespace outrider
