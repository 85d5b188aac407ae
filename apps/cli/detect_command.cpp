#include <fmt/format.h>

#include <cmath>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>

#include "commands.hpp"
#include "flags.hpp"
#include "output.hpp"
#include "outrider/core/units.hpp"
#include "outrider/estimate/planar_pnp.hpp"
#include "outrider/estimate/tag_detector.hpp"
#include "outrider/io/camera_file.hpp"
#include "outrider/io/files.hpp"
#include "outrider/io/image_topics.hpp"
#include "outrider/io/log_file.hpp"
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
  ImageTopicsOptions topics;  ///< of a log instead of a photo
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
           "logs of ROS",
           {{"image_topic", "", 0, 0, "topic of the images; needed if the log has several",
             &command.topics.image},
            {"info_topic", "", 0, 0, "topic of the camera; empty: camera_info beside the images",
             &command.topics.info}}},
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

nlohmann::ordered_json tags_json(const std::vector<TagSighting>& sightings) {
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
  return tags;
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

/// Returns the camera for images of this size.
Outcome<Camera> sized(Outcome<Camera> camera, const DetectCommand& command, const CameraImage& image) {
  if (!camera) return camera;
  const bool told = camera->width_px > 0 && camera->height_px > 0;
  if (told && (camera->width_px != image.width || camera->height_px != image.height)) {
    return bad_input(
        fmt::format("it is for images of {} x {} pixels, and {} has {} x {}; take the image as it came from "
                    "the camera",
                    camera->width_px, camera->height_px, command.path, image.width, image.height),
        command.calibration.empty() ? "--info-topic" : command.calibration);
  }
  camera->width_px = image.width;
  camera->height_px = image.height;
  return camera;
}

/// Detects the tags of an image, with their poses if the camera is known.
std::vector<TagSighting> detect_tags(const DetectCommand& command, const CameraImage& image,
                                     const std::optional<Camera>& camera) {
  std::vector<TagSighting> sightings = TagDetector(command.detector).detect(image);
  if (!camera) return sightings;
  for (TagSighting& sighting : sightings) {
    sighting.poses = planar_pnp(*camera, command.size_m, sighting.corners_px, command.pnp);
  }
  return sightings;
}

/// Returns the camera of the calibration file, or else that of the log, for images of this size.
Outcome<std::optional<Camera>> camera_of_log(const DetectCommand& command, const ImageTopics& images,
                                             const CameraImage& image) {
  if (command.calibration.empty() && !images.camera()) return std::optional<Camera>{};
  auto camera = command.calibration.empty() ? Outcome<Camera>(*images.camera())
                                            : load_camera(command.calibration, command.camera);
  camera = sized(std::move(camera), command, image);
  if (!camera) return pass_on(camera);
  return std::optional(*camera);
}

/// Detects the tags in each image of a log. Images without tags are counted only.
int execute_on_log(const DetectCommand& command, bool json) {
  if (!command.svg.empty()) {
    return print_fault({FaultCode::bad_input, "a log has many images; --svg is for a photo", "--svg"}, json);
  }
  auto images = open_image_topics(command.path, command.topics);
  if (!images) return print_fault(images.error(), json);
  auto rows = nlohmann::ordered_json::array();
  std::size_t count = 0;
  for (;; ++count) {
    const auto read = (*images)->next();
    if (!read) return print_fault(read.error(), json);
    if (!*read) break;
    const auto& [time_s, image] = **read;
    const auto camera = camera_of_log(command, **images, image);
    if (!camera) return print_fault(camera.error(), json);
    const auto sightings = detect_tags(command, image, *camera);
    if (sightings.empty()) continue;
    if (json) {
      rows.push_back({{"time_s", time_s}, {"tags", tags_json(sightings)}});
    } else {
      show("at {:.3f} s: ", time_s);
      print_table(sightings);
    }
  }
  if (const std::string cut = (*images)->cut_short(); !cut.empty()) warn(cut);
  if (json) {
    print({{"status", "done"}, {"images", count}, {"sightings", std::move(rows)}});
  } else {
    show("{} images\n", count);
  }
  return job_done;
}

int execute(DetectCommand& command, const Command& flags) {
  const bool json = flags.given("--json");
  if (auto ok = apply_flags(flags, describe(command)); !ok) return print_fault(ok.error(), json);
  if (is_log_file(command.path)) return execute_on_log(command, json);
  const auto image = load_photo(command.path);
  if (!image) return print_fault(image.error(), json);
  std::optional<Camera> camera;
  if (flags.given("--calibration")) {
    const auto calibrated = sized(load_camera(command.calibration, command.camera), command, *image);
    if (!calibrated) return print_fault(calibrated.error(), json);
    camera = *calibrated;
  }
  const std::vector<TagSighting> sightings = detect_tags(command, *image, camera);
  if (flags.given("--svg")) {
    const std::string picture = tag_picture(*image, camera.value_or(Camera{}), command.size_m, sightings);
    if (auto ok = write_file(command.svg, picture); !ok) return print_fault(ok.error(), json);
  }
  if (json) {
    print({{"status", "done"},
           {"width", image->width},
           {"height", image->height},
           {"tags", tags_json(sightings)}});
  } else {
    print_table(sightings);
  }
  return job_done;
}

}  // namespace

void add_detect(Command& tool) {
  Command& detect = tool.add("detect", "find AprilTags (tag36h11) in a photo, with their poses");
  auto command = std::make_shared<DetectCommand>();
  detect
      .positional("image", &command->path,
                  "photo: PNG, JPEG or PGM; or MCAP, ROS 1 bag or ROS 2 db3 with images")
      .required()
      .type("FILE");
  add_flags(detect, describe(*command));
  detect.does([command](const Command& flags) { return execute(*command, flags); });
  detect.footer("\nExample: outrider detect photo.jpg --calibration camera.yaml --size 0.166 --svg tags.svg");
}

}  // namespace outrider::cli
