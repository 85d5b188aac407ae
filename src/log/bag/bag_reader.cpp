// ROS 1 bags: chunks in the order of their first times, messages merged out of those that overlap.
#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>

#include "bag/bag_chunk.hpp"
#include "bag/bag_contents.hpp"
#include "formats.hpp"

namespace outrider {
namespace {

constexpr std::size_t most_bytes_held = std::size_t{512} << 20;
constexpr std::size_t most_messages_held = std::size_t{1} << 23;

/// A message of an open chunk.
struct BagEntry {
  std::int64_t time_ns = 0;
  std::uint32_t offset = 0;  ///< of the data in the unpacked chunk
  std::uint32_t length = 0;
  std::uint32_t channel = 0;
};

struct OpenChunk {
  const BagChunkInfo* info = nullptr;
  std::vector<BagEntry> entries;  ///< the selected ones, by time
  std::size_t next = 0;           ///< index of the first entry that is left
  std::string bytes;              ///< unpacked; empty when it was let go to save memory
  std::uint64_t last_use = 0;

  [[nodiscard]] bool at_end() const { return next == entries.size(); }
  [[nodiscard]] std::int64_t time_ns() const { return entries[next].time_ns; }
};

class BagReader : public LogReader {
 public:
  BagReader(std::unique_ptr<ByteSource> source, BagContents contents, const LogSelection& selection)
      : source_(std::move(source)), contents_(std::move(contents)), selection_(selection) {
    const std::set<std::string> topics(selection.topics.begin(), selection.topics.end());
    for (const Channel& channel : contents_.channels) {
      selected_.push_back(topics.empty() || topics.contains(channel.topic));
    }
    for (const BagChunkInfo& chunk : contents_.chunks) {
      if (is_needed(chunk)) waiting_.push_back(&chunk);
    }
    std::stable_sort(waiting_.begin(), waiting_.end(),
                     [](const auto* a, const auto* b) { return a->first_ns < b->first_ns; });
  }

  [[nodiscard]] const std::vector<Channel>& channels() const override { return contents_.channels; }
  [[nodiscard]] std::string cut_short() const override { return contents_.cut_short; }
  [[nodiscard]] double progress() const override {
    return waiting_.empty() ? 1.0 : static_cast<double>(opened_) / static_cast<double>(waiting_.size());
  }
  Outcome<std::optional<LogMessage>> next() override;

 private:
  [[nodiscard]] bool is_needed(const BagChunkInfo& chunk) const {
    if (chunk.last_ns < selection_.from_ns || chunk.first_ns > selection_.to_ns) return false;
    return std::any_of(chunk.connections.begin(), chunk.connections.end(), [&](std::uint32_t connection) {
      return selected_[contents_.channel_of.at(connection)];
    });
  }
  Status open_chunk(const BagChunkInfo& info);
  Outcome<std::vector<BagEntry>> list_entries(const BagChunkInfo& info, std::string_view chunk) const;
  Outcome<std::string> unpack(const BagChunkInfo& info) const;
  void hold(OpenChunk& chunk, std::string bytes);

