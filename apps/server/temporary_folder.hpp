// A folder of our own under the system's, gone with the object.
#pragma once

#include <filesystem>
#include <string>
#include <utility>

#include "outrider/core/outcome.hpp"

namespace outrider::server {

/// Holds a lock on the folder while it lives: one that nobody holds a lock on was left by a server that was
/// killed.
class TemporaryFolder {
 public:
  /// Only we may look into it. Fault: bad_input when the system has no place for one.
  static Outcome<TemporaryFolder> make();
  /// Removes the folders of ours that a killed server left. Called when a server starts.
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
