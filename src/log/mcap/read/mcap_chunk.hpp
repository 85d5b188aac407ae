// Chunks of an MCAP file: read, checked and decompressed; and the records in them.
#pragma once

#include <fmt/format.h>

#include <cstdint>
#include <limits>
#include <string>
#include <string_view>

#include "bytes/byte_source.hpp"
#include "mcap/read/mcap_decode.hpp"

namespace outrider::mcap {

struct Chunk {
  std::uint64_t start_time = 0;  ///< as it states
  std::uint64_t end_time = 0;
  std::string records;  ///< decompressed
};

/// Returns a complaint if a time does not fit in the 63 bits of LogMessage::time_ns, else an empty text.
inline std::string too_late(std::uint64_t time_ns) {
  if (time_ns <= std::uint64_t{std::numeric_limits<std::int64_t>::max()}) return {};
  return fmt::format("a message has the time {} ns, which lies after the year 2262", time_ns);
}

/// Reads the chunk record at an offset, whose content has `length` bytes. Its checksum holds, and it has at
/// most `most_bytes` bytes when it is decompressed. Fault: bad_input with the offset.
Outcome<Chunk> read_chunk(const ByteSource& source, std::uint64_t offset, std::uint64_t length,
                          std::uint64_t most_bytes);

/// Calls `on_definition(op, content)` and `on_message(message)` for the records of a chunk, until one returns
/// a complaint. Returns that complaint, or that of a damaged record, or an empty text.
template <class OnDefinition, class OnMessage>
std::string for_each_record(std::string_view block, OnDefinition on_definition, OnMessage on_message) {
  Records records(block);
  while (const auto record = records.next()) {
    std::string complaint;
    if (record->op == Op::schema || record->op == Op::channel) {
      complaint = on_definition(record->op, record->content);
    } else if (record->op == Op::message) {
      const auto message = decode_message(record->content);
      if (!message) return "a message record is shorter than its fields";
      if (auto late = too_late(message->log_time); !late.empty()) return late;
      complaint = on_message(*message);
    } else if (record->op <= Op::data_end) {
      complaint =
          fmt::format("a record of kind {} lies in a chunk, where it does not belong", int(record->op));
    }
    if (!complaint.empty()) return complaint;
  }
  return records.damaged() ? "a record reaches past the end of its chunk" : std::string();
}

}  // namespace outrider::mcap
