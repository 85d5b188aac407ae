#include "bytes/compression.hpp"

#include <bzlib.h>
#include <fmt/format.h>
#include <lz4frame.h>
#include <zstd.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <memory>
#include <new>
#include <span>
#include <stdexcept>

namespace outrider {
namespace {

/// The progress of a codec after a part of the input.
struct Progress {
  std::size_t consumed = 0;
  std::size_t produced = 0;
  bool ended = false;       ///< at the end of a frame
  std::string damage = {};  ///< empty if there is none
};

/// Room for the content: as much as is likely, at most as much as is stated.
std::size_t first_room(std::size_t compressed, std::size_t size) {
  constexpr std::size_t least = 65536;
  constexpr std::size_t usual_ratio = 8;
  return std::min(size, std::max(least, usual_ratio * compressed));
}

/// Decompresses piece by piece; `step(input, output) -> Progress` is the codec.
template <class Step>
Outcome<std::string> decompress_stepwise(std::string_view bytes, std::size_t size, Step step) {
  std::string content(first_room(bytes.size(), size), '\0');
  std::size_t filled = 0;
  for (bool ended = bytes.empty(); !bytes.empty() || !ended;) {
    char spill = 0;  // takes the first byte too many
    const bool full = filled == size;
    if (!full && filled == content.size()) content.resize(std::min(size, 2 * content.size()));
    const std::span<char> room = full ? std::span(&spill, 1) : std::span(content).subspan(filled);
    const Progress progress = step(bytes, room);
    if (!progress.damage.empty()) return bad_input(progress.damage);
    if (full && progress.produced > 0) {
      return bad_input(fmt::format("its content is longer than the stated {} bytes", size));
    }
    if (progress.consumed == 0 && progress.produced == 0 && !progress.ended)
      return bad_input("it ends too early");
    bytes.remove_prefix(progress.consumed);
    filled += progress.produced;
    ended = progress.ended;
  }
  if (filled != size)
    return bad_input(fmt::format("its content has {} bytes, not the stated {}", filled, size));
  return content;
}

Outcome<std::string> decompress_lz4(std::string_view bytes, std::size_t size) {
  LZ4F_dctx* made = nullptr;
  if (LZ4F_isError(LZ4F_createDecompressionContext(&made, LZ4F_VERSION)) != 0) throw std::bad_alloc();
  const std::unique_ptr<LZ4F_dctx, LZ4F_errorCode_t (*)(LZ4F_dctx*)> context(made,
                                                                             LZ4F_freeDecompressionContext);
  return decompress_stepwise(bytes, size, [&](std::string_view in, std::span<char> out) {
    std::size_t consumed = in.size();
    std::size_t produced = out.size();
    const std::size_t left =
        LZ4F_decompress(context.get(), out.data(), &produced, in.data(), &consumed, nullptr);
    if (LZ4F_isError(left) != 0) {
      return Progress{.damage = fmt::format("its lz4 data are damaged ({})", LZ4F_getErrorName(left))};
    }
    return Progress{consumed, produced, left == 0};
  });
}

Outcome<std::string> decompress_zstd(std::string_view bytes, std::size_t size) {
  const std::unique_ptr<ZSTD_DCtx, std::size_t (*)(ZSTD_DCtx*)> context(ZSTD_createDCtx(), ZSTD_freeDCtx);
  if (!context) throw std::bad_alloc();
  return decompress_stepwise(bytes, size, [&](std::string_view in, std::span<char> out) {
    ZSTD_inBuffer input{in.data(), in.size(), 0};
    ZSTD_outBuffer output{out.data(), out.size(), 0};
    const std::size_t left = ZSTD_decompressStream(context.get(), &output, &input);
    if (ZSTD_isError(left) != 0) {
      return Progress{.damage = fmt::format("its zstd data are damaged ({})", ZSTD_getErrorName(left))};
    }
    return Progress{input.pos, output.pos, left == 0};
  });
}

unsigned part_of(std::size_t count) {
  constexpr std::size_t most = std::size_t{1} << 30U;
  return static_cast<unsigned>(std::min(count, most));
}

Outcome<std::string> decompress_bz2(std::string_view bytes, std::size_t size) {
  bz_stream stream{};
  if (BZ2_bzDecompressInit(&stream, 0, 0) != BZ_OK) throw std::bad_alloc();
  const std::unique_ptr<bz_stream, int (*)(bz_stream*)> ending(&stream, BZ2_bzDecompressEnd);
  return decompress_stepwise(bytes, size, [&](std::string_view in, std::span<char> out) {
    const unsigned available = part_of(in.size());
    const unsigned room = part_of(out.size());
    stream.next_in = const_cast<char*>(in.data());  // bzlib only reads from it
    stream.avail_in = available;
    stream.next_out = out.data();
    stream.avail_out = room;
    const int result = BZ2_bzDecompress(&stream);
    if (result == BZ_SEQUENCE_ERROR) return Progress{.damage = "bytes follow the end of its bz2 data"};
    if (result != BZ_OK && result != BZ_STREAM_END) {
      return Progress{.damage = fmt::format("its bz2 data are damaged (code {})", result)};
    }
    return Progress{available - stream.avail_in, room - stream.avail_out, result == BZ_STREAM_END};
  });
}

std::string compress_lz4(std::string_view bytes) {
  std::string out(LZ4F_compressFrameBound(bytes.size(), nullptr), '\0');
  const std::size_t count = LZ4F_compressFrame(out.data(), out.size(), bytes.data(), bytes.size(), nullptr);
  if (LZ4F_isError(count) != 0) throw std::runtime_error(LZ4F_getErrorName(count));
  out.resize(count);
  return out;
}

std::string compress_zstd(std::string_view bytes) {
  std::string out(ZSTD_compressBound(bytes.size()), '\0');
  const std::size_t count =
      ZSTD_compress(out.data(), out.size(), bytes.data(), bytes.size(), ZSTD_CLEVEL_DEFAULT);
  if (ZSTD_isError(count) != 0) throw std::runtime_error(ZSTD_getErrorName(count));
  out.resize(count);
  return out;
}

/// The names of the codecs in the order of their numbers.
constexpr std::array<std::string_view, 4> names = {"", "lz4", "zstd", "bz2"};

}  // namespace

std::string_view name_of(Codec codec) { return names.at(static_cast<std::size_t>(codec)); }

std::optional<Codec> codec_named(std::string_view name) {
  const auto found = std::find(names.begin(), names.end(), name);
  if (found == names.end()) return std::nullopt;
  return static_cast<Codec>(found - names.begin());
}

Outcome<std::string> decompress(Codec codec, std::string_view bytes, std::uint64_t size) {
  const auto stated = static_cast<std::size_t>(size);
  if (codec == Codec::lz4) return decompress_lz4(bytes, stated);
  if (codec == Codec::zstd) return decompress_zstd(bytes, stated);
  if (codec == Codec::bz2) return decompress_bz2(bytes, stated);
  if (bytes.size() != size) {
    return bad_input(fmt::format("its content has {} bytes, not the stated {}", bytes.size(), size));
  }
  return std::string(bytes);
}

std::string compress(Codec codec, std::string_view bytes) {
  if (codec == Codec::lz4) return compress_lz4(bytes);
  if (codec == Codec::zstd) return compress_zstd(bytes);
  if (codec == Codec::bz2) throw std::invalid_argument("bz2 is only decompressed");
  return std::string(bytes);
}

}  // namespace outrider
