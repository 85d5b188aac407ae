// Decompresses the chunks of ROS 1 bags.
//
// The result has exactly the stated size: less or more is a fault. Memory grows with what comes out of the
// data, so a false size costs nothing, and data that would expand for ever ends at the stated size.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include "outrider/core/outcome.hpp"

namespace outrider {

/// Fault: bad_input with a sentence and without a place, which the caller knows.
Outcome<std::string> decompress_bz2(std::string_view packed, std::size_t size);

/// Decompresses LZ4 frames (what ROS calls roslz4). Fault: as of decompress_bz2().
Outcome<std::string> decompress_lz4_frame(std::string_view packed, std::size_t size);

}  // namespace outrider
