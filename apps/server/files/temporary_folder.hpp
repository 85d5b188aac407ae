// A private folder under the system's temporary folder, removed with the object.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <utility>

#include "outrider/core/outcome.hpp"

namespace outrider::server {

/// Holds a lock on a folder of this user. The kernel releases it when the process ends, however it ends.
class FolderLock {
 public:
  /// Returns nothing if the folder belongs to another user, is locked, is a link, or is gone.
  static std::optional<FolderLock> take(const std::filesystem::path& folder);

  FolderLock(FolderLock&& other) noexcept : descriptor_(std::exchange(other.descriptor_, -1)) {}
  FolderLock& operator=(FolderLock&& other) noexcept {
    std::swap(descriptor_, other.descriptor_);
    return *this;
  }
  FolderLock(const FolderLock&) = delete;
  FolderLock& operator=(const FolderLock&) = delete;
  ~FolderLock();

 private:
  explicit FolderLock(int descriptor) : descriptor_(descriptor) {}
  int descriptor_;
};

/// Holds a lock while the object exists, on the folder around its own: write_files() waits where a folder is
/// locked. A folder without a lock was left by a server that was killed.
class TemporaryFolder {
 public:
  /// Creates a folder that only this user can access. Fault: bad_input if the system has no place for one.
  static Outcome<TemporaryFolder> make();
  /// Removes folders that killed servers of this user left. Call it when a server starts.
  static void remove_abandoned();

  TemporaryFolder(TemporaryFolder&& other) noexcept
      : path_(std::exchange(other.path_, {})), lock_(std::move(other.lock_)) {}
  TemporaryFolder& operator=(TemporaryFolder&& other) noexcept {
    std::swap(path_, other.path_);
    std::swap(lock_, other.lock_);
    return *this;
  }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;
  ~TemporaryFolder();

  [[nodiscard]] const std::filesystem::path& path() const { return path_; }

 private:
  TemporaryFolder(std::filesystem::path path, FolderLock lock)
      : path_(std::move(path)), lock_(std::move(lock)) {}
  std::filesystem::path path_;
  FolderLock lock_;
};

}  // namespace outrider::server
