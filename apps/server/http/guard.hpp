// Access control: what a request must show before it is processed.
//
// A page of another site, open in the same browser, can send requests here, but it cannot choose the Origin,
// Sec-Fetch-Site and Host headers that the browser adds. So without a token the Host must name this machine's
// loopback, which prevents DNS rebinding. Every request that costs anything, which is each but those for the
// files of the page, must come from our own origin or from no page at all. With a token, every request to the
// interface and every WebSocket must show it; then the Host may be any name under which the server is
// reached, and a WebSocket may come from any page, since a page that knows the token was given it.
#pragma once

#include <chrono>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>

#include "http/message.hpp"

namespace outrider::server {

/// Compares two strings in a time that depends on the length of `given` alone.
bool same_secret(std::string_view given, std::string_view secret);

/// Returns true for 127.0.0.0/8, ::1 and the name localhost.
bool is_loopback(std::string_view host);

/// Returns the token of the request: `Authorization: Bearer T`, else ?token=T; empty if it shows none.
std::string token_shown(const Request& request);

/// Returns the refusal of a request that must not be answered; nothing if it may be. `token` may be empty.
std::optional<Response> refusal(const Request& request, const std::string& token);

/// Limits events to at most `burst` at once, and `per_second` in the long run. Thread rule: any thread may
/// call.
class RateLimit {
 public:
  using Clock = std::chrono::steady_clock;
  RateLimit(double per_second, double burst) : per_second_(per_second), burst_(burst), left_(burst) {}

  /// Takes events, by default one; returns false and takes none if not even one is left.
  bool take(Clock::time_point now, double events = 1.0);

 private:
  std::mutex mutex_;
  double per_second_;
  double burst_;
  double left_;
  std::optional<Clock::time_point> last_;
};

/// Limits the wrong tokens of an address.
struct GuessLimit : RateLimit {
  GuessLimit() : RateLimit(5.0, 20.0) {}
};

}  // namespace outrider::server
