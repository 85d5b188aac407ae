// The compressions that log files use.
//
// Bytes of strangers are decompressed safely: memory grows with what really comes out, and never beyond the
// stated size. Thread rule: safe to call concurrently.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "outrider/core/outcome.hpp"

namespace outrider {

enum class Codec {
  none,
  lz4,   ///< the frame format: MCAP, and roslz4 of ROS 1 bags
  zstd,  ///< MCAP
  bz2,   ///< ROS 1 bags; only decompressed
};

/// Returns the content, which must have exactly `size` bytes. Fault: bad_input if it has not, or the bytes
/// are damaged; `where` is empty.
Outcome<std::string> decompress(Codec codec, std::string_view bytes, std::uint64_t size);

/// Compresses with the default effort of the codec. The same bytes give the same bytes. Not for bz2.
std::string compress(Codec codec, std::string_view bytes);

}  // namespace outrider
