#include "outrider/control/nearby.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace outrider {

Nearby::Nearby(const Grid<std::uint8_t>& map, Vec2 middle, double reach_m)
    : half_m_(0.5 * map.frame.resolution_m) {
  const Vec2 reach{reach_m, reach_m};
  const Cell low = map.frame.cell_at(middle - reach), high = map.frame.cell_at(middle + reach);
  for (int y = std::max(low.y, 0); y <= std::min(high.y, map.frame.height - 1); ++y) {
    for (int x = std::max(low.x, 0); x <= std::min(high.x, map.frame.width - 1); ++x) {
      if (map[{x, y}] == occupied_cell) centres_.push_back(map.frame.centre({x, y}));
    }
  }
}

double Nearby::clearance(Vec2 p) const {
  double least = std::numeric_limits<double>::infinity();
  for (const Vec2 c : centres_) {
    const Vec2 off{std::max(std::abs(p.x - c.x) - half_m_, 0.0),
                   std::max(std::abs(p.y - c.y) - half_m_, 0.0)};
    least = std::min(least, squared_norm(off));
  }
  for (const Vec2 point : points_) least = std::min(least, squared_norm(p - point));
  return std::sqrt(least);
}

double Nearby::clearance(Segment s) const {
  // Clearance changes by at most the distance moved, so a step of (clearance here - least so far) skips no
  // smaller value.
  const double length = distance(s.a, s.b), finest = std::max(1e-4, 0.2 * half_m_);
  double least = std::min(clearance(s.a), clearance(s.b));
  for (double at = finest; at < length;) {
    const double here = clearance(s.a + (at / length) * (s.b - s.a));
    least = std::min(least, here);
    at += std::max(finest, here - least);
  }
  return least;
}

}  // namespace outrider
