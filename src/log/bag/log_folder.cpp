// Bags that rosbag2 split into several files. Their times may overlap a little, so they are merged: a file is
// opened when the messages come to its first time, and closed at its end.
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <list>

#include "bytes/byte_source.hpp"
#include "formats.hpp"

namespace outrider {
namespace {

namespace fs = std::filesystem;

/// Compares names with the numbers in them as numbers: run_2 comes before run_10.
bool number_order(std::string_view a, std::string_view b) {
  const auto digits = [](std::string_view text) {
    return std::min(text.find_first_not_of("0123456789"), text.size());
  };
  while (!a.empty() && !b.empty()) {
    std::size_t in_a = digits(a);
    std::size_t in_b = digits(b);
    const bool numbers = in_a > 0 && in_b > 0;
    if (numbers) {
      const std::string_view number_a = a.substr(std::min(a.find_first_not_of('0'), in_a), std::string::npos);
      const std::string_view number_b = b.substr(std::min(b.find_first_not_of('0'), in_b), std::string::npos);
      const std::string_view left = number_a.substr(0, digits(number_a));
      const std::string_view right = number_b.substr(0, digits(number_b));
      if (left != right) return std::pair(left.size(), left) < std::pair(right.size(), right);
    } else {
      if (a[0] != b[0]) return a[0] < b[0];
      in_a = in_b = 1;
    }
    a.remove_prefix(in_a);
    b.remove_prefix(in_b);
  }
  return a.size() < b.size();
}

/// rosbag2 can compress each message by itself, which only its metadata says.
Status check_metadata(const std::string& folder) {
  auto source = open_file_source(folder + "/metadata.yaml");
  if (!source) {
    return bad_input(
        "it is a folder without metadata.yaml, so no ROS 2 bag; name a log, or the folder of one", folder);
  }
  constexpr std::uint64_t most_bytes = 16U << 20;
  auto text = (*source)->read(0, std::min((*source)->size(), most_bytes));
  if (!text) return pass_on(text);
  constexpr std::string_view key = "compression_mode:";
  const std::size_t at = text->find(key);
  if (at == std::string::npos) return {};
  std::string_view mode = std::string_view(*text).substr(at + key.size());
  mode = mode.substr(0, mode.find('\n'));
  if (mode.find_first_of("mMfF") == std::string_view::npos) return {};  // message or file; else none
  return bad_input("it is compressed by rosbag2; \"ros2 bag convert\" writes it without compression", folder);
}

Outcome<std::vector<std::string>> list_logs(const std::string& folder) {
  std::vector<std::string> names;
  std::error_code error;
  for (fs::directory_iterator entry(folder, error), end; !error && entry != end; entry.increment(error)) {
    const std::string ending = entry->path().extension().string();
    if (ending == ".db3" || ending == ".mcap") names.push_back(entry->path().filename().string());
  }
  if (error) return bad_input(fmt::format("it cannot be read: {}", error.message()), folder);
  if (names.empty()) return bad_input("it is a folder without a .db3 or .mcap file; name a log", folder);
  std::sort(names.begin(), names.end());
  std::stable_sort(names.begin(), names.end(), number_order);
  return names;
}

/// A file of the folder: what is known of it while it is closed.
struct LogPart {
  std::string path;
  std::size_t number = 0;               ///< in the order of names
  std::vector<std::size_t> channel_of;  ///< index in the channels of the folder, by its own
  std::int64_t first_ns = 0;            ///< time of its first selected message
};

/// A file that is open, with its next message.
struct OpenPart {
  const LogPart* part = nullptr;
  std::unique_ptr<LogReader> reader;
  LogMessage message;
};

/// Adds a channel of a file, unless a channel of this topic and type is there; returns its index.
std::size_t merge_channel(std::vector<Channel>& channels, const Channel& channel) {
  const auto known = std::find_if(channels.begin(), channels.end(), [&](const Channel& other) {
    return other.topic == channel.topic && other.type == channel.type && other.encoding == channel.encoding;
  });
  const auto index = static_cast<std::size_t>(known - channels.begin());
  if (known == channels.end()) channels.push_back(channel);
  return index;
}

class FolderReader : public LogReader {
 public:
  explicit FolderReader(LogSelection selection) : selection_(std::move(selection)) {}

