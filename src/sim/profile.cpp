#include "outrider/sim/profile.hpp"

#include <algorithm>

#include "outrider/log/messages/conversions.hpp"

namespace outrider {

std::vector<outrider_msgs::ProfilePiece> profile_of(const Flight& flight, const Impact& impact,
                                                    const FlightSpace& space, const Target& target) {
  constexpr double spare_m = 0.6;
  const Vec2 origin = xy(flight.muzzle);
  // In air a flight is not in one plane; it is seen from the side of its end.
  const Vec2 way = flight.in_air ? xy(impact.position) - origin : xy(flight.velocity_mps);
  const Vec2 along = norm(way) > 0.0 ? 1.0 / norm(way) * way : Vec2{1.0, 0.0};
  const Vec3 centre = target.centre();
  const double end = std::max(dot(along, xy(impact.position) - origin), dot(along, xy(centre) - origin));
  const double bottom = std::min({flight.muzzle.z, impact.position.z, target.base.z}) - 0.3;

  std::vector<outrider_msgs::ProfilePiece> pieces;
  const auto add = [&](const Solid& solid) {
    for (auto& polygon : slice(solid, origin, along)) {
      polygon =
          clip(clip(clip(polygon, {-1.0, 0.0}, spare_m), {1.0, 0.0}, end + spare_m), {0.0, -1.0}, -bottom);
      if (polygon.size() >= 2) pieces.push_back({solid.name, points_of(polygon)});
    }
  };
  for (const Solid& solid : space.solids()) add(solid);
  add(solid_of(target));
  return pieces;
}

std::vector<geometry_msgs::Point> path_of(const Flight& flight, const Impact& impact) {
  if (!flight.in_air) return {};
  constexpr int parts = 32;
  std::vector<geometry_msgs::Point> path;
  for (int i = 0; i <= parts; ++i) path.push_back(point_of(flight.position(impact.time_s * i / parts)));
  return path;
}

}  // namespace outrider
