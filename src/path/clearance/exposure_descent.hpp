// Descent: bends a polyline until it costs least, as length + weight * exposure, in its neighbourhood.
//
// A corner is moved across the path as long as the two legs beside it get cheaper, and left out where one leg
// costs less than two; legs are halved for finer bends, and so on. Every leg keeps the clearance. The cost
// never grows.
#pragma once

#include <stop_token>
#include <vector>

#include "outrider/path/visibility/polygon_ground.hpp"

namespace outrider {

/// The cost of straight legs among polygons.
struct LegCost {
  const PolygonGround& ground;
  double weight_m = 0.0;
  double least_m = 0.0;       ///< clearance that a leg keeps
  std::stop_token stop = {};  ///< after a stop request every cost is infinite

  /// Returns the cost; infinite where the leg does not keep the clearance.
  [[nodiscard]] double operator()(Vec2 a, Vec2 b) const;
};

/// Returns the bent polyline. Its ends stay. O(points * edges) for each of a few hundred moves of a point.
std::vector<Vec2> descended(std::vector<Vec2> points, const LegCost& cost);
/// The same without more points than there are.
std::vector<Vec2> settled(std::vector<Vec2> points, const LegCost& cost);

}  // namespace outrider