  std::unique_ptr<ByteSource> source_;
  BagContents contents_;
  LogSelection selection_;
  std::vector<bool> selected_;                ///< by channel
  std::vector<const BagChunkInfo*> waiting_;  ///< by their first times
  std::size_t opened_ = 0;                    ///< how many of them have been opened
  /// Open chunks in the order of their next messages; those with equal times in the order of the file.
  using OpenChunks = std::multimap<std::pair<std::int64_t, std::uint64_t>, OpenChunk>;
  OpenChunks open_;
  OpenChunks::node_type current_;  ///< the chunk of the message that next() returned, which is a view of it
  std::size_t messages_held_ = 0;
  std::size_t bytes_held_ = 0;
  std::uint64_t uses_ = 0;
};

Outcome<std::string> BagReader::unpack(const BagChunkInfo& info) const {
  auto record = read_bag_record(*source_, info.position);
  if (!record) return pass_on(record);
  return unpack_bag_chunk(*source_, *record);
}

Outcome<std::vector<BagEntry>> BagReader::list_entries(const BagChunkInfo& info,
                                                       std::string_view chunk) const {
  std::vector<BagEntry> entries;
  const std::string wrong = for_each_in_chunk(chunk, [&](const BagChunkRecord& record) -> std::string {
    if (record.op == BagOp::connection) return {};
    if (record.op != BagOp::message) return "it does not belong into a chunk";
    const auto time = time_field(record.fields, "time");
    const auto connection = u32_field(record.fields, "conn");
    if (!time || !connection) return "a message has no time or no connection";
    const auto channel = contents_.channel_of.find(*connection);
    if (channel == contents_.channel_of.end()) return fmt::format("connection {} is unknown", *connection);
    if (*time < info.first_ns || *time > info.last_ns) {
      return "the time of a message is not among those that the index states (\"rosbag reindex\" makes a new "
             "one)";
    }
    const bool wanted =
        selected_[channel->second] && *time >= selection_.from_ns && *time <= selection_.to_ns;
    if (wanted) {
      entries.push_back({*time, static_cast<std::uint32_t>(record.data.data() - chunk.data()),
                         static_cast<std::uint32_t>(record.data.size()),
                         static_cast<std::uint32_t>(channel->second)});
    }
    return {};
  });
  if (!wrong.empty()) return damaged(*source_, info.position, "a chunk cannot be read: " + wrong);
  std::stable_sort(entries.begin(), entries.end(),
                   [](const BagEntry& a, const BagEntry& b) { return a.time_ns < b.time_ns; });
  return entries;
}

/// Keeps the bytes of a chunk, and lets others go that were not used for the longest time.
void BagReader::hold(OpenChunk& chunk, std::string bytes) {
  bytes_held_ += bytes.size();
  chunk.bytes = std::move(bytes);
  chunk.last_use = ++uses_;
  while (bytes_held_ > most_bytes_held) {
    OpenChunk* oldest = nullptr;
    for (auto& [key, other] : open_) {
      const bool may_go = &other != &chunk && !other.bytes.empty();
      if (may_go && (oldest == nullptr || other.last_use < oldest->last_use)) oldest = &other;
    }
    if (oldest == nullptr) return;
    bytes_held_ -= oldest->bytes.size();
    std::string().swap(oldest->bytes);  // an assignment would keep the memory
  }
}

Status BagReader::open_chunk(const BagChunkInfo& info) {
  auto bytes = unpack(info);
  if (!bytes) return pass_on(bytes);
  auto entries = list_entries(info, *bytes);
  if (!entries) return pass_on(entries);
  if (entries->empty()) return {};
  messages_held_ += entries->size();
  if (messages_held_ > most_messages_held) {
    return damaged(
        *source_, info.position,
        fmt::format("the chunks overlap in time so much that more than {} messages have to be sorted",
                    most_messages_held),
        "\"rosbag filter\" writes them in their order");
  }
  const std::pair key(entries->front().time_ns, info.position);
  hold(open_.emplace(key, OpenChunk{&info, std::move(*entries), 0, {}, 0})->second, std::move(*bytes));
  return {};
}

Outcome<std::optional<LogMessage>> BagReader::next() {
  if (current_ && current_.mapped().at_end()) {
    messages_held_ -= current_.mapped().entries.size();
    bytes_held_ -= current_.mapped().bytes.size();
    current_ = {};
  } else if (current_) {
    current_.key().first = current_.mapped().time_ns();
    open_.insert(std::move(current_));
  }
  while (opened_ < waiting_.size() &&
         (open_.empty() || waiting_[opened_]->first_ns <= open_.begin()->first.first)) {
    if (auto done = open_chunk(*waiting_[opened_]); !done) return pass_on(done);
    ++opened_;
  }
  if (open_.empty()) return std::optional<LogMessage>{};
  current_ = open_.extract(open_.begin());
  OpenChunk& chunk = current_.mapped();
  if (chunk.bytes.empty()) {
    auto bytes = unpack(*chunk.info);
    if (!bytes) return pass_on(bytes);
    hold(chunk, std::move(*bytes));
  }
  chunk.last_use = ++uses_;
  const BagEntry& entry = chunk.entries[chunk.next++];
  if (std::size_t{entry.offset} + entry.length > chunk.bytes.size()) {
    return damaged(*source_, chunk.info->position, "the file changed while it was read");
  }
  return LogMessage{entry.channel, entry.time_ns,
                    std::string_view(chunk.bytes).substr(entry.offset, entry.length)};
}

}  // namespace

LogOpened open_bag(std::unique_ptr<ByteSource> source, const LogSelection& selection) {
  auto contents = read_bag_contents(*source);
  if (!contents) return pass_on(contents);
  return std::make_unique<BagReader>(std::move(source), std::move(*contents), selection);
}

}  // namespace outrider
