#include "outrider/log/log.hpp"

#include <algorithm>

namespace outrider {

void Log::note_channel(std::string_view topic, const Channel& info) {
  numbers_.emplace(topic, infos_.size());
  infos_.push_back(info);
  for (LogSink* sink : sinks_) sink->add_channel(info);
}

void Log::note_message(std::size_t channel, std::int64_t time_ns, const void* message) {
  if (!kept_) order_.push_back(static_cast<std::uint32_t>(channel));
  end_ns_ = std::max(end_ns_, time_ns);
  if (sinks_.empty()) return;
  const std::string data = encode(MessageEncoding::cdr, *channels_[channel]->type, message);
  for (LogSink* sink : sinks_) sink->append(channel, time_ns, data);
}

void Log::add_sink(LogSink& sink) {
  sink.begin(*this);
  if (kept_) {
    for (const Channel& info : infos_) sink.add_channel(info);
    sinks_.push_back(&sink);
    return;
  }
  std::vector<std::size_t> sent(channels_.size(), 0);
  for (std::uint32_t added = 0; const std::uint32_t channel : order_) {
    if (channel == added) sink.add_channel(infos_[added++]);
    const auto [time_ns, message] = channels_[channel]->at(sent[channel]++);
    sink.append(channel, time_ns, encode(MessageEncoding::cdr, *channels_[channel]->type, message));
  }
  sinks_.push_back(&sink);
}

}  // namespace outrider
