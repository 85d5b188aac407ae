#include "output/live_log.hpp"

#include <chrono>
#include <condition_variable>
#include <cstdlib>
#include <string_view>

#include "watcher.hpp"

namespace outrider::cli {
namespace {

constexpr std::chrono::milliseconds period{200};
constexpr std::size_t viewer_chunk_bytes = std::size_t{64} << 10U;  // what a viewer holds in memory

std::string_view variable(const char* name) {
  const char* const text = std::getenv(name);
  return text == nullptr ? "" : text;
}

}  // namespace

LiveLog::LiveLog() {
  const int descriptor = watched_descriptor("OUTRIDER_LIVE");
  // Lines of progress between the bytes of a log would damage it.
  if (descriptor < 0 || variable("OUTRIDER_LIVE") == variable("OUTRIDER_PROGRESS")) return;
  auto output = make_descriptor_sink(descriptor, "OUTRIDER_LIVE");
  if (!output) return;
  auto writer =
      McapWriter::begin(std::move(*output), {.compression = Codec::none, .chunk_bytes = viewer_chunk_bytes});
  if (!writer) return;
  sink_.emplace(std::move(*writer));
  flusher_ = std::jthread([this](const std::stop_token& stop) { flush_often(stop); });
}

LiveLog::~LiveLog() {
  flusher_ = {};
  if (sink_) (void)sink_->writer().flush();
}

void LiveLog::flush_often(const std::stop_token& stop) {
  std::mutex mutex;
  std::condition_variable_any never;
  std::unique_lock lock(mutex);
  while (!stop.stop_requested()) {
    never.wait_for(lock, stop, period, [] { return false; });
    const std::lock_guard guard(mutex_);
    (void)sink_->writer().flush();  // a reader that is gone is nobody's fault
  }
}

void LiveLog::add_channel(const Channel& channel) {
  const std::lock_guard lock(mutex_);
  sink_->add_channel(channel);
}

void LiveLog::append(std::size_t channel, std::int64_t time_ns, std::string_view data) {
  const std::lock_guard lock(mutex_);
  sink_->append(channel, time_ns, data);
}

void LiveLog::finish(const std::string& result) {
  flusher_ = {};
  (void)sink_->writer().flush();
  (void)sink_->writer().attach("run.json", "application/json", result);
  (void)sink_->finish();
}

}  // namespace outrider::cli
