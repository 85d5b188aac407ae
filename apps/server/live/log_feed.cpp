#include "live/log_feed.hpp"

#include <utility>

namespace outrider::server {

void LogFeed::unsubscribe(std::size_t channel) {
  waiting_.erase(channel);
  front_.channels.erase(channel);
  if (behind_) behind_->channels.erase(channel);
}

Outcome<std::uint64_t> LogFeed::next() {
  const auto front = front_.log.next();
  if (!front) return front;
  for (;;) {
    if (!behind_ && waiting_.empty()) return front;
    if (!behind_) behind_ = Reader{McapFollower(path_), std::exchange(waiting_, {})};
    const auto behind = behind_->log.next();
    if (!behind || behind_->log.position() != front_.log.position()) return behind;
    front_.channels.merge(behind_->channels);
    behind_.reset();
    if (*front > 0 || waiting_.empty()) return front;
  }
}

Status LogFeed::read(const std::function<void(const LogMessage&)>& on_message) {
  Reader& reader = behind_ ? *behind_ : front_;
  return reader.log.read([&](const LogMessage& message) {
    if (reader.channels.contains(message.channel)) on_message(message);
  });
}

}  // namespace outrider::server
