// FileLock: a file that only one process at a time writes to.
#pragma once

#include <optional>
#include <string>
#include <utility>

#include "outrider/core/outcome.hpp"

namespace outrider {

/// Holds an exclusive lock on a file during its lifetime. The system releases it if the process is killed.
/// Thread rule: one thread at a time.
class FileLock {
 public:
  /// Locks the file, and makes it if there is none; its content stays. Returns an empty lock if another
  /// process holds it. A relative path starts in the open folder `folder`, or else in the working directory.
  /// Fault: cannot_write with the path.
  static Outcome<FileLock> take(const std::string& path, std::optional<int> folder = {});

  FileLock() = default;
  FileLock(FileLock&& other) noexcept : descriptor_(std::exchange(other.descriptor_, -1)) {}
  FileLock& operator=(FileLock&& other) noexcept {
    std::swap(descriptor_, other.descriptor_);
    return *this;
  }
  ~FileLock();

  [[nodiscard]] bool held() const { return descriptor_ >= 0; }
  /// Returns the descriptor of the file, open for writing; -1 if it is not held.
  [[nodiscard]] int descriptor() const { return descriptor_; }

 private:
  explicit FileLock(int descriptor) : descriptor_(descriptor) {}

  int descriptor_ = -1;
};

}  // namespace outrider
