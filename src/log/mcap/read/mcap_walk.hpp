// Walks along the records of an MCAP file from head to head, and skips contents that nobody asks for.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "bytes/byte_source.hpp"
#include "mcap/mcap_records.hpp"

namespace outrider::mcap {

struct RecordHead {
  Op op{};
  std::uint64_t offset = 0;  ///< of the opcode
  std::uint64_t length = 0;  ///< of the content

  [[nodiscard]] std::uint64_t content() const { return offset + head_bytes; }
  [[nodiscard]] std::uint64_t end() const { return content() + length; }
};

class RecordWalker {
 public:
  /// Walks from a record to a byte that ends one. The source must outlive the walker.
  RecordWalker(const ByteSource& source, std::uint64_t begin, std::uint64_t end)
      : source_(source), position_(begin), end_(end) {}

  /// Returns the next record that lies wholly before the end; nothing at the end, and where no record is.
  Outcome<std::optional<RecordHead>> next();

  /// Returns where the next record begins.
  [[nodiscard]] std::uint64_t position() const { return position_; }
  [[nodiscard]] bool at_end() const { return position_ == end_; }

  /// Returns the content, or its first bytes; valid until the next call. Fault: bad_input if it is too large.
  Outcome<std::string_view> content(const RecordHead& record, std::uint64_t most = largest_record_bytes);

 private:
  Outcome<std::string_view> view(std::uint64_t offset, std::uint64_t count);

  const ByteSource& source_;
  std::uint64_t position_;
  std::uint64_t end_;
  std::uint64_t window_offset_ = 0;
  std::string window_ = {};
};

/// Returns the checksum of bytes `begin` to `end`, continued from `crc`.
Outcome<std::uint32_t> crc32_of_range(const ByteSource& source, std::uint64_t begin, std::uint64_t end,
                                      std::uint32_t crc = 0);

}  // namespace outrider::mcap
