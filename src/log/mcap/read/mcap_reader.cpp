#include "mcap/read/mcap_reader.hpp"

#include <algorithm>
#include <tuple>
#include <utility>

#include "mcap/read/mcap_chunk.hpp"
#include "mcap/read/mcap_walk.hpp"

namespace outrider {
namespace mcap {

McapReader::McapReader(std::unique_ptr<ByteSource> source, McapIndex index, const LogSelection& selection)
    : source_(std::move(source)), index_(std::move(index)), channels_(index_.table.channels()) {
  for (const auto& [id, channel] : index_.table.by_id()) channel_of_id_.emplace(id, channel_of_id_.size());
  select(selection);
  std::erase_if(index_.pieces, [&](const Piece& piece) { return !may_have_selected(piece); });
  std::stable_sort(index_.pieces.begin(), index_.pieces.end(),
                   [](const Piece& a, const Piece& b) { return a.start_time < b.start_time; });
}

void McapReader::select(const LogSelection& selection) {
  nothing_selected_ = selection.to_ns < 0 || selection.from_ns > selection.to_ns;
  from_ = static_cast<std::uint64_t>(std::max<std::int64_t>(selection.from_ns, 0));
  to_ = static_cast<std::uint64_t>(std::max<std::int64_t>(selection.to_ns, 0));
  const auto& topics = selection.topics;
  for (const Channel& channel : channels_) {
    const bool named = std::find(topics.begin(), topics.end(), channel.topic) != topics.end();
    selected_.push_back(static_cast<char>(topics.empty() || named));
  }
}

bool McapReader::may_have_selected(const Piece& piece) const {
  if (nothing_selected_ || piece.end_time < from_ || piece.start_time > to_) return false;
  if (piece.channel_ids.empty()) return true;
  return std::any_of(piece.channel_ids.begin(), piece.channel_ids.end(), [&](std::uint16_t id) {
    const auto channel = channel_of_id_.find(id);
    return channel == channel_of_id_.end() || selected_[channel->second] != 0;
  });
}

/// Lists the selected messages of a piece, and checks all. Returns a complaint, or an empty text.
std::string McapReader::find_places(const Piece& piece, Loaded& loaded) const {
  const auto on_definition = [&](Op op, std::string_view content) { return index_.table.find(op, content); };
  const auto on_message = [&](const MessageRecord& message) -> std::string {
    const auto channel = channel_of_id_.find(message.channel_id);
    if (channel == channel_of_id_.end()) {
      return fmt::format("a message belongs to channel {}, which is not defined", message.channel_id);
    }
    const std::uint64_t time = message.log_time;
    if (time < piece.start_time || time > piece.end_time) {
      return fmt::format("a message of the time {} ns lies outside of the times of its chunk", time);
    }
    if (!piece.channel_ids.empty() &&
        !std::binary_search(piece.channel_ids.begin(), piece.channel_ids.end(), message.channel_id)) {
      return fmt::format("a message belongs to channel {}, which the index of its chunk does not name",
                         message.channel_id);
    }
    if (selected_[channel->second] == 0 || time < from_ || time > to_) return {};
    const auto offset = message.data.data() - loaded.bytes.data();
    loaded.places.push_back({time, static_cast<std::uint32_t>(channel->second),
                             static_cast<std::uint32_t>(offset),
                             static_cast<std::uint32_t>(message.data.size())});
    return {};
  };
  return for_each_record(loaded.bytes, on_definition, on_message);
}

Outcome<McapReader::Loaded> McapReader::load(const Piece& piece) const {
  Loaded loaded;
  loaded.file_offset = piece.offset;
  const std::uint64_t room = std::min(largest_chunk_bytes, largest_loaded_bytes - held_bytes_);
  if (piece.is_chunk) {
    auto chunk = read_chunk(*source_, piece.offset, piece.length - head_bytes, room);
    if (!chunk) return pass_on(chunk);
    if (chunk->start_time != piece.start_time || chunk->end_time != piece.end_time) {
      return damaged(*source_, piece.offset, "the times of a chunk are not those that the summary states");
    }
    loaded.bytes = std::move(chunk->records);
  } else {
    if (piece.length > room) return damaged(*source_, piece.offset, "a message does not fit in memory");
    auto bytes = source_->read(piece.offset, piece.length);
    if (!bytes) return pass_on(bytes);
    loaded.bytes = std::move(*bytes);
  }
  const std::string complaint = find_places(piece, loaded);
  if (!complaint.empty()) return damaged(*source_, piece.offset, complaint);
  const auto earlier = [](const Place& a, const Place& b) { return a.time < b.time; };
  if (!std::is_sorted(loaded.places.begin(), loaded.places.end(), earlier)) {
    std::stable_sort(loaded.places.begin(), loaded.places.end(), earlier);
  }
  return loaded;
}

namespace {

/// The order of a heap with the earliest message in front; of equal times that of the file.
constexpr auto later = [](const auto& a, const auto& b) {
  return std::tuple(a->places[a->next].time, a->file_offset) >
         std::tuple(b->places[b->next].time, b->file_offset);
};

}  // namespace

/// Loads each piece that may have a message as early as the earliest that is loaded.
Status McapReader::load_due() {
  while (next_piece_ < index_.pieces.size()) {
    const Piece& piece = index_.pieces[next_piece_];
    if (!loaded_.empty() && loaded_.front()->places[loaded_.front()->next].time < piece.start_time) break;
    auto loaded = load(piece);
    if (!loaded) return pass_on(loaded);
    ++next_piece_;
    if (loaded->places.empty()) continue;
    held_bytes_ += loaded->held();
    if (held_bytes_ > largest_loaded_bytes) {
      return damaged(*source_, piece.offset,
                     fmt::format("more than {} bytes of chunks overlap in time", largest_loaded_bytes),
                     "sort the log by time");
    }
    loaded_.push_back(std::make_unique<Loaded>(std::move(*loaded)));
    std::push_heap(loaded_.begin(), loaded_.end(), later);
  }
  return {};
}

Outcome<std::optional<LogMessage>> McapReader::next() {
  if (!state_) return pass_on(std::as_const(state_));  // kept for the next call
  if (current_ && current_->next < current_->places.size()) {
    loaded_.push_back(std::move(current_));
    std::push_heap(loaded_.begin(), loaded_.end(), later);
  } else if (current_) {
    held_bytes_ -= current_->held();
    current_.reset();
  }
  state_ = load_due();
  if (!state_) return pass_on(std::as_const(state_));  // kept for the next call
  if (loaded_.empty()) return std::nullopt;
  std::pop_heap(loaded_.begin(), loaded_.end(), later);
  current_ = std::move(loaded_.back());
  loaded_.pop_back();
  const Place& place = current_->places[current_->next++];
  return LogMessage{place.channel, static_cast<std::int64_t>(place.time),
                    std::string_view(current_->bytes).substr(place.offset, place.length)};
}

}  // namespace mcap

bool is_mcap(std::string_view start) { return start.starts_with(mcap::magic); }

LogOpened open_mcap(std::unique_ptr<ByteSource> source, const LogSelection& selection) {
  auto index = mcap::read_index(*source);
  if (!index) return pass_on(index);
  return std::make_unique<mcap::McapReader>(std::move(source), std::move(*index), selection);
}

}  // namespace outrider
