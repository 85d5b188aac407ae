#include "mcap/read/mcap_index.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <map>
#include <optional>
#include <utility>

#include "mcap/read/mcap_chunk.hpp"
#include "mcap/read/mcap_decode.hpp"
#include "mcap/read/mcap_summary.hpp"
#include "mcap/read/mcap_walk.hpp"

namespace outrider::mcap {
namespace {

Piece piece_of(const ChunkIndexRecord& chunk) {
  Piece piece{chunk.chunk_offset, chunk.chunk_length, chunk.start_time, chunk.end_time, true};
  for (const auto& [id, offset] : chunk.message_index_offsets) piece.channel_ids.push_back(id);
  return piece;
}

class IndexBuilder {
 public:
  IndexBuilder(const ByteSource& source, std::optional<FooterRecord> footer, FileSummary summary)
      : source_(source),
        footer_(footer),
        walker_(source, magic.size(), end_of_data(source, footer)),
        index_{std::move(summary.table), {}, {}},
        has_summary_(!index_.table.empty()),
        chunks_(has_summary_ ? std::move(summary.chunks) : std::map<std::uint64_t, ChunkIndexRecord>{}),
        lists_chunks_(!chunks_.empty()) {}

  Outcome<McapIndex> build() {
    while (true) {
      auto record = walker_.next();
      if (!record) return pass_on(record);
      if (!*record) break;
      if (auto added = add(**record); !added) return pass_on(added);
      last_ = (*record)->op;
    }
    if (auto whole = check_end(); !whole) return pass_on(whole);
    if (const std::string complaint = index_.table.check(); !complaint.empty()) {
      return damaged(source_, 0, complaint);
    }
    return std::move(index_);
  }

 private:
  Status add(const RecordHead& record);
  Status add_definition(const RecordHead& record);
  Status add_message(const RecordHead& record);
  Status add_chunk(const RecordHead& record);
  Status scan_chunk(const RecordHead& record);
  Status check_message_index(const RecordHead& record);
  Status end_data(const RecordHead& record);
  Status check_end();

