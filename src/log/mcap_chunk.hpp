// Chunks of an MCAP file: read, checked and decompressed; and the records in them.
#pragma once

#include <fmt/format.h>

#include <cstdint>
#include <limits>
#include <string>
#include <string_view>

#include "byte_source.hpp"
#include "mcap_decode.hpp"

namespace outrider::mcap {

struct Chunk {
  std::uint64_t start_time = 0;  ///< as it states
  std::uint64_t end_time = 0;
  std::string records;  ///< decompressed
};

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
      if (message->log_time > std::uint64_t{std::numeric_limits<std::int64_t>::max()}) {
        return fmt::format("a message has the time {} ns, which lies after the year 2262", message->log_time);
      }
      complaint = on_message(*message);
    } else if (record->op <= Op::data_end) {
      complaint =
          fmt::format("a record of kind {} lies in a chunk, where it does not belong", int(record->op));
    }
    if (!complaint.empty()) return complaint;
  }
  return records.damaged_mcap() ? "a record reaches past the end of its chunk" : std::string();
}

}  // namespace outrider::mcap
