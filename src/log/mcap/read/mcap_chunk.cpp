#include "mcap/read/mcap_chunk.hpp"

#include <optional>

#include "bytes/compression.hpp"
#include "mcap/mcap_encode.hpp"
#include "mcap/read/mcap_walk.hpp"
#include "outrider/core/text.hpp"

namespace outrider::mcap {
Outcome<Chunk> read_chunk(const ByteSource& source, std::uint64_t offset, std::uint64_t length,
                          std::uint64_t most_bytes) {
  if (length > largest_record_bytes) {
    return damaged(
        source, offset,
        fmt::format("a chunk has {} bytes, more than the {} that are read", length, largest_record_bytes));
  }
  const auto bytes = source.read(offset, head_bytes + length);
  if (!bytes) return pass_on(bytes);
  ByteReader head(*bytes);
  if (head.number<std::uint8_t>() != static_cast<std::uint8_t>(Op::chunk) ||
      head.number<std::uint64_t>() != length) {
    return damaged(source, offset, "there is not the chunk that the summary names");
  }
  const auto chunk = decode_chunk(head.rest());
  if (!chunk) return damaged(source, offset, "a chunk is shorter than its fields");
  const auto codec = codec_named(chunk->compression);
  if (!codec || codec == Codec::bz2) {
    return damaged(source, offset,
                   fmt::format("the compression \"{}\" is unknown", excerpt(chunk->compression)),
                   "write the log with zstd, lz4 or none");
  }
  if (chunk->uncompressed_size > most_bytes) {
    return damaged(source, offset,
                   fmt::format("a chunk of {} bytes does not fit in memory: {} are left for it",
                               chunk->uncompressed_size, most_bytes),
                   "write the log with smaller chunks, in the order of time");
  }
  if (!source.may_unpack(chunk->uncompressed_size)) return unpacks_too_much(source, offset);
  auto records = decompress(*codec, chunk->records, chunk->uncompressed_size);
  if (!records) return damaged(source, offset, "a chunk cannot be decompressed: " + records.error().sentence);
  if (chunk->uncompressed_crc != 0 && crc32_of(*records) != chunk->uncompressed_crc) {
    return damaged(source, offset, "the checksum of a chunk is wrong");
  }
  return Chunk{chunk->start_time, chunk->end_time, std::move(*records)};
}

}  // namespace outrider::mcap
