// Appends MCAP records to bytes.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "mcap/mcap_records.hpp"

namespace outrider::mcap {

/// The positions of a channel's messages in a chunk: the time and the offset of each in the uncompressed
/// records.
using MessageIndex = std::vector<std::pair<std::uint64_t, std::uint64_t>>;

void append_header(std::string& out, std::string_view profile, std::string_view library);
void append_schema(std::string& out, const SchemaRecord& schema);
void append_channel(std::string& out, const ChannelRecord& channel);
void append_message(std::string& out, const MessageRecord& message);
void append_chunk(std::string& out, const ChunkRecord& chunk);
void append_message_index(std::string& out, std::uint16_t channel_id, const MessageIndex& index);
void append_chunk_index(std::string& out, const ChunkIndexRecord& index);
void append_attachment(std::string& out, const AttachmentRecord& attachment);  ///< with its checksum
void append_attachment_index(std::string& out, const AttachmentIndexRecord& index);
void append_metadata(std::string& out, std::string_view name,
                     const std::map<std::string, std::string>& metadata);
void append_metadata_index(std::string& out, const MetadataIndexRecord& index);
void append_statistics(std::string& out, const StatisticsRecord& statistics);
void append_summary_offset(std::string& out, Op group, std::uint64_t start, std::uint64_t length);
void append_data_end(std::string& out, std::uint32_t crc);

/// Appends the footer. `crc` is the checksum of the summary so far; that of the footer's own fields is added.
void append_footer(std::string& out, const FooterRecord& footer);

/// Returns the CRC-32 (that of zlib) of the bytes that `crc` belongs to, followed by `bytes`.
std::uint32_t crc32_of(std::string_view bytes, std::uint32_t crc = 0);

}  // namespace outrider::mcap
