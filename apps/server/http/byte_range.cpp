#include <fmt/format.h>

#include <algorithm>
#include <charconv>

#include "http/message.hpp"

namespace outrider::server {
namespace {

/// Returns a number of decimal digits; nothing for any other text.
std::optional<std::uintmax_t> number_of(std::string_view text) {
  std::uintmax_t number = 0;
  const char* const last = text.data() + text.size();
  const auto [end, error] = std::from_chars(text.data(), last, number);
  return error == std::errc{} && end == last ? std::optional(number) : std::nullopt;
}

/// Returns the part of a file that "bytes=first-last", "bytes=first-" or "bytes=-count" names, with count 0
/// if the file has no such part; nothing if the text is none of these.
std::optional<ByteRange> range_of(std::string_view text, std::uintmax_t size) {
  constexpr std::string_view unit = "bytes=";
  if (!text.starts_with(unit)) return std::nullopt;
  text.remove_prefix(unit.size());
  const std::size_t dash = text.find('-');
  if (dash == std::string_view::npos) return std::nullopt;
  const auto first = number_of(text.substr(0, dash)), last = number_of(text.substr(dash + 1));
  if (dash == 0) {
    if (!last) return std::nullopt;
    const std::uintmax_t count = std::min(*last, size);
    return ByteRange{size - count, count};
  }
  const bool open = dash + 1 == text.size();
  if (!first || (!open && (!last || *last < *first))) return std::nullopt;
  if (*first >= size) return ByteRange{};
  return ByteRange{*first, (open ? size - 1 : std::min(*last, size - 1)) - *first + 1};
}

}  // namespace

void apply_range(const Request& request, Response& response) {
  if (response.status != 200 || !response.file) return;
  response.headers.emplace_back("Accept-Ranges", "bytes");
  // Files have no validators, so a condition that names one never holds.
  if (request.method != "GET" || !request.header("if-range").empty()) return;
  const std::uintmax_t size = response.file->bytes();
  const auto range = range_of(request.header("range"), size);
  if (!range) return;
  if (range->count == 0) {
    response = error_response(416, "bad_input", fmt::format("the file has {} bytes", size), "Range");
    response.headers.emplace_back("Content-Range", fmt::format("bytes */{}", size));
    return;
  }
  response.status = 206;
  response.range = range;
  response.headers.emplace_back(
      "Content-Range", fmt::format("bytes {}-{}/{}", range->first, range->first + range->count - 1, size));
}

}  // namespace outrider::server
