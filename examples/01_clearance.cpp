// Finds the obstacles of a robot and its distance from them.
#include <fmt/format.h>

#include "outrider/world/collision_map.hpp"

using namespace outrider;

int main() {
  World yard;
  yard.bounds = {{-5.0, -5.0}, {5.0, 5.0}};
  yard = yard.with({"crate", {{2.0, 0.0, 0.5}, {}}, BoxShape{{0.5, 0.5, 0.5}}});
  yard = yard.with({"table top", {{-2.0, 0.0, 0.8}, {}}, BoxShape{{1.0, 1.0, 0.05}}});
  yard = yard.with({"table leg", {{-2.0, 0.0, 0.4}, {}}, CylinderShape{0.1, 0.4}});

  const CollisionMap ground = CollisionMap::of(yard, /*robot_height_m=*/0.2);
  fmt::print("obstacles for a low robot: {}\n", ground.obstacles().size());
  fmt::print("clearance at the origin: {:.2f} m\n", ground.clearance({0.0, 0.0}, /*most_m=*/5.0));
  const auto drive = [&](const char* way, Segment s) {
    fmt::print("{}: {}\n", way, ground.segment_free(s, /*radius_m=*/0.26) ? "free" : "blocked");
  };
  drive("under the table", {{-2.5, -4.0}, {-2.5, 4.0}});
  drive("through the crate", {{0.0, 0.0}, {4.0, 0.0}});
}

// Prints:
// obstacles for a low robot: 2
// clearance at the origin: 1.50 m
// under the table: free
// through the crate: blocked
