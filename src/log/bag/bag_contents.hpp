// BagContents: the channels of a ROS 1 bag and the positions of its chunks.
//
// They come from the index at the end of the bag. A bag without one, because its recorder was killed or its
// end is missing, is read once from its beginning: each chunk is decompressed, and then let go.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "bag/bag_records.hpp"

namespace outrider {

struct BagChunkInfo {
  std::uint64_t position = 0;  ///< of the record of the chunk
  std::int64_t first_ns = 0;   ///< the earliest and the latest time of its messages
  std::int64_t last_ns = 0;
  std::vector<std::uint32_t> connections;  ///< that have messages in it
};

struct BagContents {
  std::vector<Channel> channels;
  std::map<std::uint32_t, std::size_t> channel_of;  ///< of a connection, by its number
  std::vector<BagChunkInfo> chunks;                 ///< those with messages, in the order of the file
  std::size_t channel_bytes = 0;                    ///< of the texts of the channels
  std::string cut_short;                            ///< a sentence, if the end is missing
};

/// Fault: bad_input, if it is no bag, is encrypted, or has a damaged index.
Outcome<BagContents> read_bag_contents(const ByteSource& source);

}  // namespace outrider
