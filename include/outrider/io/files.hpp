// Whole files in, whole files out.
//
// Reading: plain or gzip-compressed (told by the first two bytes, not by the name), never more than a
// stated number of bytes after decompression. Writing: to a temporary name in the same folder, then
// renamed, so that a reader sees the old file or the new one, and a failure leaves nothing behind.
// Errors: bad_input with the file in `where`. Thread rule: safe to call concurrently.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "outrider/core/outcome.hpp"

namespace outrider {

inline constexpr std::size_t largest_file_bytes = std::size_t{256} << 20;

/// The content of a file, decompressed. Refuses a missing file, a folder, one that may not be read,
/// damaged or truncated gzip data, and more than `limit_bytes`.
Outcome<std::string> read_file(const std::string& path, std::size_t limit_bytes = largest_file_bytes);

/// Replaces or makes the file. Its folder must exist; a path that names something other than a regular
/// file is refused. A symbolic link is followed.
Status write_file(const std::string& path, std::string_view content);

struct NamedContent {
  std::string path;
  std::string content;
};

/// The same for files that belong together: all lie on the disk under temporary names before the first is
/// renamed, so that a full disk or a folder that may not be written to changes none of them. They are renamed
/// in their order; put last the one that names the others.
Status write_files(const std::vector<NamedContent>& files);

}  // namespace outrider
