// A whole file under a temporary name, ready to take its own.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "outrider/core/outcome.hpp"

namespace outrider {

/// Holds a lock on the file while it lives: one that nobody holds a lock on was left by a writer that was
/// killed. The file is removed with the object unless it was renamed.
class TemporaryFile {
 public:
  /// Writes the content beside `path`, with the mode of the file that lies there, and waits for the disk.
  static Outcome<TemporaryFile> write(const std::string& path, std::string_view content);

  TemporaryFile(TemporaryFile&& other) noexcept;
  TemporaryFile& operator=(TemporaryFile&&) = delete;
  ~TemporaryFile();

  /// rename() to the final name, and nothing else: it may be called between fork() and _exit().
  [[nodiscard]] bool rename() const;
  /// Whether rename() was done, by this process or another; else the fault. `error` is what errno was.
  Status finish(int error);

 private:
  TemporaryFile() = default;

  std::string path_;        // as it was asked for
  std::string final_name_;  // with links resolved
  std::string name_;        // empty: nothing is left to remove
  int descriptor_ = -1;
};

/// Removes what writers left in a folder that were killed.
void remove_abandoned_files(const std::filesystem::path& folder);

}  // namespace outrider
