#include <iostream>
#include <outrider/world/collision_map.hpp>

int main() {
  outrider::World yard;
  yard.bounds = {{-5.0, -5.0}, {5.0, 5.0}};
  yard = yard.with({"crate", {{2.0, 0.0, 0.5}, {}}, outrider::BoxShape{{0.5, 0.5, 0.5}}});

  const outrider::CollisionMap ground = outrider::CollisionMap::of(yard, /*robot_height_m=*/0.2);
  const bool free = ground.segment_free({{0.0, -4.0}, {0.0, 4.0}}, /*radius_m=*/0.26);
  std::cout << "clearance at the origin: " << ground.clearance({0.0, 0.0}, /*most_m=*/3.0) << " m\n"
            << "the drive from south to north is " << (free ? "free" : "blocked") << '\n';
}
