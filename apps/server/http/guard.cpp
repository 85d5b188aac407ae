#include "http/guard.hpp"

#include <algorithm>

namespace outrider::server {
namespace {

/// Returns the host of "127.0.0.1:8080" or "[::1]:8080"; empty if anything but a port follows it.
std::string_view without_port(std::string_view host) {
  const bool bracketed = host.starts_with('[') && host.find(']') != std::string_view::npos;
  const std::string_view name = host.substr(0, bracketed ? host.find(']') + 1 : host.find(':'));
  const std::string_view port = host.substr(name.size());
  const bool is_port =
      port.size() > 1 && port[0] == ':' && port.find_first_not_of("0123456789", 1) == std::string_view::npos;
  if (!port.empty() && !is_port) return {};
  return bracketed ? name.substr(1, name.size() - 2) : name;
}

bool opens_socket(const Request& request) {
  return !request.header("sec-websocket-key").empty() || !request.header("upgrade").empty();
}

bool is_for_interface(const Request& request) {
  return request.path.starts_with("/api") || opens_socket(request);
}

/// Returns true for all but the files of the page, which are in memory.
bool costs(const Request& request) {
  return is_for_interface(request) || (request.method != "GET" && request.method != "HEAD");
}

/// Returns true if a page of another site sent the request. Browsers add Sec-Fetch-Site where they send no
/// Origin, as for images.
bool is_foreign(const Request& request) {
  const auto origin = request.headers.find("origin");
  const std::string own = "://" + request.header("host"), site = request.header("sec-fetch-site");
  if (origin == request.headers.end()) return site == "cross-site" || site == "same-site";
  return origin->second != "http" + own && origin->second != "https" + own;
}

}  // namespace

std::string token_shown(const Request& request) {
  const std::string authorization = request.header("authorization");
  constexpr std::string_view scheme = "Bearer ";
  if (authorization.starts_with(scheme)) return authorization.substr(scheme.size());
  return request.parameter("token");
}

bool same_secret(std::string_view given, std::string_view secret) {
  if (secret.empty()) return false;
  unsigned different = given.size() == secret.size() ? 0 : 1;
  for (std::size_t i = 0; i < given.size(); ++i) {
    const auto a = static_cast<unsigned char>(given[i]);
    const auto b = static_cast<unsigned char>(secret[i % secret.size()]);
    different |= static_cast<unsigned>(a ^ b);
  }
  return different == 0;
}

bool is_loopback(std::string_view host) {
  if (host == "localhost" || host == "::1") return true;
  const auto digits = [](char c) { return (c >= '0' && c <= '9') || c == '.'; };
  return host.starts_with("127.") && std::all_of(host.begin(), host.end(), digits);
}

std::optional<Response> refusal(const Request& request, const std::string& token) {
  const std::string host = request.header("host");
  if (token.empty() && !is_loopback(without_port(host))) {
    return error_response(403, "forbidden",
                          "the Host is not this machine; open the page at 127.0.0.1 or localhost", "Host");
  }
  const bool trusted = same_secret(token_shown(request), token);
  if (costs(request) && is_foreign(request) && !(trusted && opens_socket(request))) {
    return error_response(403, "forbidden", "the request comes from a page of another site", "Origin");
  }
  if (!token.empty() && is_for_interface(request) && !trusted) {
    return error_response(401, "unauthorized",
                          "the token is missing or wrong; send 'Authorization: Bearer TOKEN' or ?token=TOKEN",
                          "token");
  }
  return std::nullopt;
}

bool RateLimit::take(Clock::time_point now, double events) {
  const std::lock_guard lock(mutex_);
  const double passed_s = last_ ? std::chrono::duration<double>(now - *last_).count() : 0.0;
  last_ = now;
  left_ = std::min(burst_, left_ + per_second_ * passed_s);
  if (left_ < 1.0) return false;
  left_ -= events;
  return true;
}

}  // namespace outrider::server
