#include "outrider/io/camera/image_topics.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "outrider/core/text.hpp"
#include "outrider/io/camera/photo.hpp"
#include "outrider/io/log/log_file.hpp"
#include "outrider/log/find_topic.hpp"
#include "outrider/log/log.hpp"
#include "outrider/log/messages/conversions.hpp"

namespace outrider {
namespace {

using sensor_msgs::CameraInfo;
using sensor_msgs::CompressedImage;
using sensor_msgs::Image;

Outcome<TimedImage> read(const ChannelDecoder<Image>& decoder, const LogMessage& encoded) {
  Image message;
  if (auto ok = decoder.decode(encoded.data, message); !ok) return pass_on(ok);
  auto image = grey_image(message);
  if (!image) return pass_on(image);
  return TimedImage{seconds(nanoseconds_of(message.header, encoded.time_ns)), std::move(*image)};
}

Outcome<TimedImage> read(const ChannelDecoder<CompressedImage>& decoder, const LogMessage& encoded) {
  CompressedImage message;
  if (auto ok = decoder.decode(encoded.data, message); !ok) return pass_on(ok);
  auto image =
      photo_from_bytes({reinterpret_cast<const char*>(message.data.data()), message.data.size()}, "");
  if (!image) return pass_on(image);
  return TimedImage{seconds(nanoseconds_of(message.header, encoded.time_ns)), std::move(*image)};
}

/// Adds the decoder of a channel.
template <class Message, class Decoders>
Status add_decoder(const std::vector<Channel>& channels, std::size_t index, Decoders& decoders) {
  auto decoder = ChannelDecoder<Message>::of(channels[index]);
  if (!decoder) return pass_on(decoder);
  decoders.emplace(index, std::move(*decoder));
  return {};
}

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

Outcome<ImageTopics> ImageTopics::open(const std::string& path, const ImageTopicsOptions& options) {
  auto contents = open_log_file(path);
  if (!contents) return pass_on(contents);
  const std::vector<Channel> channels = (*contents)->channels();
  contents->reset();
  const auto found =
      find_topic(channels, {{Image::type, CompressedImage::type}, options.image, "--image-topic"});
  if (!found) return pass_on(found);
  ImageTopics images;
  images.topic_ = channels[found->front()].topic;
  for (const std::size_t index : *found) {
    const bool packed = ros2_type_name(channels[index].type) == CompressedImage::type;
    auto ok = (packed ? add_decoder<CompressedImage, decltype(decoders_)>
                      : add_decoder<Image, decltype(decoders_)>)(channels, index, images.decoders_);
    if (!ok) return pass_on(ok);
  }
  const auto info = find_info(channels, images.topic_, options);
  if (!info) return pass_on(info);
  if (!info->empty()) {
    auto camera = read_camera(path, *info);
    if (!camera) return pass_on(camera);
    images.camera_ = *camera;
  }
  auto log = open_log_file(path, {.topics = {images.topic_}});
  if (!log) return pass_on(log);
  images.log_ = std::move(*log);
  return images;
}

Outcome<std::optional<TimedImage>> ImageTopics::next() {
  auto message = log_->next();
  if (!message) return pass_on(message);
  if (!*message) return std::optional<TimedImage>{};
  auto image = std::visit([&](const auto& decoder) { return read(decoder, **message); },
                          decoders_.at((*message)->channel));
  if (!image) return bad_input(std::move(image.error().sentence), printable(topic_));
  return std::optional(std::move(*image));
}

}  // namespace outrider
