// TagSight: the tags in sight of a camera on the other side of topics.
//
//   camera/camera_info  sensor_msgs/CameraInfo: the lens
//   camera/image_raw    sensor_msgs/Image: tags are detected in it (estimate/tag_detector.hpp)
//   detections          apriltag_msgs/AprilTagDetectionArray: tags that somebody else has detected in the
//                       rectified image, as apriltag_ros does
//
// Either of the two is enough. Sizes and family come from the map of tags. Poses are those of
// estimate/planar_pnp.hpp, in the camera as its lens is: corners of the rectified image are put back there.
#pragma once

#include <optional>

#include "outrider/estimate/camera.hpp"
#include "outrider/estimate/tag_detector.hpp"
#include "outrider/log/messages/ros_sensor_messages.hpp"
#include "outrider/nodes/messages/checked.hpp"
#include "outrider/nodes/messages/tag_messages.hpp"
#include "outrider/robot/observation.hpp"

namespace outrider {

class TagSight {
 public:
  explicit TagSight(TagMap tags);

  /// Faults: for a lens that is none, and for images and detections that do not fit it.
  Status take(const sensor_msgs::CameraInfo& info);
  Status take(const sensor_msgs::Image& image);
  Status take(const apriltag_msgs::AprilTagDetectionArray& detections);

  [[nodiscard]] const std::optional<Camera>& camera() const { return camera_; }
  /// Returns the newest image; its time is that of its stamp.
  [[nodiscard]] const std::optional<TagImage>& newest() const { return newest_; }

 private:
  void see(double taken_s, std::vector<TagSighting> sightings);

  TagMap tags_;
  TagDetector detector_;
  std::optional<Camera> camera_;
  Camera rectified_;  ///< the same without its lens
  NewestStamp images_, detections_;
  std::optional<TagImage> newest_;
};

/// Returns the camera without its lens, as the matrix P of a camera_info has it.
Camera rectified_camera(const sensor_msgs::CameraInfo& info, const Camera& camera);

/// Returns the message of tags that were detected in an image of the camera. The inverse of
/// TagSight::take().
apriltag_msgs::AprilTagDetectionArray detections_of(const TagImage& image, const Camera& camera,
                                                    const std_msgs::Header& header);

}  // namespace outrider
