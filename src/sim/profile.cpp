#include "outrider/sim/profile.hpp"

#include <algorithm>

namespace outrider {

std::vector<ProfilePiece> profile_of(const Flight& flight, const Impact& impact, const FlightSpace& space,
                                     const Target& target) {
  constexpr double spare_m = 0.6;
  const Vec2 origin = xy(flight.muzzle);
  const Vec2 ground_speed = xy(flight.velocity_mps);
  const Vec2 along = 1.0 / norm(ground_speed) * ground_speed;
  const Vec3 centre = target.centre();
  const double end = std::max(dot(along, xy(impact.position) - origin), dot(along, xy(centre) - origin));
  const double bottom = std::min({flight.muzzle.z, impact.position.z, target.base.z}) - 0.3;

  std::vector<ProfilePiece> pieces;
  const auto add = [&](const Solid& solid) {
    for (auto& polygon : slice(solid, origin, along)) {
      polygon =
          clip(clip(clip(polygon, {-1.0, 0.0}, spare_m), {1.0, 0.0}, end + spare_m), {0.0, -1.0}, -bottom);
      if (polygon.size() >= 2) pieces.push_back({solid.name, std::move(polygon)});
    }
  };
  for (const Solid& solid : space.solids()) add(solid);
  add(solid_of(target));
  return pieces;
}

}  // namespace outrider
