#include "mcap/read/mcap_channels.hpp"

#include <fmt/format.h>

#include <utility>

#include "formats.hpp"
#include "mcap/read/mcap_decode.hpp"
#include "outrider/log/encoding/channel_decoder.hpp"

namespace outrider::mcap {
namespace {

/// Adds a record unless an equal one is there; complains of a different one.
template <class Record>
std::string add_once(std::map<std::uint16_t, Record>& all, std::optional<Record> record,
                     std::string_view kind) {
  if (!record) return fmt::format("a {} record is shorter than its fields", kind);
  const std::uint16_t id = record->id;
  const auto [place, added] = all.try_emplace(id, *record);
  if (added || place->second == *record) return {};
  return fmt::format("the {} {} is defined a second time, and differently", kind, id);
}

template <class Record>
std::string find_equal(const std::map<std::uint16_t, Record>& all, const std::optional<Record>& record,
                       std::string_view kind) {
  if (!record) return fmt::format("a {} record is shorter than its fields", kind);
  const auto found = all.find(record->id);
  if (found != all.end() && found->second == *record) return {};
  return fmt::format("the {} {} is not defined as in the summary", kind, record->id);
}

}  // namespace

std::string ChannelTable::add(Op op, std::string_view content) {
  if (op == Op::channel) return add_once(channels_, decode_channel(content), "channel");
  auto schema = decode_schema(content);
  if (schema && schema->id == 0) return "a schema has the id 0, which stands for no schema";
  return add_once(schemas_, std::move(schema), "schema");
}

std::string ChannelTable::find(Op op, std::string_view content) const {
  if (op == Op::channel) return find_equal(channels_, decode_channel(content), "channel");
  return find_equal(schemas_, decode_schema(content), "schema");
}

std::string ChannelTable::check() const {
  std::size_t bytes = 0;
  for (const auto& [id, channel] : channels_) {
    const auto schema = schemas_.find(channel.schema_id);
    bytes += channel.topic.size() + (schema == schemas_.end() ? 0 : schema->second.data.size());
    if (bytes > most_channel_bytes)
      return fmt::format("its channels have schemas of more than {} bytes", most_channel_bytes);
    if (channel.schema_id == 0 || schema != schemas_.end()) continue;
    return fmt::format("channel {} ({}) has the schema {}, which is not defined", id, channel.topic,
                       channel.schema_id);
  }
  return {};
}

Channel ChannelTable::channel(const ChannelRecord& record) const {
  Channel channel;
  channel.topic = record.topic;
  channel.encoding = record.encoding;
  channel.metadata = record.metadata;
  if (const auto schema = schemas_.find(record.schema_id); schema != schemas_.end()) {
    const std::string& name = schema->second.name;
    channel.type = schema->second.encoding == "ros1msg" ? ros2_type_name(name) : name;
    channel.schema_encoding = schema->second.encoding;
    channel.schema = schema->second.data;
  }
  return channel;
}

std::vector<Channel> ChannelTable::channels() const {
  std::vector<Channel> all;
  for (const auto& [id, record] : channels_) all.push_back(channel(record));
  return all;
}

}  // namespace outrider::mcap
