#include "outrider/geometry/polyline.hpp"

namespace outrider {

double length_of(const std::vector<Vec2>& points) {
  double length = 0.0;
  for (std::size_t i = 1; i < points.size(); ++i) length += distance(points[i - 1], points[i]);
  return length;
}

}  // namespace outrider
