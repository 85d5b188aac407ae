// Chunks of ROS 1 bags: their records, compressed together.
#pragma once

#include <functional>
#include <string>
#include <string_view>

#include "bag/bag_records.hpp"

namespace outrider {

/// Reads and decompresses the data of a chunk record. Fault: bad_input with the position of the record.
Outcome<std::string> unpack_bag_chunk(const ByteSource& source, const BagRecord& chunk);

/// A record within a chunk; the views are of the chunk.
struct BagChunkRecord {
  BagOp op = BagOp::message;
  BagFields fields;
  std::string_view data;
};

/// Calls visit(record) for each record of an unpacked chunk, until it returns a sentence that says what is
/// wrong. Returns that sentence, or one about a damaged record, or an empty text.
std::string for_each_in_chunk(std::string_view chunk,
                              const std::function<std::string(const BagChunkRecord&)>& visit);

}  // namespace outrider
