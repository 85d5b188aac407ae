// A folder of our own under the system's, gone with the object.
#pragma once

#include <filesystem>
#include <string>

#include "outrider/core/outcome.hpp"

namespace outrider::server {

class TemporaryFolder {
 public:
  /// Only we may look into it. Fault: bad_input when the system has no place for one.
  static Outcome<TemporaryFolder> make();

  TemporaryFolder(TemporaryFolder&& other) noexcept : path_(std::exchange(other.path_, {})) {}
  TemporaryFolder& operator=(TemporaryFolder&& other) noexcept {
    std::swap(path_, other.path_);
    return *this;
  }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;
  ~TemporaryFolder();

  [[nodiscard]] const std::filesystem::path& path() const { return path_; }

 private:
  explicit TemporaryFolder(std::filesystem::path path) : path_(std::move(path)) {}
  std::filesystem::path path_;
};

}  // namespace outrider::server
