// MessageFaults: messages that get lost or come late, with seeded random numbers.
#pragma once

#include <deque>
#include <optional>
#include <utility>
#include <vector>

#include "outrider/core/options.hpp"
#include "outrider/core/rng.hpp"

namespace outrider {

struct MessageFaults {
  double loss = 0.0;     ///< fraction of the messages that are lost
  double delay_s = 0.0;  ///< time by which the others come late
};
std::vector<Option> describe(MessageFaults& faults);

/// Messages on their way, in order.
template <class Message>
class FaultyLink {
 public:
  FaultyLink(const MessageFaults& faults, const Rng& rng) : faults_(faults), rng_(rng) {}

  /// Sends a message, unless it is lost.
  void push(double time_s, Message message) {
    if (faults_.loss > 0.0 && rng_.uniform() < faults_.loss) return;
    waiting_.emplace_back(time_s + faults_.delay_s, std::move(message));
  }
  /// Takes the first message that has come by that time.
  std::optional<Message> take(double time_s) {
    if (waiting_.empty() || waiting_.front().first > time_s) return std::nullopt;
    std::optional<Message> first = std::move(waiting_.front().second);
    waiting_.pop_front();
    return first;
  }

 private:
  MessageFaults faults_;
  Rng rng_;
  std::deque<std::pair<double, Message>> waiting_;
};

}  // namespace outrider
