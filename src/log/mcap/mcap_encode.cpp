#include "mcap/mcap_encode.hpp"

#include <zlib.h>

#include <concepts>

namespace outrider::mcap {
namespace {

template <std::unsigned_integral T>
void put(std::string& out, T value) {
  for (std::size_t i = 0; i < sizeof(T); ++i) {
    out.push_back(static_cast<char>((std::uint64_t{value} >> (8U * i)) & 0xFFU));
  }
}

void put_text(std::string& out, std::string_view text) {
  put(out, static_cast<std::uint32_t>(text.size()));
  out.append(text);
}

/// Writes the head of a record now and its length when the content has been appended.
class OpenRecord {
 public:
  OpenRecord(std::string& out, Op op) : out_(out), start_(out.size()) {
    out.push_back(static_cast<char>(op));
    put(out, std::uint64_t{0});
  }
  ~OpenRecord() {
    std::uint64_t length = out_.size() - start_ - head_bytes;
    for (std::size_t i = 1; i < head_bytes; ++i, length >>= 8U)
      out_[start_ + i] = static_cast<char>(length & 0xFFU);
  }
  OpenRecord(const OpenRecord&) = delete;
  OpenRecord& operator=(const OpenRecord&) = delete;

 private:
  std::string& out_;
  std::size_t start_;
};

void put_texts(std::string& out, const std::map<std::string, std::string>& map) {
  std::string pairs;
  for (const auto& [key, value] : map) {
    put_text(pairs, key);
    put_text(pairs, value);
  }
  put_text(out, pairs);
}

void put_numbers(std::string& out, const std::map<std::uint16_t, std::uint64_t>& map) {
  std::string pairs;
  for (const auto& [key, value] : map) {
    put(pairs, key);
    put(pairs, value);
  }
  put_text(out, pairs);
}

}  // namespace

std::uint32_t crc32_of(std::string_view bytes, std::uint32_t crc) {
  return static_cast<std::uint32_t>(
      ::crc32_z(crc, reinterpret_cast<const unsigned char*>(bytes.data()), bytes.size()));
}

void append_header(std::string& out, std::string_view profile, std::string_view library) {
  const OpenRecord record(out, Op::header);
  put_text(out, profile);
  put_text(out, library);
}

void append_schema(std::string& out, const SchemaRecord& schema) {
  const OpenRecord record(out, Op::schema);
  put(out, schema.id);
  put_text(out, schema.name);
  put_text(out, schema.encoding);
  put_text(out, schema.data);
}

void append_channel(std::string& out, const ChannelRecord& channel) {
  const OpenRecord record(out, Op::channel);
  put(out, channel.id);
  put(out, channel.schema_id);
  put_text(out, channel.topic);
  put_text(out, channel.encoding);
  put_texts(out, channel.metadata);
}

void append_message(std::string& out, const MessageRecord& message) {
  const OpenRecord record(out, Op::message);
  put(out, message.channel_id);
  put(out, message.sequence);
  put(out, message.log_time);
  put(out, message.publish_time);
  out.append(message.data);
}

void append_chunk(std::string& out, const ChunkRecord& chunk) {
  const OpenRecord record(out, Op::chunk);
  put(out, chunk.start_time);
  put(out, chunk.end_time);
  put(out, chunk.uncompressed_size);
  put(out, chunk.uncompressed_crc);
  put_text(out, chunk.compression);
  put(out, std::uint64_t{chunk.records.size()});
  out.append(chunk.records);
}

void append_message_index(std::string& out, std::uint16_t channel_id, const MessageIndex& index) {
  const OpenRecord record(out, Op::message_index);
  put(out, channel_id);
  put(out, static_cast<std::uint32_t>(16 * index.size()));
  for (const auto& [time, offset] : index) {
    put(out, time);
    put(out, offset);
  }
}

void append_chunk_index(std::string& out, const ChunkIndexRecord& index) {
  const OpenRecord record(out, Op::chunk_index);
  put(out, index.start_time);
  put(out, index.end_time);
  put(out, index.chunk_offset);
  put(out, index.chunk_length);
  put_numbers(out, index.message_index_offsets);
  put(out, index.message_index_length);
  put_text(out, index.compression);
  put(out, index.compressed_size);
  put(out, index.uncompressed_size);
}

void append_attachment(std::string& out, const AttachmentRecord& attachment) {
  const OpenRecord record(out, Op::attachment);
  const std::size_t start = out.size();
  put(out, attachment.log_time);
  put(out, attachment.create_time);
  put_text(out, attachment.name);
  put_text(out, attachment.media_type);
  put(out, std::uint64_t{attachment.data.size()});
  out.append(attachment.data);
  put(out, crc32_of(std::string_view(out).substr(start)));
}

void append_attachment_index(std::string& out, const AttachmentIndexRecord& index) {
  const OpenRecord record(out, Op::attachment_index);
  put(out, index.offset);
  put(out, index.length);
  put(out, index.log_time);
  put(out, index.create_time);
  put(out, index.data_size);
  put_text(out, index.name);
  put_text(out, index.media_type);
}

void append_metadata(std::string& out, std::string_view name,
                     const std::map<std::string, std::string>& metadata) {
  const OpenRecord record(out, Op::metadata);
  put_text(out, name);
  put_texts(out, metadata);
}

void append_metadata_index(std::string& out, const MetadataIndexRecord& index) {
  const OpenRecord record(out, Op::metadata_index);
  put(out, index.offset);
  put(out, index.length);
  put_text(out, index.name);
}

void append_statistics(std::string& out, const StatisticsRecord& statistics) {
  const OpenRecord record(out, Op::statistics);
  put(out, statistics.message_count);
  put(out, statistics.schema_count);
  put(out, statistics.channel_count);
  put(out, statistics.attachment_count);
  put(out, statistics.metadata_count);
  put(out, statistics.chunk_count);
  put(out, statistics.start_time);
  put(out, statistics.end_time);
  put_numbers(out, statistics.channel_message_counts);
}

void append_summary_offset(std::string& out, Op group, std::uint64_t start, std::uint64_t length) {
  const OpenRecord record(out, Op::summary_offset);
  put(out, static_cast<std::uint8_t>(group));
  put(out, start);
  put(out, length);
}

void append_data_end(std::string& out, std::uint32_t crc) {
  const OpenRecord record(out, Op::data_end);
  put(out, crc);
}

void append_footer(std::string& out, const FooterRecord& footer) {
  std::string bytes;
  bytes.push_back(static_cast<char>(Op::footer));
  put(bytes, footer_bytes - head_bytes);
  put(bytes, footer.summary_start);
  put(bytes, footer.summary_offset_start);
  put(bytes, crc32_of(bytes, footer.summary_crc));
  out.append(bytes);
}

}  // namespace outrider::mcap
