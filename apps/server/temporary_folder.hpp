// A private folder under the system's temporary folder, removed with the object.
#pragma once

#include <filesystem>
#include <string>
#include <utility>

#include "outrider/core/outcome.hpp"

namespace outrider::server {

/// Holds a lock on the folder while the object exists. A folder without a lock was left by a server that was
/// killed.
class TemporaryFolder {
 public:
  /// Creates a folder that only this user can access. Fault: bad_input if the system has no place for one.
  static Outcome<TemporaryFolder> make();
  /// Removes folders that killed servers of this user left. Call it when a server starts.
  static void remove_abandoned();

  TemporaryFolder(TemporaryFolder&& other) noexcept
      : path_(std::exchange(other.path_, {})), descriptor_(std::exchange(other.descriptor_, -1)) {}
  TemporaryFolder& operator=(TemporaryFolder&& other) noexcept {
    std::swap(path_, other.path_);
    std::swap(descriptor_, other.descriptor_);
    return *this;
  }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;
  ~TemporaryFolder();

  [[nodiscard]] const std::filesystem::path& path() const { return path_; }

 private:
  TemporaryFolder(std::filesystem::path path, int descriptor)
      : path_(std::move(path)), descriptor_(descriptor) {}
  std::filesystem::path path_;
  int descriptor_ = -1;
};

}  // namespace outrider::server
