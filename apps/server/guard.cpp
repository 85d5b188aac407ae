#include "guard.hpp"

#include <algorithm>

namespace outrider::server {
namespace {

/// Removes the port: "127.0.0.1:8080" -> "127.0.0.1"; "[::1]:8080" -> "::1".
std::string_view without_port(std::string_view host) {
  if (host.starts_with('[')) return host.substr(1, std::min(host.find(']'), host.size()) - 1);
  return host.substr(0, host.find(':'));
}

bool opens_socket(const Request& request) {
  return !request.header("sec-websocket-key").empty() || !request.header("upgrade").empty();
}

bool changes_something(const Request& request) {
  return opens_socket(request) || (request.method != "GET" && request.method != "HEAD");
}

/// Returns the token of the request: `Authorization: Bearer T`, else ?token=T.
std::string token_shown(const Request& request) {
  const std::string authorization = request.header("authorization");
  constexpr std::string_view scheme = "Bearer ";
  if (authorization.starts_with(scheme)) return authorization.substr(scheme.size());
  return request.parameter("token");
}

}  // namespace

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
  const auto origin = request.headers.find("origin");
  const bool ours = origin == request.headers.end() || origin->second == "http://" + host ||
                    origin->second == "https://" + host;
  const bool trusted = same_secret(token_shown(request), token);
  if (changes_something(request) && !ours && !(trusted && opens_socket(request))) {
    return error_response(403, "forbidden", "the request comes from a page of another site", "Origin");
  }
  const bool guarded = !token.empty() && (request.path.starts_with("/api") || opens_socket(request));
  if (guarded && !trusted) {
    return error_response(401, "unauthorized",
                          "the token is missing or wrong; send 'Authorization: Bearer TOKEN' or ?token=TOKEN",
                          "token");
  }
  return std::nullopt;
}

bool RateLimit::take(Clock::time_point now) {
  const std::lock_guard lock(mutex_);
  const double passed_s = last_ ? std::chrono::duration<double>(now - *last_).count() : 0.0;
  last_ = now;
  left_ = std::min(burst_, left_ + per_second_ * passed_s);
  if (left_ < 1.0) return false;
  left_ -= 1.0;
  return true;
}

}  // namespace outrider::server
