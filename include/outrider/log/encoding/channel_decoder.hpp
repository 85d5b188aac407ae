// ChannelDecoder: the messages of a channel as structs, whatever their encoding.
//
//   auto scans = ChannelDecoder<sensor_msgs::LaserScan>::of(reader.channels()[index]);
//   if (!scans) return pass_on(scans);             // another type, or a schema that lies
//   if (auto ok = scans->decode(message.data, scan); !ok) return ok;
//
// The schema of the channel must have the fields of the type, and no others. A channel without a schema is
// believed by the name of its type. Thread rule: safe to call concurrently.
#pragma once

#include <string>
#include <string_view>
#include <utility>

#include "outrider/log/encoding/codecs.hpp"
#include "outrider/log/log_reader.hpp"

namespace outrider {

/// Returns the ROS 2 name of a type: "sensor_msgs/LaserScan" of ROS 1 is "sensor_msgs/msg/LaserScan".
std::string ros2_type_name(std::string_view type);

/// Decodes messages of a type that is known at run time.
class AnyChannelDecoder {
 public:
  /// Fault: bad_input with the topic: another type, an unknown encoding, or a schema with other fields.
  static Outcome<AnyChannelDecoder> of(const Channel& channel, const MessageType& type);

  /// Decodes a message into the struct at `message`, whose memory is used again. Fault: bad_input with the
  /// topic.
  Status decode(std::string_view data, void* message) const;

 private:
  AnyChannelDecoder(std::string topic, MessageEncoding encoding, const MessageType& type)
      : topic_(std::move(topic)), encoding_(encoding), type_(&type) {}

  std::string topic_;
  MessageEncoding encoding_;
  const MessageType* type_;
};

template <class Message>
class ChannelDecoder {
 public:
  static Outcome<ChannelDecoder> of(const Channel& channel) {
    auto any = AnyChannelDecoder::of(channel, message_type<Message>());
    if (!any) return pass_on(any);
    return ChannelDecoder(std::move(*any));
  }

  Status decode(std::string_view data, Message& message) const { return any_.decode(data, &message); }

 private:
  explicit ChannelDecoder(AnyChannelDecoder any) : any_(std::move(any)) {}
  AnyChannelDecoder any_;
};

}  // namespace outrider
