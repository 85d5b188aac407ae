#include "mcap/mcap_attachments.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <utility>

#include "formats.hpp"
#include "mcap/mcap_encode.hpp"
#include "mcap/read/mcap_decode.hpp"
#include "mcap/read/mcap_summary.hpp"
#include "mcap/read/mcap_walk.hpp"

namespace outrider {
namespace {

Outcome<LogAttachment> decode(const ByteSource& source, std::uint64_t offset, std::string_view content) {
  const auto record = mcap::decode_attachment(content);
  if (!record) return damaged(source, offset, "an attachment is shorter than its fields");
  if (record->crc != 0 && mcap::crc32_of(record->checked_fields) != record->crc) {
    return damaged(source, offset, "the checksum of an attachment is wrong");
  }
  constexpr std::uint64_t latest = std::numeric_limits<std::int64_t>::max();
  const auto time_ns = static_cast<std::int64_t>(std::min(record->log_time, latest));
  return LogAttachment{std::string(record->name), std::string(record->media_type), std::string(record->data),
                       time_ns};
}

/// The attachments that a walk along the data meets.
Outcome<std::vector<LogAttachment>> collect(const ByteSource& source, mcap::RecordWalker& walker) {
  std::vector<LogAttachment> all;
  std::uint64_t total = 0;
  while (true) {
    auto record = walker.next();
    if (!record) return pass_on(record);
    if (!*record || (*record)->op == mcap::Op::data_end) return all;
    if ((*record)->op != mcap::Op::attachment) continue;
    const std::uint64_t offset = (*record)->offset;
    total += (*record)->length;
    if (total > mcap::largest_record_bytes) {
      return damaged(source, offset, "its attachments exceed 256 MiB", "take the large ones out of the log");
    }
    auto content = walker.content(**record);
    if (!content) return pass_on(content);
    auto attachment = decode(source, offset, *content);
    if (!attachment) return pass_on(attachment);
    all.push_back(std::move(*attachment));
  }
}

}  // namespace

Outcome<std::vector<LogAttachment>> read_attachments(const ByteSource& source) {
  auto start = source.read(0, std::min<std::uint64_t>(mcap::magic.size(), source.size()));
  if (!start) return pass_on(start);
  if (!is_mcap(*start)) return bad_input("it is not an MCAP file: it does not start as one", source.name());
  const auto footer = mcap::read_footer(source);
  if (!footer) return pass_on(footer);
  mcap::RecordWalker walker(source, mcap::magic.size(), mcap::end_of_data(source, *footer));
  auto all = collect(source, walker);
  if (all && *footer && !walker.at_end()) {
    return damaged(source, walker.position(), "a record reaches past the end of the data");
  }
  return all;
}

Outcome<std::vector<LogAttachment>> read_attachments(const std::string& path) {
  const auto source = open_file_source(path);
  if (!source) return pass_on(source);
  return read_attachments(**source);
}

}  // namespace outrider
