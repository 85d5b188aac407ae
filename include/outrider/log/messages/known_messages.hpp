// Messages of types that are known at run time: those of the messages that runs leave, and those of sensors.
#pragma once

#include <memory>
#include <optional>
#include <string_view>

#include "outrider/log/encoding/channel_decoder.hpp"

namespace outrider {

/// Returns a type by its ROS 2 name, such as "nav_msgs/msg/Odometry", or nothing if it is not known.
const MessageType* find_message_type(std::string_view name);

/// A message whose type is chosen at run time. Thread rule: one thread.
class AnyMessage {
 public:
  /// Returns a message for a channel; nothing if its type is not known. Fault: bad_input with the topic, as
  /// AnyChannelDecoder has it.
  static Outcome<std::optional<AnyMessage>> of(const Channel& channel);

  /// Takes the content of an encoded message of the channel. Fault: bad_input with the topic.
  Status decode(std::string_view data) { return decoder_.decode(data, content_.get()); }

  [[nodiscard]] const MessageType& type() const { return *type_; }
  [[nodiscard]] const void* content() const { return content_.get(); }

 private:
  AnyMessage(const MessageType& type, AnyChannelDecoder decoder)
      : type_(&type), decoder_(std::move(decoder)), content_(type.make()) {}

  const MessageType* type_;
  AnyChannelDecoder decoder_;
  std::shared_ptr<void> content_;
};

}  // namespace outrider
