#include "outrider/log/mcap/mcap_writer.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "mcap/mcap_output.hpp"

namespace outrider {
namespace {

constexpr std::size_t largest_content = std::size_t{255} << 20U;  // of a message or an attachment

Status check(std::int64_t time_ns, std::size_t bytes) {
  if (time_ns < 0)
    return bad_input(fmt::format("the time {} ns is negative; MCAP counts from 1970", time_ns));
  if (bytes > largest_content) {
    return bad_input(
        fmt::format("{} bytes are too long for one record; split them into parts of at most {} bytes", bytes,
                    largest_content));
  }
  return {};
}

}  // namespace

struct McapWriter::State {
  mcap::Output out;
  Codec codec = Codec::none;
  std::size_t chunk_bytes = 0;
  mcap::ChunkBuffer chunk = {};
  mcap::Summary summary = {};
  std::vector<std::uint32_t> sequences = {};  // the last of each channel
  Status state = {};                          // the first fault, which all further calls return

  Status keep(Status status) {
    if (!status) state = status;
    return status;
  }
  Status flush() { return keep(chunk.write_to(out, codec, summary.chunks)); }
  Status check_channel(std::size_t channel) {
    if (summary.definitions.too_many()) {
      return keep(bad_input(
          "it has more than 65535 channels or schemas, which MCAP cannot number; use several files"));
    }
    if (channel < sequences.size()) return {};
    return bad_input(
        fmt::format("there is no channel {}; add_channel() gave {} so far", channel, sequences.size()));
  }
};

McapWriter::McapWriter(std::unique_ptr<State> state) : state_(std::move(state)) {}
McapWriter::McapWriter(McapWriter&&) noexcept = default;
McapWriter& McapWriter::operator=(McapWriter&&) noexcept = default;
McapWriter::~McapWriter() = default;

Outcome<McapWriter> McapWriter::create(const std::string& path, const McapOptions& options) {
  auto sink = make_file_sink(path);
  if (!sink) return pass_on(sink);
  return begin(std::move(*sink), options);
}

Outcome<McapWriter> McapWriter::begin(std::unique_ptr<ByteSink> sink, const McapOptions& options) {
  constexpr std::size_t largest_chunk = std::size_t{64} << 20U;
  McapWriter writer(std::make_unique<State>(
      State{.out = mcap::Output(std::move(sink)),
            .codec = options.compression,
            .chunk_bytes = std::clamp(options.chunk_bytes, std::size_t{1}, largest_chunk)}));
  std::string head(mcap::magic);
  mcap::append_header(head, options.profile, options.library);
  if (auto written = writer.state_->out.write(head); !written) return pass_on(written);
  return writer;
}

std::size_t McapWriter::add_channel(const Channel& channel) {
  state_->summary.definitions.add(channel, state_->chunk.records());
  state_->sequences.push_back(0);
  return state_->sequences.size() - 1;
}

Status McapWriter::write(std::size_t channel, std::int64_t time_ns, std::string_view data) {
  State& s = *state_;
  if (!s.state) return s.state;
  if (auto known = s.check_channel(channel); !known) return known;
  if (auto good = check(time_ns, data.size()); !good) return good;
  if (s.chunk.size() > 0 && s.chunk.size() + data.size() > s.chunk_bytes) {
    if (auto flushed = s.flush(); !flushed) return flushed;
  }
  const auto id = static_cast<std::uint16_t>(channel + 1);
  const auto time = static_cast<std::uint64_t>(time_ns);
  s.chunk.add({id, ++s.sequences[channel], time, time, data});
  mcap::StatisticsRecord& count = s.summary.statistics;
  const bool first = count.message_count++ == 0;
  ++count.channel_message_counts[id];
  count.start_time = first ? time : std::min(count.start_time, time);
  count.end_time = first ? time : std::max(count.end_time, time);
  return s.chunk.size() < s.chunk_bytes ? Status{} : s.flush();
}

Status McapWriter::attach(const std::string& name, const std::string& media_type, std::string_view content,
                          std::int64_t time_ns) {
  State& s = *state_;
  if (!s.state) return s.state;
  if (auto good = check(time_ns, content.size()); !good) return good;
  const auto time = static_cast<std::uint64_t>(time_ns);
  std::string record;
  mcap::append_attachment(record,
                          {.log_time = time, .name = name, .media_type = media_type, .data = content});
  s.summary.attachments.push_back(
      {s.out.position(), record.size(), time, 0, content.size(), name, media_type});
  return s.keep(s.out.write(record));
}

Status McapWriter::add_metadata(const std::string& name, const std::map<std::string, std::string>& metadata) {
  State& s = *state_;
  if (!s.state) return s.state;
  std::string record;
  mcap::append_metadata(record, name, metadata);
  s.summary.metadata.push_back({s.out.position(), record.size(), name});
  return s.keep(s.out.write(record));
}

Status McapWriter::flush() { return state_->state ? state_->flush() : state_->state; }

Status McapWriter::finish() {
  State& s = *state_;
  if (!s.state) return s.state;
  if (s.summary.definitions.too_many()) return s.check_channel(0);
  if (auto flushed = s.flush(); !flushed) return flushed;
  const Status written = s.keep(mcap::write_summary(s.out, std::move(s.summary)));
  if (written) s.state = bad_input("the log is finished; nothing can be added to it");
  return written;
}

}  // namespace outrider
