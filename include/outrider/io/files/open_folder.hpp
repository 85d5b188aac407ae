// OpenFolder: the gate through which the files of a folder are opened, written, renamed and removed while
// others may exchange it, or what is in it, for links.
//
// It holds a descriptor of the folder. The kernel looks every name up from there (openat2 with
// RESOLVE_BENEATH and RESOLVE_NO_SYMLINKS), at the moment of use: "..", absolute paths and links, wherever on
// the way, are refused. Needs Linux 5.6 or newer. Copies share the descriptor. Thread rule: any thread may
// call.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "outrider/core/outcome.hpp"
#include "outrider/io/files/files.hpp"

namespace outrider {

struct FileStatus {
  bool is_folder = false;
  bool is_file = false;  ///< a regular one
  std::uint64_t device = 0;
  std::uint64_t inode = 0;
  std::int64_t changed_ns = 0;  ///< Unix time of the last change of its content
  std::uint64_t bytes = 0;

  bool operator==(const FileStatus&) const = default;
};

class OpenFolder {
 public:
  /// Opens the folder that a user names; links are followed. Fault: bad_input.
  static Outcome<OpenFolder> open(const std::string& path);

  /// Opens a folder beneath this one; "" is this one. Fault: bad_input.
  [[nodiscard]] Outcome<OpenFolder> folder(const std::string& path) const;
  /// Opens a folder in this one, and makes it if there is none. Fault: cannot_write.
  [[nodiscard]] Outcome<OpenFolder> make_folder(const std::string& name) const;

  /// Opens a regular file beneath it for reading; returns its descriptor, which the caller closes. Never
  /// blocks. Fault: bad_input.
  [[nodiscard]] Outcome<int> open_file(const std::string& path) const;
  /// Makes a file in it for reading and writing, which only this user may read; returns its descriptor, which
  /// the caller closes. Returns -1 and sets errno if there is one of that name or the system fails.
  [[nodiscard]] int create_file(const std::string& name) const;
  /// Writes files into it as write_files() does; each path is a name in this folder. A link of that name is
  /// replaced, not followed.
  [[nodiscard]] Status write(const std::vector<NamedContent>& files) const;
  /// Renames a file in it; what has the new name is replaced. Returns false and sets errno on failure.
  [[nodiscard]] bool rename(const std::string& from, const std::string& to) const;
  /// Removes a file or a link in it, or a folder with the files in that; one that has folders stays.
  void remove(const std::string& name) const;

  /// Returns the names in it, sorted; at most `most` of them.
  [[nodiscard]] std::vector<std::string> names(std::size_t most) const;
  /// Returns what a name in it stands for; nothing if there is no such name. Links are not followed.
  [[nodiscard]] std::optional<FileStatus> status(const std::string& name) const;
  [[nodiscard]] FileStatus status() const;
  [[nodiscard]] int descriptor() const { return *descriptor_; }

 private:
  explicit OpenFolder(int descriptor);
  std::shared_ptr<const int> descriptor_;  // closed with the last copy
};

}  // namespace outrider
