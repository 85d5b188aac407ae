// The end of an MCAP file: its footer, and the summary that the footer leads to.
#pragma once

#include <cstdint>
#include <map>
#include <optional>

#include "bytes/byte_source.hpp"
#include "mcap/read/mcap_channels.hpp"

namespace outrider::mcap {

/// Returns the footer; nothing if the end of the file is missing. Fault: bad_input if the file has an end,
/// but its footer is wrong.
Outcome<std::optional<FooterRecord>> read_footer(const ByteSource& source);

/// Returns where the data section ends, at the latest.
std::uint64_t end_of_data(const ByteSource& source, const std::optional<FooterRecord>& footer);

struct FileSummary {
  ChannelTable table;
  std::map<std::uint64_t, ChunkIndexRecord> chunks;  ///< by their offset
};

/// Reads the summary; empty if the file has none. Its checksum holds. Fault: bad_input with the offset.
Outcome<FileSummary> read_summary(const ByteSource& source, const FooterRecord& footer);

}  // namespace outrider::mcap
