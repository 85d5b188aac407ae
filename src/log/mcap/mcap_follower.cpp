#include "outrider/log/mcap/mcap_follower.hpp"

#include <fmt/format.h>

#include <limits>
#include <map>
#include <optional>
#include <utility>

#include "mcap/read/mcap_channels.hpp"
#include "mcap/read/mcap_chunk.hpp"
#include "mcap/read/mcap_walk.hpp"

namespace outrider {

struct McapFollower::State {
  std::string path;
  std::unique_ptr<ByteSource> source = nullptr;  // of the size that the file had when it was opened
  std::uint64_t position = 0;
  std::optional<mcap::RecordHead> part = std::nullopt;
  bool ended = false;  // the data have ended; what follows is the summary
  mcap::ChannelTable table = {};
  std::map<std::uint16_t, std::size_t> number_of_id = {};
  std::vector<Channel> channels = {};

  Status reopen();
  Status skip_magic();
  Status find_part();
  std::string define(mcap::Op op, std::string_view content);
  std::string pass(const mcap::MessageRecord& message,
                   const std::function<void(const LogMessage&)>& on_message) const;
  Outcome<std::string> records_of_part() const;
};

/// Opens the file anew, to see what was added to it.
Status McapFollower::State::reopen() {
  auto opened = open_file_source(path);
  if (!opened) return pass_on(opened);
  source = std::move(*opened);
  return {};
}

Status McapFollower::State::skip_magic() {
  if (position > 0 || source->size() < mcap::magic.size()) return {};
  const auto start = source->read(0, mcap::magic.size());
  if (!start) return pass_on(start);
  if (*start != mcap::magic) return bad_input("it does not begin as an MCAP file; name another", path);
  position = mcap::magic.size();
  return {};
}

/// Moves to the next record that has messages or definitions, and is complete.
Status McapFollower::State::find_part() {
  if (auto ok = skip_magic(); !ok || position == 0) return ok;
  mcap::RecordWalker walker(*source, position, source->size());
  for (;;) {
    const auto record = walker.next();
    if (!record) return pass_on(record);
    if (!*record) return {};
    const mcap::Op op = (*record)->op;
    ended = op == mcap::Op::data_end || op == mcap::Op::footer;
    if (ended) return {};
    position = (*record)->offset;
    if (op == mcap::Op::chunk || op == mcap::Op::schema || op == mcap::Op::channel ||
        op == mcap::Op::message) {
      part = *record;
      return {};
    }
    position = (*record)->end();
  }
}

/// Adds a schema or a channel. Returns a complaint, or an empty text.
std::string McapFollower::State::define(mcap::Op op, std::string_view content) {
  if (std::string complaint = table.add(op, content); !complaint.empty()) return complaint;
  if (op != mcap::Op::channel) return {};
  const auto record = mcap::decode_channel(content);
  if (record && number_of_id.try_emplace(record->id, channels.size()).second) {
    channels.push_back(table.channel(*record));
  }
  return {};
}

std::string McapFollower::State::pass(const mcap::MessageRecord& message,
                                      const std::function<void(const LogMessage&)>& on_message) const {
  const auto number = number_of_id.find(message.channel_id);
  if (number == number_of_id.end())
    return fmt::format("a message belongs to channel {}, which is not defined", message.channel_id);
  on_message({number->second, static_cast<std::int64_t>(message.log_time), message.data});
  return {};
}

/// Returns the records of a chunk; of any other part the record itself.
Outcome<std::string> McapFollower::State::records_of_part() const {
  if (part->op != mcap::Op::chunk) return source->read(part->offset, part->end() - part->offset);
  auto chunk = mcap::read_chunk(*source, part->offset, part->length, mcap::largest_chunk_bytes);
  if (!chunk) return pass_on(chunk);
  return std::move(chunk->records);
}

McapFollower::McapFollower(std::string path)
    : state_(std::make_unique<State>(State{.path = std::move(path)})) {}
McapFollower::McapFollower(McapFollower&&) noexcept = default;
McapFollower& McapFollower::operator=(McapFollower&&) noexcept = default;
McapFollower::~McapFollower() = default;

Outcome<std::uint64_t> McapFollower::next() {
  State& s = *state_;
  if (s.source && !s.part) {
    if (auto ok = s.find_part(); !ok) return pass_on(ok);
  }
  if (!s.part && !s.ended) {
    if (auto ok = s.reopen(); !ok) return pass_on(ok);
    if (auto ok = s.find_part(); !ok) return pass_on(ok);
  }
  return s.part ? s.part->end() - s.part->offset : 0;
}

Status McapFollower::read(const std::function<void(const LogMessage&)>& on_message) {
  State& s = *state_;
  if (!s.part) return {};
  const auto records = s.records_of_part();
  if (!records) return pass_on(records);
  const std::string complaint = mcap::for_each_record(
      *records, [&](mcap::Op op, std::string_view content) { return s.define(op, content); },
      [&](const mcap::MessageRecord& message) { return s.pass(message, on_message); });
  if (!complaint.empty()) return damaged(*s.source, s.part->offset, complaint);
  s.position = s.part->end();
  s.part.reset();
  return {};
}

const std::vector<Channel>& McapFollower::channels() const { return state_->channels; }
std::uint64_t McapFollower::position() const { return state_->position; }

}  // namespace outrider
