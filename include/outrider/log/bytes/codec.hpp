// The compressions that log files use.
#pragma once

namespace outrider {

enum class Codec {
  none,
  lz4,   ///< the frame format: MCAP, and roslz4 of ROS 1 bags
  zstd,  ///< MCAP
  bz2,   ///< ROS 1 bags; only decompressed
};

}  // namespace outrider
