// The encodings of messages: ROS 2 CDR, ROS 1 bytes, JSON, and the text of a schema. All are made from
// MessageType.
//
// CDR is XCDR1, little-endian, as ROS 2 writes it (OMG DDS-XTypes 1.3, section 7.4.1). The bytes of ROS 1 are
// those of its message serialisation. JSON has the fields under their names
// (src/log/encoding/json_codec.hpp). All take O(bytes); a sequence in foreign bytes is believed only as far
// as bytes are there to fill it. Faults: bad_input with a sentence and without a place, which the caller
// knows.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "outrider/core/outcome.hpp"
#include "outrider/log/encoding/message_type.hpp"
#include "outrider/log/log_reader.hpp"

namespace outrider {

enum class MessageEncoding { cdr, ros1, json };

/// Returns the encoding that a channel names "cdr", "ros1" or "json"; nothing for another name.
std::optional<MessageEncoding> encoding_named(std::string_view name);

/// Encodes the message of that type at `message`.
std::string encode(MessageEncoding encoding, const MessageType& type, const void* message);
/// Decodes a message into the one at `message`. After a fault its content is unspecified.
Status decode(MessageEncoding encoding, const MessageType& type, std::string_view bytes, void* message);

/// Returns the definition of the type and of all types that it uses, as rosbag2 stores it ("ros2msg"). Units
/// are comments.
std::string schema_text(const MessageType& type);

/// Encodes a message.
template <class Message>
std::string encode(MessageEncoding encoding, const Message& message) {
  return encode(encoding, message_type<Message>(), &message);
}

/// Decodes a message.
template <class Message>
Outcome<Message> decode(MessageEncoding encoding, std::string_view bytes) {
  Message message;
  if (auto done = decode(encoding, message_type<Message>(), bytes, &message); !done) return pass_on(done);
  return message;
}

/// Returns a channel for CDR messages of a type.
template <class Message>
Channel channel_of(std::string topic) {
  const MessageType& type = message_type<Message>();
  return {std::move(topic), std::string(type.name), "cdr", "ros2msg", schema_text(type)};
}

}  // namespace outrider
