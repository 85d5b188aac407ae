#include "mcap_chunk.hpp"

#include <optional>

#include "compression.hpp"
#include "mcap_encode.hpp"
#include "mcap_walk.hpp"

namespace outrider::mcap {
namespace {

std::optional<Codec> codec_of(std::string_view compression) {
  if (compression.empty()) return Codec::none;
  if (compression == "lz4") return Codec::lz4;
  if (compression == "zstd") return Codec::zstd;
  return std::nullopt;
}

/// Shows a name that may be anything.
std::string printable(std::string_view name) {
  std::string shown(name.substr(0, 32));
  for (char& c : shown) {
    if (c < ' ' || c > '~') c = '?';
  }
  return shown;
}

}  // namespace

Outcome<Chunk> read_chunk(const ByteSource& source, std::uint64_t offset, std::uint64_t length,
                          std::uint64_t most_bytes) {
  if (length > largest_record_bytes) {
    return damaged_mcap(
        source, offset,
        fmt::format("a chunk has {} bytes, more than the {} that are read", length, largest_record_bytes));
  }
  const auto bytes = source.read(offset, head_bytes + length);
  if (!bytes) return tl::unexpected<Fault>(bytes.error());
  ByteReader head(*bytes);
  if (head.number<std::uint8_t>() != static_cast<std::uint8_t>(Op::chunk) ||
      head.number<std::uint64_t>() != length) {
    return damaged_mcap(source, offset, "there is not the chunk that the summary names");
  }
  const auto chunk = decode_chunk(head.rest());
  if (!chunk) return damaged_mcap(source, offset, "a chunk is shorter than its fields");
  const auto codec = codec_of(chunk->compression);
  if (!codec) {
    return bad_input(
        fmt::format("at byte {}, the compression \"{}\" is unknown; write the log with zstd, lz4 or none",
                    offset, printable(chunk->compression)),
        source.name());
  }
  if (chunk->uncompressed_size > most_bytes) {
    return bad_input(
        fmt::format("at byte {}, a chunk of {} bytes does not fit in memory: {} are left for it; write the "
                    "log with smaller chunks, in the order of time",
                    offset, chunk->uncompressed_size, most_bytes),
        source.name());
  }
  auto records = decompress(*codec, chunk->records, chunk->uncompressed_size);
  if (!records)
    return damaged_mcap(source, offset, "a chunk cannot be decompressed: " + records.error().sentence);
  if (chunk->uncompressed_crc != 0 && crc32_of(*records) != chunk->uncompressed_crc) {
    return damaged_mcap(source, offset, "the checksum of a chunk is wrong");
  }
  return Chunk{chunk->start_time, chunk->end_time, std::move(*records)};
}

}  // namespace outrider::mcap
