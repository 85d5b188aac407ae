#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "map/image.hpp"
#include "outrider/core/text.hpp"
#include "outrider/io/camera/image_topics.hpp"

namespace outrider {
namespace {

/// The memory layout of the pixels of an encoding.
struct PixelLayout {
  std::string_view name;
  std::size_t bytes = 1;  ///< of a pixel
  std::size_t red = 0;    ///< offsets of the colours; equal in grey images
  std::size_t green = 0;
  std::size_t blue = 0;
};

constexpr std::array<PixelLayout, 14> layouts = {{{"mono8", 1, 0, 0, 0},
                                                  {"8UC1", 1, 0, 0, 0},
                                                  {"mono16", 2, 0, 0, 0},
                                                  {"16UC1", 2, 0, 0, 0},
                                                  {"rgb8", 3, 0, 1, 2},
                                                  {"bgr8", 3, 2, 1, 0},
                                                  {"8UC3", 3, 2, 1, 0},
                                                  {"rgba8", 4, 0, 1, 2},
                                                  {"bgra8", 4, 2, 1, 0},
                                                  {"8UC4", 4, 2, 1, 0},
                                                  {"uyvy", 2, 1, 1, 1},
                                                  {"yuv422", 2, 1, 1, 1},
                                                  {"yuyv", 2, 0, 0, 0},
                                                  {"yuv422_yuy2", 2, 0, 0, 0}}};

Status check_size(const sensor_msgs::Image& message, std::size_t pixel_bytes) {
  if (auto ok = check_image_size(message.width, message.height, ""); !ok) return ok;
  const std::uint64_t row = std::uint64_t{message.width} * pixel_bytes;
  const std::uint64_t bytes = std::uint64_t{message.step} * message.height;
  if (message.step < row || message.data.size() != bytes) {
    return bad_input(fmt::format("an image of {} x {} pixels with {} bytes in {}, where rows take {} or more",
                                 message.width, message.height, message.data.size(), message.encoding, row));
  }
  return {};
}

/// Rounds the luminance of ITU-R BT.601.
std::uint8_t luminance(int red, int green, int blue) {
  return static_cast<std::uint8_t>((299 * red + 587 * green + 114 * blue + 500) / 1000);
}

}  // namespace

Outcome<CameraImage> grey_image(const sensor_msgs::Image& message) {
  const auto found = std::ranges::find(layouts, message.encoding, &PixelLayout::name);
  if (found == layouts.end()) {
    return bad_input(
        fmt::format("images in '{}' are not read; record them in mono8, rgb8, bgr8 or compressed",
                    excerpt(message.encoding)));
  }
  PixelLayout layout = *found;
  const bool sixteen_bits = layout.name == "mono16" || layout.name == "16UC1";
  if (sixteen_bits && message.is_bigendian == 0)
    layout.red = layout.green = layout.blue = 1;  // the upper byte
  if (auto ok = check_size(message, layout.bytes); !ok) return pass_on(ok);
  const auto width = static_cast<std::size_t>(message.width),
             height = static_cast<std::size_t>(message.height);
  CameraImage image{static_cast<int>(width), static_cast<int>(height),
                    std::vector<std::uint8_t>(width * height)};
  for (std::size_t y = 0; y < height; ++y) {
    const std::uint8_t* pixel = message.data.data() + y * message.step;
    for (std::size_t x = 0; x < width; ++x, pixel += layout.bytes) {
      image.values[y * width + x] = luminance(pixel[layout.red], pixel[layout.green], pixel[layout.blue]);
    }
  }
  return image;
}

Outcome<Camera> camera_of(const sensor_msgs::CameraInfo& message) {
  const auto& k = message.k;
  const bool known_lens = message.distortion_model.empty() || message.distortion_model == "plumb_bob";
  const bool no_lens = std::ranges::all_of(message.d, [](double value) { return value == 0.0; });
  if ((!known_lens && !no_lens) || (message.d.size() > 5 && !no_lens)) {
    return bad_input(
        fmt::format("the lens model '{}' with {} numbers is not known; expected plumb_bob with five",
                    excerpt(message.distortion_model), message.d.size()));
  }
  if (k[1] != 0.0 || k[3] != 0.0 || k[6] != 0.0 || k[7] != 0.0 || k[8] != 1.0) {
    return bad_input("the camera matrix is that of no pinhole; its rows are fx 0 cx, 0 fy cy, 0 0 1");
  }
  if (auto ok = check_image_size(message.width, message.height, ""); !ok) return pass_on(ok);
  Camera camera;
  camera.width_px = static_cast<int>(message.width);
  camera.height_px = static_cast<int>(message.height);
  camera.fx = k[0];
  camera.cx = k[2];
  camera.fy = k[4];
  camera.cy = k[5];
  std::copy_n(message.d.begin(), std::min<std::size_t>(message.d.size(), 5), camera.distortion.begin());
  if (auto good = check_camera(camera); !good) return pass_on(good);
  return camera;
}

}  // namespace outrider
