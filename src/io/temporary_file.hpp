// TemporaryFile: a complete file under a temporary name, which can be renamed to its final name.
// FolderLocks: of several writers, one renames at a time.
#pragma once

#include <filesystem>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "outrider/core/outcome.hpp"

namespace outrider {

/// Holds a lock on the file during its lifetime. A temporary file without a lock was left by a killed writer.
/// The destructor removes the file unless it was renamed.
class TemporaryFile {
 public:
  /// Writes the content beside `path`, with the mode of an existing file there, and waits for the disk.
  static Outcome<TemporaryFile> write(const std::string& path, std::string_view content);

  /// Takes a complete file beside `path` as the temporary one, and waits for the disk.
  static Outcome<TemporaryFile> adopt(const std::string& path, const std::string& written);

  TemporaryFile(TemporaryFile&& other) noexcept;
  TemporaryFile& operator=(TemporaryFile&&) = delete;
  ~TemporaryFile();

  /// Renames the file to its final name and does nothing else, so it may be called between fork() and
  /// _exit().
  [[nodiscard]] bool rename() const;
  /// Returns a fault unless rename() has succeeded, in this process or another. `error` is the errno of
  /// rename().
  Status finish(int error);

 private:
  TemporaryFile() = default;

  std::string path_;        // as given by the caller
  std::string final_name_;  // with links resolved
  std::string name_;        // empty: there is no file to remove
  int descriptor_ = -1;
};

/// Holds locks on folders, so that of two writers one renames all its files before the other renames any. A
/// forked process keeps them while it lives. A folder that cannot be locked is left out: a file system may
/// not know locks, and another program may lock the folder for reasons of its own.
class FolderLocks {
 public:
  /// Waits for other writers, for two seconds at most. The folders are sorted, so two writers never wait for
  /// each other.
  explicit FolderLocks(const std::set<std::filesystem::path>& folders);
  FolderLocks(const FolderLocks&) = delete;
  FolderLocks& operator=(const FolderLocks&) = delete;
  ~FolderLocks();

 private:
  std::vector<int> descriptors_;
};

/// Removes the temporary files of killed writers from a folder.
void remove_abandoned_files(const std::filesystem::path& folder);

}  // namespace outrider
