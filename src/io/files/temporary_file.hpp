// TemporaryFile: a complete file under a temporary name, which can be renamed to its final name.
// rename_all(): renames several files, or none.
// FolderLocks: of several writers, one renames at a time.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "outrider/core/outcome.hpp"
#include "outrider/io/files/open_folder.hpp"

namespace outrider {

/// A file to be written.
struct FilePlace {
  OpenFolder folder;
  std::string name;  ///< in the folder
  std::string path;  ///< as given by the caller, for faults
};

/// Returns the place of a file. Resolves a link of its name, so that the file is replaced and not the link;
/// but not in a process that is confined. Faults: bad_input if its folder does not exist, or if the path is
/// no name of a regular file.
Outcome<FilePlace> place_of(const std::string& path);

/// Holds a lock on the file during its lifetime. A temporary file without a lock was left by a killed writer.
/// The destructor removes the file unless it was renamed.
class TemporaryFile {
 public:
  /// Writes the content beside the place, with the mode of an existing file there, and waits for the disk.
  static Outcome<TemporaryFile> write(FilePlace place, std::string_view content);

  /// Takes a complete file as the temporary one, and waits for the disk.
  static Outcome<TemporaryFile> adopt(FilePlace place, const std::string& written);

  /// Makes a second name for the file that has the final name of `file` now; its rename() brings it back,
  /// unless the file system allows no second name. Returns nothing if there is no such file. Fault:
  /// cannot_write, for instance because the disk is full.
  static Outcome<std::optional<TemporaryFile>> keep_old(const TemporaryFile& file);

  TemporaryFile(TemporaryFile&& other) noexcept;
  TemporaryFile& operator=(TemporaryFile&&) = delete;
  ~TemporaryFile();

  /// Renames the file to its final name and does nothing else, so it may be called between fork() and
  /// _exit().
  [[nodiscard]] bool rename() const;
  /// Removes the file with the final name; as safe as rename().
  void remove_final() const;
  /// Returns a fault unless rename() has succeeded, in this process or another. `error` is the errno of
  /// rename().
  Status finish(int error);

 private:
  TemporaryFile(FilePlace place, OpenFolder from) : place_(std::move(place)), from_(std::move(from)) {}

  FilePlace place_;
  OpenFolder from_;   // the folder of the temporary file
  std::string name_;  // there; empty: there is no file to remove
  int descriptor_ = -1;
};

/// The old files that others replace, in their order.
using OldFiles = std::vector<std::optional<TemporaryFile>>;

/// Renames all files in order. At the first failure it brings the files back that `old` keeps, and removes
/// those that are new, so all or none are renamed; a second failure, or a file that could not be kept, may
/// leave a part of them. Returns 0, or errno. It makes only calls that are safe between fork() and _exit().
int rename_all(const std::vector<TemporaryFile>& files, const OldFiles& old);

/// Holds locks on folders, so that of two writers one renames all its files before the other renames any. A
/// forked process keeps them while it lives. A folder that cannot be locked is left out: a file system may
/// not know locks, and another program may lock the folder for reasons of its own.
class FolderLocks {
 public:
  /// Waits for other writers, for two seconds at most. The folders are in the order of their inodes, so two
  /// writers never wait for each other.
  explicit FolderLocks(const std::vector<OpenFolder>& folders);
  FolderLocks(const FolderLocks&) = delete;
  FolderLocks& operator=(const FolderLocks&) = delete;
  ~FolderLocks();

 private:
  std::vector<int> descriptors_;
};

/// Removes the temporary files of killed writers from a folder.
void remove_abandoned_files(const OpenFolder& folder);

}  // namespace outrider
