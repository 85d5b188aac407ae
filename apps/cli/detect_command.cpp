#include <fmt/format.h>

#include <cmath>
#include <memory>
#include <nlohmann/json.hpp>

#include "commands.hpp"
#include "flags.hpp"
#include "output.hpp"
#include "outrider/core/units.hpp"
#include "outrider/estimate/planar_pnp.hpp"
#include "outrider/estimate/tag_detector.hpp"
#include "outrider/io/camera_file.hpp"
#include "outrider/io/files.hpp"
#include "outrider/io/photo.hpp"
#include "tag_picture.hpp"
#include "terminal.hpp"

namespace outrider::cli {
namespace {

struct DetectCommand {
  std::string path;
  bool json = false;
  std::string svg;
  std::string calibration;
  std::string camera;
  double size_m = default_tag_size_m;
  TagDetectorOptions detector;
  PlanarPnpOptions pnp;
};

std::vector<OptionGroup> describe(DetectCommand& command) {
  return {{"",
           "output",
           {{"json", "", 0, 0, "print one JSON object on standard output", &command.json},
            {"svg", "", 0, 0, "file to write, the photo with what was found", &command.svg}}},
          {"",
           "camera and tags",
           {{"calibration", "", 0, 0, "YAML file with the camera matrix; without it there are no poses",
             &command.calibration},
            {"camera", "", 0, 0, "which camera of a calibration file with several", &command.camera},
            {"size", "m", 1e-4, 100, "side of the black square of the tags", &command.size_m}}},
          {"", "detection", describe(command.detector)},
          {"", "poses", describe(command.pnp)}};
}

/// Returns the yaw of the tag, counter-clockwise as seen from above an upright camera; 0 if the tag faces the
/// camera's plane.
double yaw_rad(const Pose3& camera_T_tag) {
  const Vec3 into_tag = camera_T_tag.rotation.axes[2];
  return -std::atan2(into_tag.x, into_tag.z);
}

nlohmann::ordered_json pose_json(const TagPose& pose) {
  const Vec3 t = pose.camera_T_tag.position;
  const auto& axes = pose.camera_T_tag.rotation.axes;
  const auto sigma = [&](int i) { return std::sqrt(pose.covariance(i, i)); };
  return {{"translation_m", {t.x, t.y, t.z}},
          {"rotation",
           {{axes[0].x, axes[1].x, axes[2].x},
            {axes[0].y, axes[1].y, axes[2].y},
            {axes[0].z, axes[1].z, axes[2].z}}},
          {"yaw_deg", degrees(yaw_rad(pose.camera_T_tag))},
          {"distance_m", norm(t)},
          {"error_px", pose.error_px},
          {"sigma_m", {sigma(0), sigma(1), sigma(2)}},
          {"sigma_deg", {degrees(sigma(3)), degrees(sigma(4)), degrees(sigma(5))}}};
}

nlohmann::ordered_json tags_json(const CameraImage& image, const std::vector<TagSighting>& sightings) {
  auto tags = nlohmann::ordered_json::array();
  for (const TagSighting& sighting : sightings) {
    auto corners = nlohmann::ordered_json::array();
    for (const Vec2 corner : sighting.corners_px) corners.push_back({corner.x, corner.y});
    auto poses = nlohmann::ordered_json::array();
    for (const TagPose& pose : sighting.poses) poses.push_back(pose_json(pose));
    tags.push_back({{"id", sighting.id},
                    {"corners", std::move(corners)},
                    {"corrected_bits", sighting.corrected_bits},
                    {"margin", sighting.margin},
                    {"poses", std::move(poses)}});
  }
  return {{"status", "done"}, {"width", image.width}, {"height", image.height}, {"tags", std::move(tags)}};
}

void print_table(const std::vector<TagSighting>& sightings) {
  show("{} tag{} found\n", sightings.size(), sightings.size() == 1 ? "" : "s");
  for (const TagSighting& sighting : sightings) {
    show("  {:3}  corners", sighting.id);
    for (const Vec2 corner : sighting.corners_px) show(" ({:.2f}, {:.2f})", corner.x, corner.y);
    show("\n");
    for (const TagPose& pose : sighting.poses) {
      const Vec3 t = pose.camera_T_tag.position;
      show("       at ({:.3f}, {:.3f}, {:.3f}) m, turned by {:.1f} deg; error {:.2f} px\n", t.x, t.y, t.z,
           degrees(yaw_rad(pose.camera_T_tag)), pose.error_px);
    }
  }
}

/// Returns the camera from the calibration file, with the size of this image.
Outcome<Camera> camera_for(const DetectCommand& command, const CameraImage& image) {
  auto camera = load_camera(command.calibration, command.camera);
  if (!camera) return camera;
  const bool told = camera->width_px > 0 && camera->height_px > 0;
  if (told && (camera->width_px != image.width || camera->height_px != image.height)) {
    return bad_input(
        fmt::format("it is for images of {} x {} pixels, and {} has {} x {}; take the image as it came from "
                    "the camera",
                    camera->width_px, camera->height_px, command.path, image.width, image.height),
        command.calibration);
  }
  camera->width_px = image.width;
  camera->height_px = image.height;
  return camera;
}

int execute(DetectCommand& command, const Command& flags) {
  const bool json = flags.given("--json");
  if (auto ok = apply_flags(flags, describe(command)); !ok) return print_fault(ok.error(), json);
  const auto image = load_photo(command.path);
  if (!image) return print_fault(image.error(), json);
  Camera camera;
  std::vector<TagSighting> sightings = TagDetector(command.detector).detect(*image);
  if (flags.given("--calibration")) {
    const auto calibrated = camera_for(command, *image);
    if (!calibrated) return print_fault(calibrated.error(), json);
    camera = *calibrated;
    for (TagSighting& sighting : sightings) {
      sighting.poses = planar_pnp(camera, command.size_m, sighting.corners_px, command.pnp);
    }
  }
  if (flags.given("--svg")) {
    const std::string picture = tag_picture(*image, camera, command.size_m, sightings);
    if (auto ok = write_file(command.svg, picture); !ok) return print_fault(ok.error(), json);
  }
  if (json) {
    print(tags_json(*image, sightings));
  } else {
    print_table(sightings);
  }
  return job_done;
}

}  // namespace

void add_detect(Command& tool) {
  Command& detect = tool.add("detect", "find AprilTags (tag36h11) in a photo, with their poses");
  auto command = std::make_shared<DetectCommand>();
  detect.positional("image", &command->path, "photo: PNG, JPEG or PGM").required().type("FILE");
  add_flags(detect, describe(*command));
  detect.does([command](const Command& flags) { return execute(*command, flags); });
  detect.footer("\nExample: outrider detect photo.jpg --calibration camera.yaml --size 0.166 --svg tags.svg");
}

}  // namespace outrider::cli
