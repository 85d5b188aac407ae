// Measures one image of the simulated camera, 1920 x 1080: it is rendered where tags may be visible and
// searched for tags, then their poses and the robot position are computed. Counters: detected tags, and the
// position error in mm.
#include <benchmark/benchmark.h>

#include "outrider/core/units.hpp"
#include "outrider/estimate/localise.hpp"
#include "outrider/sim/sensors/tag_camera.hpp"

namespace outrider {
namespace {

const RobotCamera mount{Camera{}, looking_ahead({0.05, 0.0, 0.15})};

/// Returns a corner with four tags, 0.5 to 3 m from the robot.
TagScene corner() {
  const auto box = [](Vec3 centre, Vec3 half_size) {
    return Solid{"wall", {centre, {}}, BoxShape{half_size}};
  };
  TagScene scene;
  scene.world.solids = {box({2.05, 1.0, 0.25}, {0.05, 1.5, 0.25}), box({1.0, 2.55, 0.25}, {1.5, 0.05, 0.25}),
                        box({-0.05, 2.0, 0.25}, {0.05, 0.3, 0.25}), box({1.2, 1.2, 0.25}, {0.1, 0.1, 0.25})};
  scene.tags = {{upright_tag(1, {2.0, 1.0, 0.25}, pi), upright_tag(2, {1.0, 2.5, 0.2}, -pi / 2),
                 upright_tag(3, {0.0, 2.0, 0.3}, 0.0), upright_tag(4, {2.0, 0.2, 0.2}, pi)}};
  return scene;
}

void look(benchmark::State& state) {
  const TagScene scene = corner();
  TagCamera eye(scene, mount, {}, Rng(1));
  Rng rng(5);
  double seen = 0.0, error_m = 0.0, fixes = 0.0;
  for (auto _ : state) {
    const Pose2 opening{{rng.uniform(-0.2, 1.2), rng.uniform(-0.4, 1.2)}, rng.uniform(0.0, pi / 2)};
    const Pose2 closing{opening.position + Vec2{0.002, 0.0}, opening.heading_rad + 0.005};
    const auto sightings = eye.look(opening, closing);
    const PoseBelief prior{opening, 0.0025 * Eigen::Matrix3d::Identity()};
    const TagFix fix = localise(sightings, scene.tags, mount, prior);
    seen += static_cast<double>(sightings.size());
    if (!fix.belief) continue;
    error_m += distance(fix.belief->world_T_robot.position, 0.5 * (opening.position + closing.position));
    fixes += 1.0;
  }
  state.counters["tags"] = benchmark::Counter(seen, benchmark::Counter::kAvgIterations);
  state.counters["error_mm"] = 1000.0 * error_m / fixes;
}

BENCHMARK(look)->Name("sim/tag_camera")->Unit(benchmark::kMillisecond)->Iterations(200);

}  // namespace
}  // namespace outrider
