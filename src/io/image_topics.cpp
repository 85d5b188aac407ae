#include "outrider/io/image_topics.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <variant>

#include "outrider/core/text.hpp"
#include "outrider/io/log_file.hpp"
#include "outrider/io/photo.hpp"
#include "outrider/log/channel_decoder.hpp"
#include "outrider/log/conversions.hpp"
#include "outrider/log/find_topic.hpp"
#include "outrider/log/log.hpp"

namespace outrider {
namespace {

using sensor_msgs::CameraInfo;
using sensor_msgs::CompressedImage;
using sensor_msgs::Image;
using ImageDecoder = std::variant<ChannelDecoder<Image>, ChannelDecoder<CompressedImage>>;

double time_of(const std_msgs::Header& header, const LogMessage& message) {
  const bool stamped = header.stamp.sec != 0 || header.stamp.nanosec != 0;
  if (!stamped) return seconds(message.time_ns);
  return static_cast<double>(header.stamp.sec) + 1e-9 * static_cast<double>(header.stamp.nanosec);
}

Outcome<ImageDecoder> decoder_of(const Channel& channel) {
  if (ros2_type_name(channel.type) == CompressedImage::type) {
    auto decoder = ChannelDecoder<CompressedImage>::of(channel);
    if (!decoder) return pass_on(decoder);
    return ImageDecoder(std::move(*decoder));
  }
  auto decoder = ChannelDecoder<Image>::of(channel);
  if (!decoder) return pass_on(decoder);
  return ImageDecoder(std::move(*decoder));
}

class LoggedImages final : public ImageTopics {
 public:
  LoggedImages(std::unique_ptr<LogReader> log, std::map<std::size_t, ImageDecoder> decoders,
               std::string topic, std::optional<Camera> camera)
      : log_(std::move(log)), decoders_(std::move(decoders)), topic_(std::move(topic)), camera_(camera) {}

  [[nodiscard]] const std::optional<Camera>& camera() const override { return camera_; }
  [[nodiscard]] std::string cut_short() const override { return log_->cut_short(); }

  Outcome<std::optional<TimedImage>> next() override {
    auto message = log_->next();
    if (!message) return pass_on(message);
    if (!*message) return std::optional<TimedImage>{};
    auto image = std::visit([&](const auto& decoder) { return read(decoder, **message); },
                            decoders_.at((*message)->channel));
    if (!image) return bad_input(std::move(image.error().sentence), printable(topic_));
    return std::optional(std::move(*image));
  }

 private:
  Outcome<TimedImage> read(const ChannelDecoder<Image>& decoder, const LogMessage& message) {
    if (auto ok = decoder.decode(message.data, plain_); !ok) return pass_on(ok);
    auto image = grey_image(plain_);
    if (!image) return pass_on(image);
    return TimedImage{time_of(plain_.header, message), std::move(*image)};
  }

  Outcome<TimedImage> read(const ChannelDecoder<CompressedImage>& decoder, const LogMessage& message) {
    if (auto ok = decoder.decode(message.data, packed_); !ok) return pass_on(ok);
    const std::string_view bytes(reinterpret_cast<const char*>(packed_.data.data()), packed_.data.size());
    auto image = photo_from_bytes(bytes, topic_);
    if (!image) return pass_on(image);
    return TimedImage{time_of(packed_.header, message), std::move(*image)};
  }

  std::unique_ptr<LogReader> log_;
  std::map<std::size_t, ImageDecoder> decoders_;
  std::string topic_;
  std::optional<Camera> camera_;
  Image plain_;
  CompressedImage packed_;
};

/// Returns "/camera/camera_info" for "/camera/image_raw" and "/camera/image_raw/compressed".
std::string info_beside(std::string topic) {
  if (topic.ends_with("/compressed")) topic.resize(topic.size() - 11);
  return topic.substr(0, topic.rfind('/') + 1) + "camera_info";
}

/// Finds the camera of the images: by its name, beside them, or the only one.
Outcome<std::string> find_info(const std::vector<Channel>& channels, const std::string& images,
                               const ImageTopicsOptions& options) {
  const auto is_info = [&](const Channel& channel) {
    return ros2_type_name(channel.type) == CameraInfo::type;
  };
  const auto beside = std::ranges::find_if(channels, [&](const Channel& channel) {
    return is_info(channel) && channel.topic == info_beside(images);
  });
  if (options.info.empty() && beside != channels.end()) return beside->topic;
  if (options.info.empty() && std::ranges::none_of(channels, is_info)) return std::string();
  const auto found = find_topic(channels, {{CameraInfo::type}, options.info, "--info-topic"});
  if (!found) return pass_on(found);
  return channels[found->front()].topic;
}

Outcome<std::optional<Camera>> read_camera(const std::string& path, const std::string& topic) {
  auto log = open_log_file(path, {.topics = {topic}});
  if (!log) return pass_on(log);
  auto message = (*log)->next();
  if (!message) return pass_on(message);
  if (!*message) return std::optional<Camera>{};
  const auto decoder = ChannelDecoder<CameraInfo>::of((*log)->channels()[(*message)->channel]);
  if (!decoder) return pass_on(decoder);
  CameraInfo info;
  if (auto ok = decoder->decode((*message)->data, info); !ok) return pass_on(ok);
  auto camera = camera_of(info);
  if (!camera) return bad_input(std::move(camera.error().sentence), printable(topic));
  return std::optional(*camera);
}

}  // namespace

Outcome<std::unique_ptr<ImageTopics>> open_image_topics(const std::string& path,
                                                        const ImageTopicsOptions& options) {
  auto contents = open_log_file(path);
  if (!contents) return pass_on(contents);
  const std::vector<Channel> channels = (*contents)->channels();
  contents->reset();
  const auto found =
      find_topic(channels, {{Image::type, CompressedImage::type}, options.image, "--image-topic"});
  if (!found) return pass_on(found);
  const std::string topic = channels[found->front()].topic;
  std::map<std::size_t, ImageDecoder> decoders;
  for (const std::size_t index : *found) {
    auto decoder = decoder_of(channels[index]);
    if (!decoder) return pass_on(decoder);
    decoders.emplace(index, std::move(*decoder));
  }
  const auto info = find_info(channels, topic, options);
  if (!info) return pass_on(info);
  std::optional<Camera> camera;
  if (!info->empty()) {
    auto read = read_camera(path, *info);
    if (!read) return pass_on(read);
    camera = *read;
  }
  auto log = open_log_file(path, {.topics = {topic}});
  if (!log) return pass_on(log);
  return std::make_unique<LoggedImages>(std::move(*log), std::move(decoders), topic, camera);
}

}  // namespace outrider
