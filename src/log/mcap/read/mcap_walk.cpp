#include "mcap/read/mcap_walk.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "bytes/byte_reader.hpp"
#include "mcap/mcap_encode.hpp"

namespace outrider::mcap {

Outcome<std::string_view> RecordWalker::view(std::uint64_t offset, std::uint64_t count) {
  constexpr std::uint64_t usual = 16384;
  const bool inside = offset >= window_offset_ && offset - window_offset_ <= window_.size() &&
                      count <= window_.size() - (offset - window_offset_);
  if (!inside) {
    auto read = source_.read(offset, std::min(std::max(count, usual), source_.size() - offset));
    if (!read) return pass_on(read);
    window_ = std::move(*read);
    window_offset_ = offset;
  }
  return std::string_view(window_).substr(static_cast<std::size_t>(offset - window_offset_),
                                          static_cast<std::size_t>(count));
}

Outcome<std::optional<RecordHead>> RecordWalker::next() {
  if (end_ - position_ < head_bytes) return std::nullopt;
  auto head = view(position_, head_bytes);
  if (!head) return pass_on(head);
  ByteReader reader(*head);
  RecordHead record;
  record.op = Op{reader.number<std::uint8_t>()};
  record.offset = position_;
  record.length = reader.number<std::uint64_t>();
  // No record has the opcode 0: it is what a system leaves that stopped before the file was on the disk.
  if (record.op == Op{} || record.length > end_ - record.content()) return std::nullopt;
  position_ = record.end();
  return record;
}

Outcome<std::string_view> RecordWalker::content(const RecordHead& record, std::uint64_t most) {
  const std::uint64_t count = std::min(record.length, most);
  if (count > largest_record_bytes || (record.length > most && most == largest_record_bytes)) {
    return damaged(source_, record.offset,
                   fmt::format("a record has {} bytes, more than the {} that are read", record.length,
                               largest_record_bytes));
  }
  return view(record.content(), count);
}

Outcome<std::uint32_t> crc32_of_range(const ByteSource& source, std::uint64_t begin, std::uint64_t end,
                                      std::uint32_t crc) {
  constexpr std::uint64_t step = 1U << 20U;
  while (begin < end) {
    const std::uint64_t count = std::min(step, end - begin);
    auto bytes = source.read(begin, count);
    if (!bytes) return pass_on(bytes);
    crc = crc32_of(*bytes, crc);
    begin += count;
  }
  return crc;
}

}  // namespace outrider::mcap
