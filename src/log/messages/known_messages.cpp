#include "outrider/log/messages/known_messages.hpp"

#include <algorithm>
#include <array>

#include "messages/run_messages.hpp"

namespace outrider {
namespace {

using SensorMessages = MessageList<sensor_msgs::Image, sensor_msgs::CompressedImage>;

template <class... Run, class... Sensor>
const auto& types_of(MessageList<Run...>, MessageList<Sensor...>) {
  static const std::array types{&message_type<Run>()..., &message_type<Sensor>()...};
  return types;
}

}  // namespace

const MessageType* find_message_type(std::string_view name) {
  const auto& types = types_of(RunMessages(), SensorMessages());
  const auto* found = std::ranges::find(types, name, &MessageType::name);
  return found == types.end() ? nullptr : *found;
}

Outcome<std::optional<AnyMessage>> AnyMessage::of(const Channel& channel) {
  const MessageType* type = find_message_type(ros2_type_name(channel.type));
  if (type == nullptr) return std::optional<AnyMessage>();
  auto decoder = AnyChannelDecoder::of(channel, *type);
  if (!decoder) return pass_on(decoder);
  return std::optional(AnyMessage(*type, std::move(*decoder)));
}

}  // namespace outrider
