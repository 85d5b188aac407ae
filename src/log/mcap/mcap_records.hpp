// The records of an MCAP file, field by field, and the bounds that the reader and the writer share.
//
// Source: the MCAP format specification, https://mcap.dev/spec. A record is an opcode of one byte, the length
// of its content in eight, and the content; numbers are little-endian, times are nanoseconds.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <string_view>

namespace outrider::mcap {

enum class Op : std::uint8_t {
  header = 0x01,
  footer = 0x02,
  schema = 0x03,
  channel = 0x04,
  message = 0x05,
  chunk = 0x06,
  message_index = 0x07,
  chunk_index = 0x08,
  attachment = 0x09,
  attachment_index = 0x0A,
  statistics = 0x0B,
  metadata = 0x0C,
  metadata_index = 0x0D,
  summary_offset = 0x0E,
  data_end = 0x0F,
};

inline constexpr std::string_view magic{"\x89MCAP0\r\n", 8};
inline constexpr std::uint64_t head_bytes = 9;                     ///< of a record: opcode and length
inline constexpr std::uint64_t footer_bytes = head_bytes + 20;     ///< of the whole footer record
inline constexpr std::uint64_t tail_bytes = footer_bytes + 8;      ///< the footer and the magic at the end
inline constexpr std::uint64_t message_head_bytes = 22;            ///< the fields before the data
inline constexpr std::uint64_t largest_chunk_bytes = 256U << 20U;  ///< uncompressed
inline constexpr std::uint64_t largest_record_bytes = largest_chunk_bytes + (1U << 20U);
inline constexpr std::uint64_t largest_loaded_bytes = 512U << 20U;  ///< of chunks that overlap in time

struct SchemaRecord {
  std::uint16_t id = 0;
  std::string name;
  std::string encoding;
  std::string data;

  friend bool operator==(const SchemaRecord&, const SchemaRecord&) = default;
};

struct ChannelRecord {
  std::uint16_t id = 0;
  std::uint16_t schema_id = 0;  ///< 0: it has no schema
  std::string topic;
  std::string encoding;
  std::map<std::string, std::string> metadata = {};

  friend bool operator==(const ChannelRecord&, const ChannelRecord&) = default;
};

struct MessageRecord {
  std::uint16_t channel_id = 0;
  std::uint32_t sequence = 0;
  std::uint64_t log_time = 0;
  std::uint64_t publish_time = 0;
  std::string_view data;
};

struct ChunkRecord {
  std::uint64_t start_time = 0;
  std::uint64_t end_time = 0;
  std::uint64_t uncompressed_size = 0;
  std::uint32_t uncompressed_crc = 0;  ///< 0: not known, as all checksums
  std::string_view compression;
  std::string_view records;
};

struct ChunkIndexRecord {
  std::uint64_t start_time = 0;
  std::uint64_t end_time = 0;
  std::uint64_t chunk_offset = 0;
  std::uint64_t chunk_length = 0;                                     ///< of the whole record
  std::map<std::uint16_t, std::uint64_t> message_index_offsets = {};  ///< of each channel in the chunk
  std::uint64_t message_index_length = 0;
  std::string compression = {};
  std::uint64_t compressed_size = 0;
  std::uint64_t uncompressed_size = 0;
};

struct AttachmentRecord {
  std::uint64_t log_time = 0;
  std::uint64_t create_time = 0;
  std::string_view name;
  std::string_view media_type;
  std::string_view data;
  std::uint32_t crc = 0;                 ///< of the fields before it
  std::string_view checked_fields = {};  ///< those fields; only set by the decoder
};

struct AttachmentIndexRecord {
  std::uint64_t offset = 0;
  std::uint64_t length = 0;  ///< of the whole record
  std::uint64_t log_time = 0;
  std::uint64_t create_time = 0;
  std::uint64_t data_size = 0;
  std::string name = {};
  std::string media_type = {};
};

struct MetadataIndexRecord {
  std::uint64_t offset = 0;
  std::uint64_t length = 0;  ///< of the whole record
  std::string name = {};
};

struct StatisticsRecord {
  std::uint64_t message_count = 0;
  std::uint16_t schema_count = 0;
  std::uint32_t channel_count = 0;
  std::uint32_t attachment_count = 0;
  std::uint32_t metadata_count = 0;
  std::uint32_t chunk_count = 0;
  std::uint64_t start_time = 0;
  std::uint64_t end_time = 0;
  std::map<std::uint16_t, std::uint64_t> channel_message_counts = {};
};

struct FooterRecord {
  std::uint64_t summary_start = 0;         ///< 0: there is no summary
  std::uint64_t summary_offset_start = 0;  ///< 0: there are no summary offsets
  std::uint32_t summary_crc = 0;           ///< from the summary's start up to this field
};

}  // namespace outrider::mcap
