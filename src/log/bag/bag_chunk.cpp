#include "bag/bag_chunk.hpp"

#include <fmt/format.h>

#include "bytes/byte_reader.hpp"
#include "bytes/compression.hpp"
#include "outrider/core/text.hpp"

namespace outrider {
namespace {

Outcome<std::string> unpack(std::string packed, std::string_view compression, std::size_t size) {
  const auto codec = compression == "none" ? Codec::none : codec_named(compression);
  if (!codec || codec == Codec::zstd || compression.empty()) {
    return bad_input(
        fmt::format("it is compressed as '{}'; only none, bz2 and lz4 are known", excerpt(compression)));
  }
  if (codec == Codec::none && packed.size() == size) return packed;
  return decompress(*codec, packed, size);
}

}  // namespace

Outcome<std::string> unpack_bag_chunk(const ByteSource& source, const BagRecord& chunk) {
  const BagFields& fields = chunk.fields();
  const auto size = u32_field(fields, "size");
  if (chunk.op != BagOp::chunk || !size) return damaged(source, chunk.position, "this is not a chunk");
  if (*size > largest_bag_data) {
    return damaged(source, chunk.position,
                   fmt::format("a chunk states {} bytes; {} are the most", *size, largest_bag_data));
  }
  const bool slow = text_field(fields, "compression") == name_of(Codec::bz2);  // some 100 MB/s
  if (!source.may_unpack(std::uint64_t{*size} * (slow ? 4 : 1)))
    return unpacks_too_much(source, chunk.position);
  auto packed = source.read(chunk.data_position, chunk.data_length);
  if (!packed) return pass_on(packed);
  auto bytes = unpack(std::move(*packed), text_field(fields, "compression"), *size);
  if (!bytes) return damaged(source, chunk.position, "a chunk cannot be read: " + bytes.error().sentence);
  return bytes;
}

std::string for_each_in_chunk(std::string_view chunk,
                              const std::function<std::string(const BagChunkRecord&)>& visit) {
  ByteReader reader(chunk);
  while (!reader.at_end()) {
    const std::size_t start = reader.position();
    const auto fields = split_bag_fields(reader.text());
    const std::string_view data = reader.text();
    const auto op = fields ? bag_op(*fields) : std::nullopt;
    if (!reader.ok() || !op) return fmt::format("the record {} bytes into it is damaged", start);
    std::string wrong = visit({*op, *fields, data});
    if (!wrong.empty()) return fmt::format("the record {} bytes into it is wrong: {}", start, wrong);
  }
  return {};
}

}  // namespace outrider
