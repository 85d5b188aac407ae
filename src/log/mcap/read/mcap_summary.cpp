#include "mcap/read/mcap_summary.hpp"

#include <fmt/format.h>

#include <utility>

#include "mcap/read/mcap_decode.hpp"
#include "mcap/read/mcap_walk.hpp"

namespace outrider::mcap {
namespace {

std::string add(ChunkIndexRecord chunk, std::uint64_t data_end, FileSummary& summary) {
  const std::uint64_t offset = chunk.chunk_offset;
  if (chunk.chunk_length < head_bytes || offset > data_end || chunk.chunk_length > data_end - offset) {
    return fmt::format("the summary names a chunk at byte {}, where none can be", offset);
  }
  if (chunk.start_time > chunk.end_time)
    return fmt::format("the chunk at byte {} ends before it starts", offset);
  if (summary.chunks.emplace(offset, std::move(chunk)).second) return {};
  return fmt::format("the summary names the chunk at byte {} twice", offset);
}

std::string add(Op op, std::string_view content, std::uint64_t data_end, FileSummary& summary) {
  if (op == Op::schema || op == Op::channel) return summary.table.add(op, content);
  if (op != Op::chunk_index) return {};
  auto chunk = decode_chunk_index(content);
  return chunk ? add(std::move(*chunk), data_end, summary) : "a chunk index is shorter than its fields";
}

bool is_read(Op op) { return op == Op::schema || op == Op::channel || op == Op::chunk_index; }
bool belongs_to_data(Op op) {
  return op == Op::message || op == Op::chunk || op == Op::header || op == Op::footer;
}

Status check_crc(const ByteSource& source, const FooterRecord& footer) {
  if (footer.summary_crc == 0) return {};
  const auto crc = crc32_of_range(source, footer.summary_start, source.size() - magic.size() - 4);
  if (!crc) return pass_on(crc);
  if (*crc != footer.summary_crc)
    return damaged(source, footer.summary_start, "the checksum of the summary is wrong");
  return {};
}

}  // namespace

Outcome<std::optional<FooterRecord>> read_footer(const ByteSource& source) {
  const std::uint64_t size = source.size();
  if (size < magic.size() + tail_bytes) return std::nullopt;
  const std::uint64_t offset = size - tail_bytes;
  auto tail = source.read(offset, tail_bytes);
  if (!tail) return pass_on(tail);
  if (!tail->ends_with(magic)) return std::nullopt;
  ByteReader reader(*tail);
  const bool is_footer = reader.number<std::uint8_t>() == static_cast<std::uint8_t>(Op::footer) &&
                         reader.number<std::uint64_t>() == footer_bytes - head_bytes;
  const auto footer = decode_footer(reader.rest());
  const bool starts_inside = footer && (footer->summary_start == 0 || (footer->summary_start > magic.size() &&
                                                                       footer->summary_start <= offset));
  if (!is_footer || !starts_inside) return damaged(source, offset, "the footer is wrong");
  return footer;
}

std::uint64_t end_of_data(const ByteSource& source, const std::optional<FooterRecord>& footer) {
  if (!footer) return source.size();
  return footer->summary_start == 0 ? source.size() - tail_bytes : footer->summary_start;
}

Outcome<FileSummary> read_summary(const ByteSource& source, const FooterRecord& footer) {
  FileSummary summary;
  if (footer.summary_start == 0) return summary;
  if (auto good = check_crc(source, footer); !good) return pass_on(good);
  RecordWalker walker(source, footer.summary_start, source.size() - tail_bytes);
  while (true) {
    const auto record = walker.next();
    if (!record) return pass_on(record);
    if (!*record) break;
    if (belongs_to_data((*record)->op)) {
      return damaged(source, (*record)->offset, "a record lies in the summary that does not belong there");
    }
    if (!is_read((*record)->op)) continue;
    auto content = walker.content(**record);
    if (!content) return pass_on(content);
    const std::string complaint = add((*record)->op, *content, footer.summary_start, summary);
    if (!complaint.empty()) return damaged(source, (*record)->offset, complaint);
  }
  if (!walker.at_end())
    return damaged(source, walker.position(), "a record reaches past the end of the summary");
  return summary;
}

}  // namespace outrider::mcap
