// The parts of an MCAP file under construction: the output with its checksums, the definitions of channels,
// the chunk that is being filled, and the summary.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "mcap/mcap_encode.hpp"
#include "outrider/log/bytes/byte_sink.hpp"
#include "outrider/log/bytes/codec.hpp"
#include "outrider/log/log_reader.hpp"

namespace outrider::mcap {

/// Counts what goes to a sink, and keeps its checksum.
class Output {
 public:
  explicit Output(std::unique_ptr<ByteSink> sink) : sink_(std::move(sink)) {}

  Status write(std::string_view bytes);
  Status close() { return sink_->close(); }
  [[nodiscard]] std::uint64_t position() const { return position_; }
  [[nodiscard]] std::uint32_t crc() const { return crc_; }
  void restart_crc() { crc_ = 0; }

 private:
  std::unique_ptr<ByteSink> sink_;
  std::uint64_t position_ = 0;
  std::uint32_t crc_ = 0;
};

/// The channels and schemas that were defined, by id: the id is the index plus 1.
struct Definitions {
  std::vector<SchemaRecord> schemas;
  std::vector<ChannelRecord> channels;

  /// Adds a channel, and its schema unless an equal one is there; appends what is new to `out`.
  void add(const Channel& channel, std::string& out);
  [[nodiscard]] bool too_many() const;
};

/// The messages that wait to be written together.
class ChunkBuffer {
 public:
  /// Returns the buffer to which definitions are appended.
  std::string& records() { return records_; }
  void add(const MessageRecord& message);
  [[nodiscard]] std::size_t size() const { return records_.size(); }
  [[nodiscard]] bool has_messages() const { return !indexes_.empty(); }

  /// Writes the chunk and its message indexes, and empties the buffer. Definitions alone need no chunk: they
  /// are written as they are, and nothing is added to `chunks`.
  Status write_to(Output& out, Codec codec, std::vector<ChunkIndexRecord>& chunks);

 private:
  std::string records_;
  std::map<std::uint16_t, MessageIndex> indexes_;
  std::uint64_t start_time_ = 0;
  std::uint64_t end_time_ = 0;
};

/// The content of the summary at the end of a file: repeated definitions, counts and indexes.
struct Summary {
  Definitions definitions;
  StatisticsRecord statistics;
  std::vector<ChunkIndexRecord> chunks;
  std::vector<AttachmentIndexRecord> attachments;
  std::vector<MetadataIndexRecord> metadata;
};

/// Writes all that follows the data: the summary, the footer, the magic.
Status write_summary(Output& out, Summary summary);

}  // namespace outrider::mcap
