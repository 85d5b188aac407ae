// Whole files in, whole files out.
//
// Reading: plain or gzip-compressed (told by the first two bytes, not by the name), never more than a
// stated number of bytes after decompression. confinement.hpp limits which files may be read.
//
// Writing: to temporary names in the same folder, then renamed, so that a reader sees the old files or the
// new ones. A failure, a full disk for one, leaves the old files as they were. What a writer leaves behind
// that was killed (.outrider-*.part) is removed by the next one that writes to the folder. A file that is
// replaced keeps its mode; a symbolic link is followed.
//
// Errors: bad_input with the file in `where`; cannot_write when the system fails while it writes, as on a
// full disk. Thread rule: safe to call concurrently.
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

/// True if there is something other than a folder that read_file() may open.
bool file_exists(const std::string& path);

/// Replaces or makes the file. Its folder must exist; a path that names something other than a regular
/// file is refused.
Status write_file(const std::string& path, std::string_view content);

struct NamedContent {
  std::string path;
  std::string content;
};

/// Writes files that belong together: all lie on the disk under temporary names before the first is
/// renamed. They are renamed in their order, so put the one that names the others last. A process that is
/// killed at any moment, even by SIGKILL, leaves all old files or all new ones: a short-lived process of its
/// own does the renaming.
Status write_files(const std::vector<NamedContent>& files);

}  // namespace outrider
