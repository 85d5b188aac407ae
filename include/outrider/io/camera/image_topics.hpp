// Images of a camera from the log of a robot: MCAP, ROS 1 bag or ROS 2 db3.
//
// Images are sensor_msgs/Image (mono8, mono16, rgb8, bgr8, rgba8, bgra8, the OpenCV names 8UC1, 16UC1, 8UC3
// and 8UC4, and YUV 4:2:2 as uyvy and yuyv) or sensor_msgs/CompressedImage (JPEG or PNG). They become grey:
// the luminance of ITU-R BT.601. The camera is that of the first sensor_msgs/CameraInfo message. Bounds:
// sides up to 100,000 and 100 million pixels.
//
// Faults: bad_input with the topic, or with the option that names one. Memory: some chunks of the log and one
// image. Thread rule: one thread.
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <variant>

#include "outrider/core/outcome.hpp"
#include "outrider/estimate/camera.hpp"
#include "outrider/estimate/camera_image.hpp"
#include "outrider/log/encoding/channel_decoder.hpp"
#include "outrider/log/log_reader.hpp"
#include "outrider/log/messages/ros_sensor_messages.hpp"

namespace outrider {

struct ImageTopicsOptions {
  std::string image = {};  ///< topic; empty: the only one with images
  std::string info =
      {};  ///< topic of the camera; empty: camera_info beside the images, or the only one of its type
};

/// An image and the time of the stamp in its header, or at which it was recorded if that is 0.
struct TimedImage {
  double time_s = 0.0;
  CameraImage image;
};

class ImageTopics {
 public:
  /// Opens a log. The camera is read, too.
  static Outcome<ImageTopics> open(const std::string& path, const ImageTopicsOptions& options);

  /// Returns the camera; nothing if the log does not describe it.
  [[nodiscard]] const std::optional<Camera>& camera() const { return camera_; }
  /// Returns the next image; nothing at the end.
  Outcome<std::optional<TimedImage>> next();
  /// Returns a sentence if the end of the log is missing, else an empty text.
  [[nodiscard]] std::string cut_short() const { return log_->cut_short(); }

 private:
  using Decoder =
      std::variant<ChannelDecoder<sensor_msgs::Image>, ChannelDecoder<sensor_msgs::CompressedImage>>;

  std::string topic_;
  std::map<std::size_t, Decoder> decoders_;  // by channel
  std::optional<Camera> camera_;
  std::unique_ptr<LogReader> log_;
};

/// Returns the image in grey. Fault: bad_input without a place, for another encoding, and sizes that do not
/// agree.
Outcome<CameraImage> grey_image(const sensor_msgs::Image& message);

/// Returns the camera of a message. Fault: bad_input without a place, for a lens model other than plumb_bob,
/// and for a matrix that is that of no pinhole.
Outcome<Camera> camera_of(const sensor_msgs::CameraInfo& message);

}  // namespace outrider
