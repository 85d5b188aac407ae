// Who may ask: what a request must show before it is looked at.
//
// A page of another site, open in the same browser, can send requests here. What it cannot do is choose the
// Origin and Host headers that the browser adds. So without a token the Host must name this machine's
// loopback, which ends DNS rebinding, and whatever changes something (and every WebSocket) must come from
// our own origin or from no page at all. With a token, every request to the interface must show it; then the
// Host may be any name under which the server is reached.
#pragma once

#include <chrono>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>

#include "message.hpp"

namespace outrider::server {

/// Equal, in a time that depends on the length of `given` alone.
bool same_secret(std::string_view given, std::string_view secret);

/// 127.0.0.0/8, ::1, or the name localhost.
bool is_loopback(std::string_view host);

/// The refusal of a request that must not be answered; nothing for one that may. `token` may be empty.
std::optional<Response> refusal(const Request& request, const std::string& token);

/// At most `burst` at once, and `per_second` in the long run. Thread rule: any thread may ask.
class RateLimit {
 public:
  using Clock = std::chrono::steady_clock;
  RateLimit(double per_second, double burst) : per_second_(per_second), burst_(burst), left_(burst) {}

  /// Takes one; false when there is none.
  bool take(Clock::time_point now);

 private:
  std::mutex mutex_;
  double per_second_;
  double burst_;
  double left_;
  std::optional<Clock::time_point> last_;
};

}  // namespace outrider::server
