#include <fmt/format.h>

#include <memory>
#include <nlohmann/json.hpp>
#include <optional>

#include "commands/commands.hpp"
#include "flags.hpp"
#include "output/detect_output.hpp"
#include "output/output.hpp"
#include "output/tag_picture.hpp"
#include "output/terminal.hpp"
#include "outrider/core/text.hpp"
#include "outrider/estimate/planar_pnp.hpp"
#include "outrider/estimate/tag_detector.hpp"
#include "outrider/io/camera/camera_file.hpp"
#include "outrider/io/camera/image_topics.hpp"
#include "outrider/io/camera/photo.hpp"
#include "outrider/io/files/files.hpp"
#include "outrider/io/log/log_file.hpp"

namespace outrider::cli {
namespace {

constexpr std::int64_t few_tags = 4;  ///< fewer than that are worth a search at other scales

struct DetectCommand {
  std::string path;
  bool json = false;
  std::string svg;
  std::string calibration;
  std::string camera;
  ImageTopicsOptions topics;  ///< of a log instead of a photo
  double size_m = default_tag_size_m;
  std::string family = "tag36h11";
  TagDetectorOptions detector{.few = few_tags};
  PlanarPnpOptions pnp;
};

std::vector<OptionGroup> describe(DetectCommand& command) {
  return {
      {"",
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
        {"family", "", 0, 0, "families of the tags, with commas between; all: every one", &command.family},
        {"size", "m", 1e-4, 100, "side of the square of the tags at whose edge black meets white",
         &command.size_m}}},
      {"", "detection", describe(command.detector)},
      {"", "poses", describe(command.pnp)}};
}

nlohmann::ordered_json family_names(const DetectCommand& command) {
  auto names = nlohmann::ordered_json::array();
  for (const TagFamily family : command.detector.families) names.push_back(layout(family).name);
  return names;
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
std::vector<TagSighting> detect_tags(TagDetector& detector, const DetectCommand& command,
                                     const CameraImage& image, const std::optional<Camera>& camera) {
  std::vector<TagSighting> sightings = detector.detect(image);
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
  auto images = ImageTopics::open(command.path, command.topics);
  if (!images) return print_fault(images.error(), json);
  TagDetector detector(command.detector);
  auto rows = nlohmann::ordered_json::array();
  std::size_t count = 0, tags = 0;
  for (;; ++count) {
    const auto read = images->next();
    if (!read) return print_fault(read.error(), json);
    if (!*read) break;
    const auto& [time_s, image] = **read;
    const auto camera = camera_of_log(command, *images, image);
    if (!camera) return print_fault(camera.error(), json);
    const auto sightings = detect_tags(detector, command, image, *camera);
    if (sightings.empty()) continue;
    tags += sightings.size();
    if (json) {
      rows.push_back({{"time_s", time_s}, {"tags", tags_json(sightings)}});
    } else {
      show("at {:.3f} s: {} tag{} found\n", time_s, sightings.size(), sightings.size() == 1 ? "" : "s");
      print_table(sightings, command.detector.families);
    }
  }
  if (const std::string cut = images->cut_short(); !cut.empty()) warn(cut);
  if (json) {
    print({{"status", "done"},
           {"families", family_names(command)},
           {"images", count},
           {"sightings", std::move(rows)}});
  } else if (tags == 0) {
    show("{} images, 0 tags found: {}\n", count, none_found(command.detector.families, {}));
  } else {
    show("{} images\n", count);
  }
  return job_done;
}

int execute(DetectCommand& command, const Command& flags) {
  const bool json = flags.given("--json");
  if (auto ok = apply_flags(flags, describe(command)); !ok) return print_fault(ok.error(), json);
  auto families = parse_tag_families(command.family);
  if (!families) {
    families.error().where = "--family";
    return print_fault(families.error(), json);
  }
  command.detector.families = std::move(*families);
  if (!command.camera.empty() && command.calibration.empty()) {
    return print_fault({FaultCode::bad_input,
                        fmt::format("'{}' is to be a camera of a calibration file, and there is none; give "
                                    "--calibration FILE too",
                                    excerpt(command.camera)),
                        "--camera"},
                       json);
  }
  if (is_log_file(command.path)) return execute_on_log(command, json);
  const auto image = load_photo(command.path);
  if (!image) return print_fault(image.error(), json);
  std::optional<Camera> camera;
  if (flags.given("--calibration")) {
    const auto calibrated = sized(load_camera(command.calibration, command.camera), command, *image);
    if (!calibrated) return print_fault(calibrated.error(), json);
    camera = *calibrated;
  }
  TagDetector detector(command.detector);
  const std::vector<TagSighting> sightings = detect_tags(detector, command, *image, camera);
  const auto others = sightings.empty() ? count_others(*image, command.detector) : std::vector<FamilyCount>{};
  if (flags.given("--svg")) {
    const std::string picture = tag_picture(*image, camera.value_or(Camera{}), command.size_m, sightings);
    if (auto ok = write_file(command.svg, picture); !ok) return print_fault(ok.error(), json);
  }
  if (json) {
    nlohmann::ordered_json found{{"status", "done"},
                                 {"width", image->width},
                                 {"height", image->height},
                                 {"families", family_names(command)},
                                 {"tags", tags_json(sightings)}};
    for (const FamilyCount& other : others) found["other_families"][layout(other.family).name] = other.tags;
    print(found);
  } else if (sightings.empty()) {
    show("0 tags found: {}\n", none_found(command.detector.families, others));
  } else {
    show("{} tag{} found\n", sightings.size(), sightings.size() == 1 ? "" : "s");
    print_table(sightings, command.detector.families);
  }
  return job_done;
}

}  // namespace

void add_detect(Command& tool) {
  Command& detect = tool.add("detect", "find AprilTags in a photo, with their poses");
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
