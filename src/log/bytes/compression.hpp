// Compresses and decompresses.
//
// Bytes of strangers are decompressed safely: memory grows with what really comes out, and never beyond the
// stated size. Thread rule: safe to call concurrently.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "outrider/core/outcome.hpp"
#include "outrider/log/bytes/codec.hpp"

namespace outrider {

/// Returns the name of a codec in a file, such as "lz4"; empty for none.
std::string_view name_of(Codec codec);
/// Returns the codec of that name; nothing if there is none.
std::optional<Codec> codec_named(std::string_view name);

/// Returns the content, which must have exactly `size` bytes. Fault: bad_input if it has not, or the bytes
/// are damaged; `where` is empty.
Outcome<std::string> decompress(Codec codec, std::string_view bytes, std::uint64_t size);

/// Compresses with the default effort of the codec. The same bytes give the same bytes. Not for bz2.
std::string compress(Codec codec, std::string_view bytes);

}  // namespace outrider
