#include "guard_strewn.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "outrider/core/rng.hpp"
#include "outrider/core/units.hpp"

namespace outrider::bench {
namespace {

constexpr double area_m2 = 10.0;     // for each target
constexpr double middle_m = 3.0;     // half of the side that is left free for the robot
constexpr double between_m = 0.8;    // boxes, so that the robot passes
constexpr double to_target_m = 0.4;  // from a box to the middle of a target
constexpr double wall_m = 0.1;

struct Footprint {
  Vec2 centre;
  double radius_m = 0.0;
};

bool is_free(const std::vector<Footprint>& taken, Vec2 at, double clear_m) {
  return std::ranges::none_of(
      taken, [&](const Footprint& other) { return distance(at, other.centre) < clear_m + other.radius_m; });
}

Vec2 anywhere(Rng& rng, double half_m) {
  return {rng.uniform(-half_m, half_m), rng.uniform(-half_m, half_m)};
}

void add_box(World& world, const char* name, Vec2 at, Vec3 size, double yaw_rad) {
  world.solids.push_back({fmt::format("{}_{}", name, world.solids.size()),
                          {{at.x, at.y, 0.5 * size.z}, Rotation::from_rpy(0.0, 0.0, yaw_rad)},
                          BoxShape{0.5 * size}});
}

void add_wall(World& world, double half_m) {
  for (const double side : {-half_m, half_m}) {
    add_box(world, "wall", {side, 0.0}, {wall_m, 2.0 * half_m, 1.0}, 0.0);
    add_box(world, "wall", {0.0, side}, {2.0 * half_m, wall_m, 1.0}, 0.0);
  }
}

/// Returns what the boxes take up.
std::vector<Footprint> add_boxes(Rng& rng, World& world, std::int64_t boxes, double half_m) {
  std::vector<Footprint> taken;
  while (std::ssize(taken) < boxes) {
    const Vec3 size{rng.uniform(0.2, 1.5), rng.uniform(0.2, 1.5), rng.uniform(0.3, 2.0)};
    const double radius_m = 0.5 * std::hypot(size.x, size.y);
    const Vec2 at = anywhere(rng, half_m - 2.0);
    if (std::max(std::abs(at.x), std::abs(at.y)) < middle_m) continue;
    if (!is_free(taken, at, radius_m + between_m)) continue;
    add_box(world, "box", at, size, rng.uniform(-pi, pi));
    taken.push_back({at, radius_m});
  }
  return taken;
}

}  // namespace

GuardProblem strewn_yard(std::int64_t targets) {
  Rng rng(static_cast<std::uint64_t>(targets));
  const double half_m = std::max(0.5 * std::sqrt(area_m2 * static_cast<double>(targets)), 2.0 * middle_m);
  GuardProblem problem;
  problem.world.name = fmt::format("{} targets", targets);
  problem.world.bounds = {{-half_m, -half_m}, {half_m, half_m}};
  problem.start = {};
  problem.world.solids.push_back({"floor", {}, HalfSpaceShape{}});
  add_wall(problem.world, half_m);
  const std::vector<Footprint> taken = add_boxes(rng, problem.world, targets, half_m);
  while (std::ssize(problem.targets) < targets) {
    const Vec2 at = anywhere(rng, half_m - 1.0);
    if (!is_free(taken, at, to_target_m)) continue;
    problem.targets.push_back({fmt::format("target_{}", problem.targets.size()),
                               {at.x, at.y, 0.0},
                               {0.46, 0.36, 0.3},
                               rng.uniform(-pi, pi)});
  }
  return problem;
}

}  // namespace outrider::bench
