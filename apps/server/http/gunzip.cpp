#include "http/gunzip.hpp"

#include <zlib.h>

#include <array>
#include <stdexcept>

namespace outrider::server {

std::string gunzipped(std::string_view bytes) {
  z_stream stream{};
  constexpr int gzip_header = 16 + MAX_WBITS;
  if (inflateInit2(&stream, gzip_header) != Z_OK) throw std::runtime_error("zlib does not start");
  stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(bytes.data()));  // zlib does not modify it
  stream.avail_in = static_cast<uInt>(bytes.size());
  std::string text;
  std::array<char, 65536> buffer{};
  int state = Z_OK;
  while (state == Z_OK) {
    stream.next_out = reinterpret_cast<Bytef*>(buffer.data());
    stream.avail_out = static_cast<uInt>(buffer.size());
    state = inflate(&stream, Z_NO_FLUSH);
    text.append(buffer.data(), buffer.size() - stream.avail_out);
  }
  inflateEnd(&stream);
  if (state != Z_STREAM_END) throw std::runtime_error("a file of the page is no gzip");
  return text;
}

}  // namespace outrider::server
