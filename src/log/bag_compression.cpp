#include "bag_compression.hpp"

#include <bzlib.h>
#include <fmt/format.h>
#include <lz4frame.h>

#include <algorithm>
#include <memory>

namespace outrider {
namespace {

enum class Progress { more, ended, failed };

/// Calls step(bytes, offset, room), which writes at most `room` bytes at the offset and returns how many,
/// until the data ends.
template <class Step>
Outcome<std::string> grow_to(std::size_t size, std::string_view format, const Step& step) {
  constexpr std::size_t first_bytes = std::size_t{1} << 20;
  std::string bytes;
  std::size_t used = 0;
  Progress progress = Progress::more;
  while (progress == Progress::more) {
    if (used == bytes.size()) {
      if (used > size) break;
      bytes.resize(std::min(size + 1, std::max(first_bytes, 2 * used)));  // one more, to notice what is left
    }
    std::size_t written = bytes.size() - used;
    progress = step(bytes.data() + used, written);
    used += written;
    if (progress == Progress::more && written == 0) progress = Progress::failed;
  }
  if (progress == Progress::failed) return bad_input(fmt::format("its {} data is damaged", format));
  if (used != size) {
    return bad_input(
        fmt::format("its {} data does not hold the {} bytes that its header states", format, size));
  }
  bytes.resize(size);
  return bytes;
}

struct Bz2Stream {
  bz_stream state = {};
  bool open = false;

  Bz2Stream() { open = BZ2_bzDecompressInit(&state, 0, 0) == BZ_OK; }
  Bz2Stream(const Bz2Stream&) = delete;
  Bz2Stream& operator=(const Bz2Stream&) = delete;
  ~Bz2Stream() {
    if (open) BZ2_bzDecompressEnd(&state);
  }
};

struct FreeLz4 {
  void operator()(LZ4F_dctx* context) const { LZ4F_freeDecompressionContext(context); }
};

}  // namespace

Outcome<std::string> decompress_bz2(std::string_view packed, std::size_t size) {
  Bz2Stream stream;
  if (!stream.open) return bad_input("there is no memory left to decompress it");
  std::string input(packed);  // bzlib takes no constant
  stream.state.next_in = input.data();
  stream.state.avail_in = static_cast<unsigned>(input.size());
  return grow_to(size, "bz2", [&](char* to, std::size_t& room) {
    stream.state.next_out = to;
    stream.state.avail_out = static_cast<unsigned>(room);
    const int result = BZ2_bzDecompress(&stream.state);
    room -= stream.state.avail_out;
    if (result == BZ_STREAM_END) return Progress::ended;
    return result == BZ_OK ? Progress::more : Progress::failed;
  });
}

Outcome<std::string> decompress_lz4_frame(std::string_view packed, std::size_t size) {
  LZ4F_dctx* made = nullptr;
  if (LZ4F_isError(LZ4F_createDecompressionContext(&made, LZ4F_VERSION)) != 0) {
    return bad_input("there is no memory left to decompress it");
  }
  const std::unique_ptr<LZ4F_dctx, FreeLz4> context(made);
  return grow_to(size, "lz4", [&](char* to, std::size_t& room) {
    std::size_t taken = packed.size();
    const std::size_t hint = LZ4F_decompress(context.get(), to, &room, packed.data(), &taken, nullptr);
    packed.remove_prefix(taken);
    if (LZ4F_isError(hint) != 0) return Progress::failed;
    return hint == 0 ? Progress::ended : Progress::more;
  });
}

}  // namespace outrider
