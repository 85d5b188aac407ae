#include "mcap/read/mcap_decode.hpp"

#include <string>
#include <utility>

namespace outrider::mcap {
namespace {

using Texts = std::map<std::string, std::string>;
using Numbers = std::map<std::uint16_t, std::uint64_t>;

/// Reads a map after its length in bytes. Nothing if it is damaged or has a key twice.
std::optional<Texts> read_texts(ByteReader& reader) {
  ByteReader pairs(reader.text());
  Texts map;
  while (pairs.ok() && !pairs.at_end()) {
    std::string key(pairs.text());
    if (!map.emplace(std::move(key), pairs.text()).second) return std::nullopt;
  }
  return pairs.ok() && reader.ok() ? std::optional(std::move(map)) : std::nullopt;
}

std::optional<Numbers> read_numbers(ByteReader& reader) {
  ByteReader pairs(reader.text());
  Numbers map;
  while (pairs.ok() && !pairs.at_end()) {
    const auto key = pairs.number<std::uint16_t>();
    if (!map.emplace(key, pairs.number<std::uint64_t>()).second) return std::nullopt;
  }
  return pairs.ok() && reader.ok() ? std::optional(std::move(map)) : std::nullopt;
}

template <class Record>
std::optional<Record> whole(const ByteReader& reader, Record record) {
  return reader.ok() ? std::optional<Record>(std::move(record)) : std::nullopt;
}

}  // namespace

std::optional<SchemaRecord> decode_schema(std::string_view content) {
  ByteReader reader(content);
  SchemaRecord schema;
  schema.id = reader.number<std::uint16_t>();
  schema.name = reader.text();
  schema.encoding = reader.text();
  schema.data = reader.text();
  return whole(reader, std::move(schema));
}

std::optional<ChannelRecord> decode_channel(std::string_view content) {
  ByteReader reader(content);
  ChannelRecord channel;
  channel.id = reader.number<std::uint16_t>();
  channel.schema_id = reader.number<std::uint16_t>();
  channel.topic = reader.text();
  channel.encoding = reader.text();
  auto metadata = read_texts(reader);
  if (!metadata) return std::nullopt;
  channel.metadata = std::move(*metadata);
  return channel;
}

std::optional<MessageRecord> decode_message(std::string_view content) {
  ByteReader reader(content);
  MessageRecord message;
  message.channel_id = reader.number<std::uint16_t>();
  message.sequence = reader.number<std::uint32_t>();
  message.log_time = reader.number<std::uint64_t>();
  message.publish_time = reader.number<std::uint64_t>();
  message.data = reader.rest();
  return whole(reader, message);
}

std::optional<ChunkRecord> decode_chunk(std::string_view content) {
  ByteReader reader(content);
  ChunkRecord chunk;
  chunk.start_time = reader.number<std::uint64_t>();
  chunk.end_time = reader.number<std::uint64_t>();
  chunk.uncompressed_size = reader.number<std::uint64_t>();
  chunk.uncompressed_crc = reader.number<std::uint32_t>();
  chunk.compression = reader.text();
  chunk.records = reader.take(reader.number<std::uint64_t>());
  return whole(reader, chunk);
}

std::optional<ChunkIndexRecord> decode_chunk_index(std::string_view content) {
  ByteReader reader(content);
  ChunkIndexRecord index;
  index.start_time = reader.number<std::uint64_t>();
  index.end_time = reader.number<std::uint64_t>();
  index.chunk_offset = reader.number<std::uint64_t>();
  index.chunk_length = reader.number<std::uint64_t>();
  auto offsets = read_numbers(reader);
  if (!offsets) return std::nullopt;
  index.message_index_offsets = std::move(*offsets);
  index.message_index_length = reader.number<std::uint64_t>();
  index.compression = reader.text();
  index.compressed_size = reader.number<std::uint64_t>();
  index.uncompressed_size = reader.number<std::uint64_t>();
  return whole(reader, std::move(index));
}

std::optional<AttachmentRecord> decode_attachment(std::string_view content) {
  ByteReader reader(content);
  AttachmentRecord attachment;
  attachment.log_time = reader.number<std::uint64_t>();
  attachment.create_time = reader.number<std::uint64_t>();
  attachment.name = reader.text();
  attachment.media_type = reader.text();
  attachment.data = reader.take(reader.number<std::uint64_t>());
  attachment.checked_fields = content.substr(0, reader.position());
  attachment.crc = reader.number<std::uint32_t>();
  return whole(reader, attachment);
}

std::optional<FooterRecord> decode_footer(std::string_view content) {
  ByteReader reader(content);
  FooterRecord footer;
  footer.summary_start = reader.number<std::uint64_t>();
  footer.summary_offset_start = reader.number<std::uint64_t>();
  footer.summary_crc = reader.number<std::uint32_t>();
  return whole(reader, footer);
}

std::optional<std::uint32_t> decode_data_end(std::string_view content) {
  ByteReader reader(content);
  const auto crc = reader.number<std::uint32_t>();
  return whole(reader, crc);
}

std::optional<Records::Record> Records::next() {
  if (reader_.at_end()) return std::nullopt;
  Record record;
  record.offset = reader_.position();
  record.op = Op{reader_.number<std::uint8_t>()};
  record.content = reader_.take(reader_.number<std::uint64_t>());
  return whole(reader_, record);
}

}  // namespace outrider::mcap