  /// Opens each file once, for its channels and its first time.
  Status survey(const std::string& folder, const std::vector<std::string>& names);
  [[nodiscard]] const std::vector<Channel>& channels() const override { return channels_; }
  [[nodiscard]] std::string cut_short() const override { return cut_short_; }
  [[nodiscard]] double progress() const override {
    return parts_.empty() ? 1.0 : static_cast<double>(opened_) / static_cast<double>(parts_.size());
  }
  Outcome<std::optional<LogMessage>> next() override;

 private:
  Status open_part(const LogPart& part);
  std::list<OpenPart>::iterator earliest();

  LogSelection selection_;
  std::vector<Channel> channels_;
  std::string cut_short_;
  std::vector<LogPart> parts_;  ///< those with selected messages, by their first times
  std::size_t opened_ = 0;
  std::list<OpenPart> open_;
  OpenPart* last_ = nullptr;  ///< whose message was returned
};

Status FolderReader::survey(const std::string& folder, const std::vector<std::string>& names) {
  for (const std::string& name : names) {
    LogPart part{(fs::path(folder) / name).string(), parts_.size(), {}, 0};
    auto reader = open_log(part.path, selection_);
    if (!reader) return pass_on(reader);
    for (const Channel& channel : (*reader)->channels()) {
      part.channel_of.push_back(merge_channel(channels_, channel));
    }
    auto first = (*reader)->next();
    if (!first) return pass_on(first);
    const std::string cut = (*reader)->cut_short();
    if (!cut.empty()) cut_short_ += (cut_short_.empty() ? "" : " ") + cut;
    const std::optional<LogMessage>& message = *first;
    if (!message) continue;
    part.first_ns = message->time_ns;
    parts_.push_back(std::move(part));
  }
  std::stable_sort(parts_.begin(), parts_.end(),
                   [](const LogPart& a, const LogPart& b) { return a.first_ns < b.first_ns; });
  return {};
}

std::list<OpenPart>::iterator FolderReader::earliest() {
  return std::min_element(open_.begin(), open_.end(), [](const OpenPart& a, const OpenPart& b) {
    return std::pair(a.message.time_ns, a.part->number) < std::pair(b.message.time_ns, b.part->number);
  });
}

Status FolderReader::open_part(const LogPart& part) {
  auto reader = open_log(part.path, selection_);
  if (!reader) return pass_on(reader);
  auto first = (*reader)->next();
  if (!first) return pass_on(first);
  const std::optional<LogMessage>& message = *first;
  if (!message || message->time_ns != part.first_ns ||
      (*reader)->channels().size() != part.channel_of.size()) {
    return bad_input("the file changed while it was read", part.path);
  }
  open_.push_back({&part, std::move(*reader), *message});
  return {};
}

Outcome<std::optional<LogMessage>> FolderReader::next() {
  if (last_ != nullptr) {
    auto following = last_->reader->next();
    if (!following) return pass_on(following);
    if (const std::optional<LogMessage>& message = *following) {
      last_->message = *message;
    } else {
      open_.remove_if([&](const OpenPart& part) { return &part == last_; });
    }
    last_ = nullptr;
  }
  auto part = earliest();
  while (opened_ < parts_.size() &&
         (part == open_.end() || parts_[opened_].first_ns <= part->message.time_ns)) {
    if (auto done = open_part(parts_[opened_]); !done) return pass_on(done);
    ++opened_;
    part = earliest();
  }
  if (part == open_.end()) return std::optional<LogMessage>{};
  last_ = &*part;
  LogMessage message = part->message;
  message.channel = part->part->channel_of.at(message.channel);
  return message;
}

}  // namespace

LogOpened open_log_folder(const std::string& path, const LogSelection& selection) {
  if (auto plain = check_metadata(path); !plain) return pass_on(plain);
  auto names = list_logs(path);
  if (!names) return pass_on(names);
  auto reader = std::make_unique<FolderReader>(selection);
  if (auto done = reader->survey(path, *names); !done) return pass_on(done);
  return reader;
}

}  // namespace outrider
