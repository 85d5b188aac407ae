// The files that are served: those under one folder, and nothing that a name or a link outside of it leads
// to.
//
// A path consists of names between slashes. Names that begin with a dot, are empty, or contain a backslash, a
// control character or invalid UTF-8 are refused without touching the disk. All others are opened beneath the
// folder by the kernel (open_beneath()), so no link leads out. Files that a stranger's file names in turn are
// not checked here: they are read in a confined process (reading.hpp). Thread rule: any thread may call.
#pragma once

#include <cstdint>
#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "message.hpp"
#include "outrider/core/outcome.hpp"
#include "outrider/io/files.hpp"

namespace outrider::server {

inline constexpr std::size_t most_listed_files = 5000;
inline constexpr int deepest_folder = 8;
inline constexpr std::size_t largest_served_bytes = std::size_t{64} << 20U;
inline constexpr std::size_t largest_saved_bytes = std::size_t{1} << 20U;

/// Marks the beginning of every file that belongs to a saved scenario.
inline constexpr std::string_view saved_here = "Saved by the page of outrider serve.";
bool is_saved_here(std::string_view content);

/// Removes the folder from file names, so that a sentence names a file as people do and not by its place on
/// the disk.
std::string without_folder(std::string sentence, const std::filesystem::path& folder);
Fault without_folder(Fault fault, const std::filesystem::path& folder);

class Folder {
 public:
  /// Opens a folder; refuses anything else. `path` may be relative.
  static Outcome<Folder> open(const std::string& path);

  [[nodiscard]] const std::filesystem::path& root() const { return root_; }
  /// Returns the last name of its path, for people.
  [[nodiscard]] std::string name() const { return root_.filename().string(); }

  /// Returns the place on the disk of a path in a request, for writing, with links resolved. Its last name
  /// need not exist.
  [[nodiscard]] Outcome<std::filesystem::path> resolve(std::string_view path) const;
  /// Returns true if a place on the disk lies under the folder once links are resolved.
  [[nodiscard]] bool holds(const std::filesystem::path& place) const;

  /// Returns {"folder", "files": [{"path", "kind", "job", "description", "bytes"}], "truncated"}, sorted by
  /// path. The kind is scenario, log, result, map or other, by name and first bytes. The description is the
  /// head comment of a scenario.
  [[nodiscard]] nlohmann::ordered_json list() const;
  /// Returns a response that streams the file: at most 64 MiB, and a log of any size.
  [[nodiscard]] Response read(std::string_view path) const;
  /// Returns the content of a file beneath the folder.
  [[nodiscard]] Outcome<std::string> text(std::string_view path, std::size_t most_bytes) const;
  /// Writes a scenario, completely or not at all. `only_new` refuses to replace one.
  [[nodiscard]] Response save(std::string_view path, std::string_view text, bool only_new) const;

  /// Writes the files of a scenario, named as in requests and the scenario last: all or none, unless the disk
  /// fails while they are renamed. Existing files are replaced only if they begin with the mark of saved
  /// files, and never through a link. `only_new` refuses to replace any.
  [[nodiscard]] Response save_scenario(std::string_view path, const std::vector<NamedContent>& files,
                                       bool only_new) const;

 private:
  Folder(std::filesystem::path root, int descriptor);
  [[nodiscard]] std::shared_ptr<const OpenFile> open_file(std::string_view path) const;
  [[nodiscard]] std::string first_bytes(std::string_view path, std::size_t count) const;

  struct Kind {
    const char* name;
    std::string job = {};
    std::string description = {};
  };
  [[nodiscard]] Kind kind_of(const std::string& path) const;

  std::filesystem::path root_;
  std::shared_ptr<const int> descriptor_;  // open root folder; closed with the last copy
};

}  // namespace outrider::server
