#include "outrider/log/encoding/channel_decoder.hpp"

#include <fmt/format.h>

#include "encoding/schema_check.hpp"
#include "outrider/core/text.hpp"

namespace outrider {

std::string ros2_type_name(std::string_view type) {
  if (type == "tf/tfMessage")
    return "tf2_msgs/msg/TFMessage";  // its name before ROS 1 Hydro; the fields are the same
  const std::size_t slash = type.find('/');
  if (slash == std::string_view::npos || type.find('/', slash + 1) != std::string_view::npos) {
    return std::string(type);
  }
  return fmt::format("{}/msg/{}", type.substr(0, slash), type.substr(slash + 1));
}

Outcome<AnyChannelDecoder> AnyChannelDecoder::of(const Channel& channel, const MessageType& type) {
  if (ros2_type_name(channel.type) != type.name) {
    return bad_input(
        fmt::format("its messages are {}, and not {}; name another topic", excerpt(channel.type), type.name),
        excerpt(channel.topic));
  }
  const auto encoding = encoding_named(channel.encoding);
  if (!encoding) {
    return bad_input(fmt::format("its messages are encoded as '{}'; only cdr, ros1 and json are read",
                                 excerpt(channel.encoding)),
                     excerpt(channel.topic));
  }
  if (auto agrees = check_schema(channel, type); !agrees) {
    return bad_input(std::move(agrees.error().sentence), excerpt(channel.topic));
  }
  return AnyChannelDecoder(channel.topic, *encoding, type);
}

Status AnyChannelDecoder::decode(std::string_view data, void* message) const {
  auto done = outrider::decode(encoding_, *type_, data, message);
  if (!done) return bad_input(std::move(done.error().sentence), printable(topic_));
  return done;
}

}  // namespace outrider