  const ByteSource& source_;
  std::optional<FooterRecord> footer_;
  RecordWalker walker_;
  McapIndex index_;
  bool has_summary_;
  std::map<std::uint64_t, ChunkIndexRecord> chunks_;  // those of the summary that were not met yet
  bool lists_chunks_;                                 // the summary names chunks
  bool unlisted_ = false;                             // there are messages that the summary does not name
  Op last_{};                                         // the kind of the record before
  std::uint64_t header_end_ = 0;
  bool data_ended_ = false;
};

Status IndexBuilder::add(const RecordHead& record) {
  if ((header_end_ == 0) != (record.op == Op::header)) {
    return damaged(source_, record.offset, "there is not one header at the start");
  }
  switch (record.op) {
    case Op::header: header_end_ = record.end(); return {};
    case Op::schema:
    case Op::channel: return add_definition(record);
    case Op::message: return add_message(record);
    case Op::chunk: return add_chunk(record);
    case Op::message_index: return check_message_index(record);
    case Op::data_end: return end_data(record);
    case Op::footer:
    case Op::chunk_index:
    case Op::attachment_index:
    case Op::statistics:
    case Op::metadata_index:
    case Op::summary_offset:
      if (data_ended_) return {};
      return damaged(source_, record.offset, "a record of the summary lies among the data");
    default: return {};  // attachments, metadata, and kinds that a later format adds
  }
}

Status IndexBuilder::add_definition(const RecordHead& record) {
  auto content = walker_.content(record);
  if (!content) return pass_on(content);
  const std::string complaint =
      has_summary_ ? index_.table.find(record.op, *content) : index_.table.add(record.op, *content);
  return complaint.empty() ? Status{} : damaged(source_, record.offset, complaint);
}

/// Adds a message outside of chunks. Neighbours make up one piece, as long as it is small.
Status IndexBuilder::add_message(const RecordHead& record) {
  constexpr std::uint64_t usual_piece = 1U << 20U;
  if (data_ended_) return damaged(source_, record.offset, "a message follows the end of the data");
  unlisted_ = true;
  auto content = walker_.content(record, message_head_bytes);
  if (!content) return pass_on(content);
  const auto message = decode_message(*content);
  if (!message) return damaged(source_, record.offset, "a message record is shorter than its fields");
  const std::uint64_t time = message->log_time;
  if (const auto late = too_late(time); !late.empty()) return damaged(source_, record.offset, late);
  Piece* piece = index_.pieces.empty() ? nullptr : &index_.pieces.back();
  if (piece == nullptr || piece->is_chunk || piece->offset + piece->length != record.offset ||
      piece->length > usual_piece) {
    piece = &index_.pieces.emplace_back(Piece{record.offset, 0, time, time, false});
  }
  piece->length = record.end() - piece->offset;
  piece->start_time = std::min(piece->start_time, time);
  piece->end_time = std::max(piece->end_time, time);
  return {};
}

Status IndexBuilder::add_chunk(const RecordHead& record) {
  if (data_ended_) return damaged(source_, record.offset, "a chunk follows the end of the data");
  if (!lists_chunks_) return scan_chunk(record);
  const auto listed = chunks_.find(record.offset);
  if (listed == chunks_.end() || listed->second.chunk_length != head_bytes + record.length) {
    return damaged(source_, record.offset, "there is a chunk that the summary does not name");
  }
  if (const auto late = too_late(listed->second.end_time); !late.empty()) {
    return damaged(source_, record.offset, late);
  }
  index_.pieces.push_back(piece_of(listed->second));
  chunks_.erase(listed);
  return {};
}

Status IndexBuilder::scan_chunk(const RecordHead& record) {
  unlisted_ = true;
  const auto chunk = read_chunk(source_, record.offset, record.length, largest_chunk_bytes);
  if (!chunk) return pass_on(chunk);
  Piece piece{record.offset, head_bytes + record.length, std::numeric_limits<std::uint64_t>::max(), 0, true};
  const auto on_definition = [&](Op op, std::string_view content) {
    return has_summary_ ? index_.table.find(op, content) : index_.table.add(op, content);
  };
  const auto on_message = [&](const MessageRecord& message) {
    piece.start_time = std::min(piece.start_time, message.log_time);
    piece.end_time = std::max(piece.end_time, message.log_time);
    return std::string();
  };
  const std::string complaint = for_each_record(chunk->records, on_definition, on_message);
  if (!complaint.empty()) return damaged(source_, record.offset, complaint);
  if (piece.start_time > piece.end_time) return {};  // it has no message
  if (piece.start_time < chunk->start_time || piece.end_time > chunk->end_time) {
    return damaged(source_, record.offset, "a message lies outside of the times of its chunk");
  }
  piece.start_time = chunk->start_time;
  piece.end_time = chunk->end_time;
  index_.pieces.push_back(std::move(piece));
  return {};
}

/// A message index follows its chunk: if it does not, there was a chunk whose kind was damaged.
Status IndexBuilder::check_message_index(const RecordHead& record) {
  auto content = walker_.content(record, 6);
  if (!content) return pass_on(content);
  ByteReader reader(*content);
  reader.number<std::uint16_t>();
  const auto length = reader.number<std::uint32_t>();
  const bool follows = last_ == Op::chunk || last_ == Op::message_index;
  if (follows && reader.ok() && length % 16 == 0 && record.length == 6U + std::uint64_t{length}) return {};
  return damaged(source_, record.offset, "a message index is wrong or follows no chunk");
}

/// The checksum of the data is compared where messages are read that no other checksum or index covers.
Status IndexBuilder::end_data(const RecordHead& record) {
  if (data_ended_) return damaged(source_, record.offset, "the data end a second time");
  if (footer_ && record.end() != end_of_data(source_, footer_)) {
    return damaged(source_, record.offset, "the data end before the summary starts");
  }
  data_ended_ = true;
  auto content = walker_.content(record);
  if (!content) return pass_on(content);
  const auto stated = decode_data_end(*content);
  if (!stated) return damaged(source_, record.offset, "the end of the data is shorter than its fields");
  if (*stated == 0 || !unlisted_) return {};
  // Some writers count from the start of the file, some from the end of the header.
  for (const std::uint64_t start : {std::uint64_t{0}, header_end_}) {
    const auto crc = crc32_of_range(source_, start, record.offset);
    if (!crc) return pass_on(crc);
    if (*crc == *stated) return {};
  }
  return damaged(source_, record.offset, "the checksum of the data is wrong");
}

Status IndexBuilder::check_end() {
  if (footer_ && !walker_.at_end()) {
    return damaged(source_, walker_.position(), "a record reaches past the end of the data");
  }
  if (footer_ && header_end_ == 0) return damaged(source_, magic.size(), "there is no header");
  if (!chunks_.empty()) {
    return damaged(source_, chunks_.begin()->first, "there is not the chunk that the summary names");
  }
  if (!footer_) {
    index_.cut_short = fmt::format("the log ends early: its last complete record ends at byte {} of {}",
                                   walker_.position(), source_.size());
  }
  return {};
}

}  // namespace

Outcome<McapIndex> read_index(const ByteSource& source) {
  auto start = source.read(0, std::min<std::uint64_t>(magic.size(), source.size()));
  if (!start) return pass_on(start);
  if (*start != magic) return bad_input("it is not an MCAP file: it does not start as one", source.name());
  auto footer = read_footer(source);
  if (!footer) return pass_on(footer);
  Outcome<FileSummary> summary = *footer ? read_summary(source, **footer) : FileSummary{};
  if (!summary) return pass_on(summary);
  return IndexBuilder(source, *footer, std::move(*summary)).build();
}

}  // namespace outrider::mcap
