#include "http/compression.hpp"

#include <zlib.h>

#include <algorithm>
#include <charconv>
#include <new>
#include <stdexcept>

namespace outrider::server {
namespace {

constexpr int fast = 1;  // the network is mostly that of one machine

std::string_view trimmed(std::string_view text) {
  while (!text.empty() && (text.front() == ' ' || text.front() == '\t')) text.remove_prefix(1);
  while (!text.empty() && (text.back() == ' ' || text.back() == '\t')) text.remove_suffix(1);
  return text;
}

std::string lower_case(std::string_view text) {
  std::string lower(text);
  std::ranges::transform(lower, lower.begin(),
                         [](char c) { return 'A' <= c && c <= 'Z' ? static_cast<char>(c + 32) : c; });
  return lower;
}

/// Returns the weight of a coding such as "gzip;q=0.5"; 1 if it states none.
double weight_of(std::string_view parameters) {
  const std::size_t at = parameters.find('=');
  if (at == std::string_view::npos || trimmed(parameters.substr(0, at)) != "q") return 1.0;
  const std::string_view text = trimmed(parameters.substr(at + 1));
  double weight = 0.0;
  std::from_chars(text.data(), text.data() + text.size(), weight);
  return weight;
}

/// Returns true for types whose bytes are not compressed: text, JSON, and images without compression.
bool compressible(std::string_view type) {
  return type.starts_with("text/") || type == "application/json" || type == "image/x-portable-graymap";
}

}  // namespace

bool accepts_gzip(std::string_view accept_encoding) {
  bool any = false;
  while (!accept_encoding.empty()) {
    const std::string_view coding = accept_encoding.substr(0, accept_encoding.find(','));
    accept_encoding.remove_prefix(std::min(accept_encoding.size(), coding.size() + 1));
    const std::size_t semicolon = std::min(coding.find(';'), coding.size());
    const std::string name = lower_case(trimmed(coding.substr(0, semicolon)));
    const bool wanted =
        semicolon == coding.size() || weight_of(lower_case(coding.substr(semicolon + 1))) > 0.0;
    if (name == "gzip" || name == "x-gzip") return wanted;
    if (name == "*") any = wanted;
  }
  return any;
}

std::string gzipped(std::string_view bytes) {
  z_stream stream{};
  constexpr int gzip_header = 16 + MAX_WBITS;
  constexpr int usual_memory = 8;
  if (deflateInit2(&stream, fast, Z_DEFLATED, gzip_header, usual_memory, Z_DEFAULT_STRATEGY) != Z_OK) {
    throw std::bad_alloc();
  }
  std::string packed(deflateBound(&stream, static_cast<uLong>(bytes.size())), '\0');
  stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(bytes.data()));  // zlib does not modify it
  stream.avail_in = static_cast<uInt>(bytes.size());
  stream.next_out = reinterpret_cast<Bytef*>(packed.data());
  stream.avail_out = static_cast<uInt>(packed.size());
  const int state = deflate(&stream, Z_FINISH);
  packed.erase(stream.total_out);
  deflateEnd(&stream);
  if (state != Z_STREAM_END) throw std::runtime_error("zlib does not come to an end");
  packed.shrink_to_fit();
  return packed;
}

void compress(const Request& request, Response& response, ByteBudget& memory) {
  const auto has = [&](std::string_view name) {
    return std::ranges::any_of(response.headers, [&](const auto& header) { return header.first == name; });
  };
  const std::uintmax_t bytes = response.file ? response.file->bytes() : response.body.size();
  if (has("Content-Encoding") || !compressible(response.type) || bytes < least_compressed_bytes) return;
  response.headers.emplace_back("Vary", "Accept-Encoding");
  if (response.range || !accepts_gzip(request.header("accept-encoding"))) return;
  const auto lease = memory.take(2 * static_cast<std::size_t>(bytes));
  if (!lease) return;
  if (response.file) {
    response.body = gzipped(response.file->part(0, static_cast<std::size_t>(bytes)));
    response.file = nullptr;
    std::erase_if(response.headers, [](const auto& header) { return header.first == "Accept-Ranges"; });
  } else {
    response.body = gzipped(response.body);
  }
  response.headers.emplace_back("Content-Encoding", "gzip");
}

}  // namespace outrider::server
