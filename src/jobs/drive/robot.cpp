#include "outrider/jobs/drive/robot.hpp"

#include <algorithm>

#include "outrider/core/units.hpp"
#include "outrider/jobs/drive/tag_model.hpp"

namespace outrider {
namespace {

constexpr double instant_s = 1e-9;  ///< times closer than this are one
constexpr double band_m = 0.01;     ///< of heights about the camera, in which sight lines are sought

/// The parts of the world at the height of the camera, as obstacles to sight.
Ground sight_lines(const World& world, double height_m) {
  std::vector<RoundedPolygon> obstacles;
  const double z_m = world.floor_z_m + height_m;
  for (const Solid& solid : world.solids) {
    for (RoundedPolygon& piece : footprint(solid, z_m - band_m, z_m + band_m)) {
      obstacles.push_back(std::move(piece));
    }
  }
  constexpr double beyond_m = 10.0;  // tags hang on walls, which may stand on the edge
  return {world.bounds.grown(beyond_m), std::move(obstacles)};
}

}  // namespace

SimulatedDrive::SimulatedDrive(const DriveTask& task, const DriveTruth& truth, bool rendered,
                               std::uint64_t seed)
    : task_(task),
      truth_(truth),
      motion_(task.chassis, truth.wheels, truth.link, task.start, Rng(seed)),
      sight_lines_(sight_lines(task.world, task.eye.height_m)),
      sight_rng_(Rng(seed).child("sight")) {
  if (!rendered) return;
  TagCameraOptions options;
  options.rate_hz = task.eye.rate_hz;
  options.exposure_s = task.eye.exposure_s;
  camera_ = std::make_unique<TagCamera>(TagScene{task.world, task.tags}, robot_camera(task.eye), options,
                                        Rng(seed).child("camera"));
}

DriveObservation SimulatedDrive::sense() {
  seen_.time_s = motion_.time_s();
  return seen_;
}

/// Takes the image that is due now.
void SimulatedDrive::look() {
  ++images_;
  seen_.seen_at_s = motion_.time_s();
  seen_.sightings.clear();
  if (!task_.closed_loop || motion_.time_s() >= truth_.blind_from_s) return;
  const Pose2& closing = motion_.pose();
  if (camera_) {
    seen_.sightings = camera_->look(moved(closing, motion_.twist(), -task_.eye.exposure_s), closing);
  } else {
    seen_.sightings = modelled_sightings(task_, truth_, sight_lines_, closing, sight_rng_);
  }
}

void SimulatedDrive::act(const DriveCommand& command) {
  motion_.send(command.wheels);
  while (motion_.time_s() < command.until_s - instant_s) {
    const double image_s = static_cast<double>(images_ + 1) / task_.eye.rate_hz;
    const bool due = image_s <= command.until_s + instant_s;
    motion_.run_until(due ? std::min(image_s, command.until_s) : command.until_s);
    if (!kidnapped_ && motion_.time_s() >= truth_.kidnapped_at_s) {
      kidnapped_ = true;
      motion_.put(compose(motion_.pose(), {{0.0, truth_.kidnapped_by_m}, truth_.kidnapped_by_rad}));
    }
    if (due) look();
  }
}

}  // namespace outrider
