// The hash of a file as it is on the disk, of any size, in constant memory.
#pragma once

#include <string>

#include "outrider/core/outcome.hpp"

namespace outrider {

/// Returns the SHA-256 of the bytes of a file, not decompressed. Faults: those of read_file(), except for its
/// size. O(bytes).
Outcome<std::string> file_hash(const std::string& path);

}  // namespace outrider
