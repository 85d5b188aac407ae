#include "outrider/nodes/missions/tag_sight.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "outrider/estimate/planar_pnp.hpp"
#include "outrider/io/camera/image_topics.hpp"

namespace outrider {
namespace {

constexpr std::size_t most_detections = 1000;
constexpr double farthest_px = 1e5;

TagDetectorOptions detector_options(TagFamily family) {
  TagDetectorOptions options;
  options.families = {family};
  options.refine_edges = true;
  return options;
}

/// Moves a point of the image of one lens to where it appears in that of another.
std::optional<Vec2> moved_between(const Camera& from, const Camera& to, Vec2 point_px) {
  const Vec2 ray = ray_through(from, point_px);
  return project(to, {ray.x, ray.y, 1.0});
}

}  // namespace

TagSight::TagSight(TagMap tags) : tags_(std::move(tags)), detector_(detector_options(tags_.family)) {}

Camera rectified_camera(const sensor_msgs::CameraInfo& info, const Camera& camera) {
  Camera rectified = camera;
  rectified.distortion = {};
  if (info.p[0] > 0.0 && info.p[5] > 0.0) {  // P is all zeros where nobody has calibrated it
    rectified.fx = info.p[0];
    rectified.cx = info.p[2];
    rectified.fy = info.p[5];
    rectified.cy = info.p[6];
  }
  return rectified;
}

Status TagSight::take(const sensor_msgs::CameraInfo& info) {
  auto camera = camera_of(info);
  if (!camera) return pass_on(camera);
  Camera rectified = rectified_camera(info, *camera);
  if (auto good = check_camera(rectified); !good) return good;
  camera_ = *camera;
  rectified_ = rectified;
  return {};
}

void TagSight::see(double taken_s, std::vector<TagSighting> sightings) {
  std::erase_if(sightings, [&](const TagSighting& sighting) { return tags_.find(sighting.id) == nullptr; });
  for (TagSighting& sighting : sightings)
    sighting.poses = planar_pnp(*camera_, tags_.find(sighting.id)->size_m, sighting.corners_px);
  std::erase_if(sightings, [](const TagSighting& sighting) { return sighting.poses.empty(); });
  newest_ = TagImage{taken_s, std::move(sightings)};
}

Status TagSight::take(const sensor_msgs::Image& message) {
  const auto taken_s = images_.take(message.header.stamp);
  if (!taken_s) return pass_on(taken_s);
  if (!camera_) return bad_input("no camera_info has come yet, and without it an image tells nothing");
  auto image = grey_image(message);
  if (!image) return pass_on(image);
  if (image->width != camera_->width_px || image->height != camera_->height_px) {
    return bad_input(fmt::format("it has {} x {} pixels, and camera_info says {} x {}", image->width,
                                 image->height, camera_->width_px, camera_->height_px));
  }
  see(*taken_s, detector_.detect(*image));
  return {};
}

Status TagSight::take(const apriltag_msgs::AprilTagDetectionArray& message) {
  const auto taken_s = detections_.take(message.header.stamp);
  if (!taken_s) return pass_on(taken_s);
  if (!camera_) return bad_input("no camera_info has come yet, and without it detections tell nothing");
  if (message.detections.size() > most_detections) {
    return bad_input(
        fmt::format("it has {} detections; up to {} are taken", message.detections.size(), most_detections));
  }
  std::vector<TagSighting> sightings;
  for (const apriltag_msgs::AprilTagDetection& detection : message.detections) {
    if (detection.family != layout(tags_.family).name) continue;
    TagSighting sighting;
    sighting.id = detection.id;
    sighting.corrected_bits = detection.hamming;
    sighting.margin = static_cast<double>(detection.decision_margin);
    sighting.family = tags_.family;
    for (std::size_t i = 0; i < 4; ++i) {
      const Vec2 corner{detection.corners[2 * i], detection.corners[2 * i + 1]};
      if (!finite(corner) || norm(corner) > farthest_px)
        return bad_input(
            fmt::format("a corner of tag {} is at {:g}, {:g}", detection.id, corner.x, corner.y));
      const auto raw = moved_between(rectified_, *camera_, corner);
      if (!raw)
        return bad_input(fmt::format("a corner of tag {} is where the lens shows nothing", detection.id));
      sighting.corners_px[i] = *raw;
    }
    sightings.push_back(std::move(sighting));
  }
  see(*taken_s, std::move(sightings));
  return {};
}

apriltag_msgs::AprilTagDetectionArray detections_of(const TagImage& image, const Camera& camera,
                                                    const std_msgs::Header& header) {
  Camera rectified = camera;
  rectified.distortion = {};
  apriltag_msgs::AprilTagDetectionArray message;
  message.header = header;
  for (const TagSighting& sighting : image.sightings) {
    apriltag_msgs::AprilTagDetection detection;
    detection.family = layout(sighting.family).name;
    detection.id = sighting.id;
    detection.hamming = sighting.corrected_bits;
    detection.decision_margin = static_cast<float>(sighting.margin);
    for (std::size_t i = 0; i < 4; ++i) {
      const Vec2 corner =
          moved_between(camera, rectified, sighting.corners_px[i]).value_or(sighting.corners_px[i]);
      detection.corners[2 * i] = corner.x;
      detection.corners[2 * i + 1] = corner.y;
      detection.centre[0] += 0.25 * corner.x;
      detection.centre[1] += 0.25 * corner.y;
    }
    message.detections.push_back(std::move(detection));
  }
  return message;
}

}  // namespace outrider
