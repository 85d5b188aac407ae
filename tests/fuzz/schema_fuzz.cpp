// Schemas: any text is a definition or a refusal with a sentence, and messages of ROS 1 are converted by it
// or refused. An input is a schema, a byte 0, and a message.
#include <cstddef>
#include <cstdint>

#include "encoding/ros1_to_cdr.hpp"
#include "fuzz_entry.hpp"
#include "outrider/log/encoding/channel_decoder.hpp"
#include "outrider/log/messages/ros_sensor_messages.hpp"
#include "read_fuzzed_log.hpp"

extern "C" int FUZZ_ENTRY(schema)(const std::uint8_t* data, std::size_t size) {
  const std::string_view input(reinterpret_cast<const char*>(data), size);
  const std::string_view schema = input.substr(0, input.find('\0'));
  const std::string_view message = input.substr(std::min(schema.size() + 1, input.size()));
  outrider::Channel channel{"/scan", "sensor_msgs/msg/LaserScan", "ros1", "ros1msg", std::string(schema)};
  for (const char* language : {"ros1msg", "ros2msg", "jsonschema"}) {
    channel.schema_encoding = language;
    const auto decoder = outrider::ChannelDecoder<outrider::sensor_msgs::LaserScan>::of(channel);
    require(decoder || !decoder.error().sentence.empty());
  }
  channel.schema_encoding = "ros1msg";
  const auto converter = outrider::Ros1ToCdr::of(channel);
  if (!converter) {
    require(!converter.error().sentence.empty());
    return 0;
  }
  const auto cdr = converter->convert(message);
  require(cdr ? cdr->size() <= 100 * message.size() + 1000000 : !cdr.error().sentence.empty());
  return 0;
}
