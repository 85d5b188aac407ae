// SimulatedLink: messages on their way over a link that delays, loses, repeats and reorders them.
//
// The same random stream and messages arrive in the same order at the same times.
#pragma once

#include <algorithm>
#include <deque>
#include <optional>
#include <utility>

#include "outrider/core/rng.hpp"
#include "outrider/motion/wheel_faults.hpp"

namespace outrider {

template <class Message>
class SimulatedLink {
 public:
  SimulatedLink(const LinkFaults& faults, const Rng& rng)
      : faults_(faults), rng_(rng), disorder_rng_(rng.child("disorder")) {}

  /// Sends a message. Times must not decrease.
  void send(double time_s, const Message& message) {
    const double delay_s = faults_.delay_s + faults_.jitter_s * rng_.uniform();
    if (sent_++ < faults_.lost || faults_.down(time_s)) return;
    const double arrives_s = std::max(in_order_s_, time_s + delay_s);
    if (happens(faults_.repeated)) put(arrives_s + later_s(), message);
    if (happens(faults_.reordered)) return put(arrives_s + later_s(), message);
    in_order_s_ = arrives_s;
    put(arrives_s, message);
  }
  /// Takes the next message that has arrived.
  std::optional<Message> take(double time_s) {
    constexpr double instant_s = 1e-9;
    if (messages_.empty() || messages_.front().first > time_s + instant_s) return std::nullopt;
    Message message = std::move(messages_.front().second);
    messages_.pop_front();
    return message;
  }

 private:
  bool happens(double chance) { return chance > 0.0 && disorder_rng_.uniform() < chance; }
  double later_s() { return faults_.later_s * disorder_rng_.uniform(); }
  void put(double arrives_s, const Message& message) {
    const auto after = std::ranges::upper_bound(messages_, arrives_s, {}, &Arriving::first);
    messages_.insert(after, {arrives_s, message});
  }

  using Arriving = std::pair<double, Message>;
  LinkFaults faults_;
  Rng rng_;
  Rng disorder_rng_;
  std::int64_t sent_ = 0;
  double in_order_s_ = 0.0;        // arrival of the newest message that keeps its place
  std::deque<Arriving> messages_;  // in the order of arrival
};

}  // namespace outrider
