// McapIndex: the channels of an MCAP file, and the pieces from which messages are read.
//
// The whole file is walked along its record heads, so nothing in it is missed that its summary does not name.
// The statements of the summary about a chunk are trusted until the chunk is read. Without a summary, each
// chunk is read once here.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "bytes/byte_source.hpp"
#include "mcap/read/mcap_channels.hpp"

namespace outrider::mcap {

/// Bytes that are loaded together: a chunk, or messages outside of chunks that follow one another.
struct Piece {
  std::uint64_t offset = 0;
  std::uint64_t length = 0;
  std::uint64_t start_time = 0;  ///< no message is earlier
  std::uint64_t end_time = 0;    ///< no message is later
  bool is_chunk = false;
  std::vector<std::uint16_t> channel_ids = {};  ///< sorted: only these have messages; empty: not known
};

struct McapIndex {
  ChannelTable table;
  std::vector<Piece> pieces;  ///< in the order of the file
  std::string cut_short;      ///< a sentence if the end of the file is missing, else empty
};

/// Fault: bad_input with the offset.
Outcome<McapIndex> read_index(const ByteSource& source);

}  // namespace outrider::mcap
