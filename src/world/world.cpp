#include "outrider/world/world.hpp"

#include <utility>

namespace outrider {

World World::with(Solid solid) const {
  World next = *this;
  next.solids.push_back(std::move(solid));
  return next;
}

Box2 standing_bounds(const World& world) {
  constexpr double flat_m = 0.01;  // paint, mats and thresholds are no walls
  Box2 yard;
  for (const Solid& solid : world.solids) {
    if (std::holds_alternative<HalfSpaceShape>(solid.shape)) continue;
    const Box3 box = bounds(solid);
    if (box.high.z < world.floor_z_m + flat_m) continue;
    yard.include(box.ground().low);
    yard.include(box.ground().high);
  }
  return yard;
}

}  // namespace outrider
