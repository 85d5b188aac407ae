// A viewer of the page with somebody who listens, and the log of a mission for it.
#pragma once

#include <mutex>

#include "app_fixture.hpp"
#include "outrider/log/mcap/mcap_writer.hpp"

namespace outrider::server {

/// Writes down what a viewer is sent.
class Listener {
 public:
  explicit Listener(App& app) : viewer_(app.live().open()) {
    thread_ = std::thread([this] {
      viewer_->serve([this](FrameKind kind, const std::string& data) {
        const std::lock_guard lock(mutex_);
        if (kind == FrameKind::binary) {
          log_ += data;
          largest_frame_ = std::max(largest_frame_, data.size());
        } else {
          told_.push_back(Json::parse(data));
          log_bytes_.push_back(log_.size());
        }
        return true;
      });
    });
  }
  Listener(const Listener&) = delete;
  Listener& operator=(const Listener&) = delete;
  ~Listener() {
    viewer_->close();
    thread_.join();
  }

  bool say(const std::string& text) { return viewer_->receive(text); }
  bool watch(const std::string& run, std::uint64_t from = 0, std::uint64_t log = 0) {
    return say(Json{{"type", "watch"}, {"run", run}, {"from", from}, {"log", log}}.dump());
  }
  /// Returns what was told, up to the first message of that type.
  std::vector<Json> until(const std::string& type) {
    std::vector<Json> all;
    EXPECT_TRUE(testing::eventually([&] {
      const std::lock_guard lock(mutex_);
      const auto found = std::find_if(told_.begin(), told_.end(),
                                      [&](const Json& message) { return message["type"] == type; });
      if (found != told_.end()) all = {told_.begin(), found + 1};
      return found != told_.end();
    })) << "nothing of type "
        << type;
    return all;
  }
  /// Returns the bytes of the log that came before the first message of that type.
  std::string log_until(const std::string& type) {
    const std::size_t place = until(type).size() - 1;
    const std::lock_guard lock(mutex_);
    return log_.substr(0, log_bytes_.at(place));
  }
  std::size_t largest_frame() {
    const std::lock_guard lock(mutex_);
    return largest_frame_;
  }

 private:
  std::shared_ptr<Viewer> viewer_;
  std::mutex mutex_;
  std::vector<Json> told_;
  std::vector<std::size_t> log_bytes_;  // that came before each message
  std::string log_;
  std::size_t largest_frame_ = 0;
  std::thread thread_;
};

/// Returns the log of a mission as it writes it: `count` messages on /a at 1, 2, 3, ... ns, with a message on
/// /b before the first and one after the last.
inline std::string log_of(int count) {
  std::string bytes;
  auto writer =
      McapWriter::begin(make_string_sink(bytes), {.compression = Codec::none, .chunk_bytes = 65536});
  const auto channel = [&](const char* topic) {
    return writer->add_channel({topic, "std_msgs/msg/String", "cdr", "ros2msg", "string data\n", {}});
  };
  const std::size_t b = channel("/b"), a = channel("/a");
  EXPECT_TRUE(writer->write(b, 0, "first"));
  for (int i = 1; i <= count; ++i) EXPECT_TRUE(writer->write(a, i, std::to_string(i)));
  EXPECT_TRUE(writer->write(b, count + 1, "last"));
  EXPECT_TRUE(writer->finish());
  return bytes;
}

}  // namespace outrider::server
