// Reads and writes whole files, and makes folders.
//
// Reading: files may be plain or gzip-compressed, which is detected by the first two bytes, not by the name.
// At most a stated number of bytes is read after decompression. confinement.hpp limits which files can be
// read.
//
// Writing: content goes to temporary files in the same folder, which are then renamed, so a reader sees the
// old files or the new ones. If writing fails, for example on a full disk, the old files stay unchanged.
// Temporary files of a killed writer (.outrider-*.part) are removed by the next writer to the same folder. A
// file that is replaced keeps its mode; symbolic links are followed.
//
// Faults: bad_input with the file in `where`; cannot_write if the system fails to write, for example on a
// full disk. Thread rule: safe to call concurrently.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "outrider/core/outcome.hpp"

namespace outrider {

inline constexpr std::size_t largest_file_bytes = std::size_t{256} << 20;

/// Returns the content of a file, decompressed. Faults: bad_input for a missing file, a folder, a file
/// without read permission, damaged or truncated gzip data, and more than `limit_bytes`.
Outcome<std::string> read_file(const std::string& path, std::size_t limit_bytes = largest_file_bytes);

/// Returns the SHA-256 of the bytes of a file, not decompressed, in constant memory. Faults: those of
/// read_file(), except for its size. O(bytes).
Outcome<std::string> file_hash(const std::string& path);

/// Returns true if the path exists, is not a folder, and read_file() is allowed to open it.
bool file_exists(const std::string& path);

/// Creates or replaces a file. Its folder must exist. Refuses a path that exists but is not a regular file.
Status write_file(const std::string& path, std::string_view content);

struct NamedContent {
  std::string path;
  std::string content;
};

/// A file that is complete under another name in the same folder.
struct FileToRename {
  std::string path;  ///< its name from now on
  std::string written_as;
};

/// Writes files that belong together. All of them are on the disk under temporary names before the first is
/// renamed. They are renamed in the given order, so put a file that refers to the others last. If the process
/// is killed at any moment, even by SIGKILL, either all old files or all new files remain, because a separate
/// short-lived process does the renaming.
/// `complete` files are renamed together with them, first.
Status write_files(const std::vector<NamedContent>& files, const std::vector<FileToRename>& complete = {});

/// Creates a folder and its parents. Fault: bad_input, whose sentence has the folder and the reason.
Status make_folder(const std::string& folder);

/// Refuses a folder that make_folder() would refuse. Changes nothing.
Status check_folder(const std::string& folder);

}  // namespace outrider
