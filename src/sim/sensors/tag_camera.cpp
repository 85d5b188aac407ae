#include "outrider/sim/sensors/tag_camera.hpp"

#include "outrider/core/units.hpp"

namespace outrider {

std::vector<Option> describe(TagCameraOptions& options) {
  return {{"rate", "Hz", 0.1, 1000, "images per second", &options.rate_hz},
          {"exposure", "s", 0, 1, "for which the shutter is open", &options.exposure_s},
          {"noise", "", 0, 255, "standard deviation of a pixel, of 255 levels", &options.noise_grey},
          {"black", "", 0, 255, "grey level of ink", &options.black_grey},
          {"white", "", 0, 255, "grey level of paper", &options.white_grey},
          {"samples", "", 1, 8, "across a pixel and down it", &options.samples},
          {"least_tag", "px", 1, 1e4, "tags that appear smaller are not rendered", &options.least_tag_px}};
}

namespace {

TagDetectorOptions of_family(TagDetectorOptions options, TagFamily family) {
  options.families = std::vector<TagFamily>(1, family);
  return options;
}

}  // namespace

TagCamera::TagCamera(TagScene scene, const RobotCamera& robot_camera, const TagCameraOptions& options,
                     const Rng& rng, const TagDetectorOptions& detector, const PlanarPnpOptions& pnp)
    : scene_(std::move(scene)),
      robot_camera_(robot_camera),
      options_(options),
      pnp_(pnp),
      detector_(of_family(detector, scene_.tags.family)),
      rng_(rng) {}

std::vector<TagSighting> TagCamera::look(const Pose2& opening, const Pose2& closing) {
  const auto world_T_camera = [&](const Pose2& robot) {
    const double floor_z_m = scene_.world.ground_z_m(robot.position);
    return Pose3{{robot.position.x, robot.position.y, floor_z_m},
                 Rotation::from_rpy(0.0, 0.0, robot.heading_rad)} *
           robot_camera_.robot_T_camera;
  };
  const Camera& camera = robot_camera_.camera;
  const Pose3 from = world_T_camera(opening), to = world_T_camera(closing);
  image_ = render_tags(camera, scene_, from, to, tag_boxes(camera, scene_, from, to, options_), options_,
                       rng_.child(taken_++));
  std::vector<TagSighting> sightings = detector_.detect(image_.image, image_.boxes);
  for (TagSighting& sighting : sightings) {
    const Tag* tag = scene_.tags.find(sighting.id);
    if (tag != nullptr) sighting.poses = planar_pnp(camera, tag->size_m, sighting.corners_px, pnp_);
  }
  return sightings;
}

}  // namespace outrider
