#include "outrider/world/world.hpp"

#include <utility>

namespace outrider {

World World::with(Solid solid) const {
  World next = *this;
  next.solids.push_back(std::move(solid));
  return next;
}

World World::on(std::shared_ptr<const HeightField> ground) const {
  World next = *this;
  const auto floors = std::erase_if(next.solids, [](const Solid& solid) {
    const bool upright = solid.world_T_solid.rotation.axes[2].z > 1.0 - 1e-9;
    return std::holds_alternative<HeightFieldShape>(solid.shape) ||
           (std::holds_alternative<HalfSpaceShape>(solid.shape) && upright);
  });
  const bool flat = ground->lowest_m() == floor_z_m && ground->highest_m() == floor_z_m;
  if (floors > 0 && flat && !terrain) return *this;
  next.solids.insert(next.solids.begin(), Solid{"terrain", {}, HeightFieldShape{ground}});
  next.floor_z_m = ground->lowest_m();
  next.terrain = std::move(ground);
  return next;
}

Box2 standing_bounds(const World& world) {
  constexpr double flat_m = 0.01;  // excludes paint, mats and thresholds
  Box2 yard;
  for (const Solid& solid : world.solids) {
    if (std::holds_alternative<HalfSpaceShape>(solid.shape) ||
        std::holds_alternative<HeightFieldShape>(solid.shape)) {
      continue;
    }
    const Box3 box = bounds(solid);
    if (box.high.z < world.floor_z_m + flat_m) continue;
    yard.include(box.ground().low);
    yard.include(box.ground().high);
  }
  return yard;
}

}  // namespace outrider
