#include "mcap/mcap_output.hpp"

#include <algorithm>
#include <limits>
#include <utility>

#include "bytes/compression.hpp"

namespace outrider::mcap {
namespace {

/// Appends the records of the summary group by group, and remembers where each group stands.
class Groups {
 public:
  explicit Groups(std::uint64_t start) : start_(start) {}

  template <class Records, class Append>
  void add(Op op, const Records& records, Append append) {
    if (records.empty()) return;
    const std::uint64_t begin = position();
    for (const auto& record : records) append(bytes_, record);
    append_summary_offset(offsets_, op, begin, position() - begin);
  }

  [[nodiscard]] std::uint64_t position() const { return start_ + bytes_.size(); }
  [[nodiscard]] std::string all() const { return bytes_ + offsets_; }

 private:
  std::uint64_t start_;
  std::string bytes_;
  std::string offsets_;
};

void count(Summary& summary) {
  summary.statistics.schema_count = static_cast<std::uint16_t>(summary.definitions.schemas.size());
  summary.statistics.channel_count = static_cast<std::uint32_t>(summary.definitions.channels.size());
  summary.statistics.chunk_count = static_cast<std::uint32_t>(summary.chunks.size());
  summary.statistics.attachment_count = static_cast<std::uint32_t>(summary.attachments.size());
  summary.statistics.metadata_count = static_cast<std::uint32_t>(summary.metadata.size());
}

}  // namespace

Status Output::write(std::string_view bytes) {
  crc_ = crc32_of(bytes, crc_);
  position_ += bytes.size();
  return sink_->write(bytes);
}

void Definitions::add(const Channel& channel, std::string& out) {
  SchemaRecord schema{0, channel.type, channel.schema_encoding, channel.schema};
  if (schema != SchemaRecord{}) {
    const auto same = [&](const SchemaRecord& other) {
      return other.name == schema.name && other.encoding == schema.encoding && other.data == schema.data;
    };
    const auto found = std::find_if(schemas.begin(), schemas.end(), same);
    schema.id = static_cast<std::uint16_t>(found - schemas.begin() + 1);
    if (found == schemas.end()) {
      append_schema(out, schema);
      schemas.push_back(schema);
    }
  }
  const auto id = static_cast<std::uint16_t>(channels.size() + 1);
  channels.push_back({id, schema.id, channel.topic, channel.encoding, channel.metadata});
  append_channel(out, channels.back());
}

bool Definitions::too_many() const {
  constexpr std::size_t most = std::numeric_limits<std::uint16_t>::max();
  return channels.size() > most || schemas.size() > most;
}

void ChunkBuffer::add(const MessageRecord& message) {
  const bool first = !has_messages();
  start_time_ = first ? message.log_time : std::min(start_time_, message.log_time);
  end_time_ = first ? message.log_time : std::max(end_time_, message.log_time);
  indexes_[message.channel_id].emplace_back(message.log_time, records_.size());
  append_message(records_, message);
}

Status ChunkBuffer::write_to(Output& out, Codec codec, std::vector<ChunkIndexRecord>& chunks) {
  const std::string records = std::exchange(records_, {});
  if (!has_messages()) return out.write(records);
  const std::string compressed = compress(codec, records);
  std::string bytes;
  append_chunk(bytes,
               {start_time_, end_time_, records.size(), crc32_of(records), name_of(codec), compressed});
  ChunkIndexRecord index{start_time_, end_time_, out.position(), bytes.size()};
  for (auto& [channel_id, messages] : indexes_) {
    // Earlier messages first, as readers that search an index expect.
    std::stable_sort(messages.begin(), messages.end(),
                     [](const auto& a, const auto& b) { return a.first < b.first; });
    index.message_index_offsets[channel_id] = out.position() + bytes.size();
    append_message_index(bytes, channel_id, messages);
  }
  index.message_index_length = bytes.size() - index.chunk_length;
  index.compression = name_of(codec);
  index.compressed_size = compressed.size();
  index.uncompressed_size = records.size();
  chunks.push_back(std::move(index));
  indexes_.clear();
  return out.write(bytes);
}

Status write_summary(Output& out, Summary summary) {
  count(summary);
  std::string end;
  append_data_end(end, out.crc());
  if (auto written = out.write(end); !written) return written;

  FooterRecord footer{.summary_start = out.position()};
  Groups groups(out.position());
  groups.add(Op::schema, summary.definitions.schemas, append_schema);
  groups.add(Op::channel, summary.definitions.channels, append_channel);
  groups.add(Op::statistics, std::vector{summary.statistics}, append_statistics);
  groups.add(Op::chunk_index, summary.chunks, append_chunk_index);
  groups.add(Op::attachment_index, summary.attachments, append_attachment_index);
  groups.add(Op::metadata_index, summary.metadata, append_metadata_index);
  footer.summary_offset_start = groups.position();

  std::string bytes = groups.all();
  footer.summary_crc = crc32_of(bytes);
  append_footer(bytes, footer);
  bytes.append(magic);
  if (auto written = out.write(bytes); !written) return written;
  return out.close();
}

}  // namespace outrider::mcap
