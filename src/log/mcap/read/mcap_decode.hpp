// Decodes the contents of MCAP records. Nothing: the content is shorter than its fields. Bytes after the last
// known field are ignored, as the specification asks. Views point into the content.
#pragma once

#include <optional>
#include <string_view>

#include "bytes/byte_reader.hpp"
#include "mcap/mcap_records.hpp"

namespace outrider::mcap {

std::optional<SchemaRecord> decode_schema(std::string_view content);
std::optional<ChannelRecord> decode_channel(std::string_view content);
std::optional<MessageRecord> decode_message(std::string_view content);
std::optional<ChunkRecord> decode_chunk(std::string_view content);
std::optional<ChunkIndexRecord> decode_chunk_index(std::string_view content);
std::optional<AttachmentRecord> decode_attachment(std::string_view content);
std::optional<FooterRecord> decode_footer(std::string_view content);
std::optional<std::uint32_t> decode_data_end(std::string_view content);  ///< the checksum

/// The records of a block of bytes, one after the other.
class Records {
 public:
  struct Record {
    Op op{};
    std::size_t offset = 0;  ///< in the block
    std::string_view content;
  };

  explicit Records(std::string_view block) : reader_(block) {}

  /// Returns the next record; nothing at the end, or where the block is damaged.
  std::optional<Record> next();

  /// Returns true if the block ended within a record.
  [[nodiscard]] bool damaged() const { return !reader_.ok(); }

 private:
  ByteReader reader_;
};

}  // namespace outrider::mcap
