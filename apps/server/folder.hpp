// The files that are served: those under one folder, and nothing that a name or a link leads out of it to.
//
// A path has names between slashes. Names that begin with a dot, empty ones and those with a backslash, a
// control character or bytes that are no UTF-8 are refused before the disk is asked. Whatever is left is
// opened beneath the folder by the kernel (open_beneath()), so that no link leads out. What files of
// strangers name in turn is not looked at here: they are read in a confined process (reading.hpp). Thread
// rule: any thread may ask.
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

/// Stands at the beginning of every file that belongs to a saved scenario.
inline constexpr std::string_view saved_here = "Saved by the page of outrider serve.";
bool is_saved_here(std::string_view content);

/// Sentences speak of a file as people named it, not of where it lies on the disk.
std::string without_folder(std::string sentence, const std::filesystem::path& folder);
Fault without_folder(Fault fault, const std::filesystem::path& folder);

class Folder {
 public:
  /// Refuses what is no folder. `path` may be relative.
  static Outcome<Folder> open(const std::string& path);

  [[nodiscard]] const std::filesystem::path& root() const { return root_; }
  /// Its last name, for people.
  [[nodiscard]] std::string name() const { return root_.filename().string(); }

  /// Where the path of a request lies on the disk, with links resolved, for writing. Its last name need not
  /// exist.
  [[nodiscard]] Outcome<std::filesystem::path> resolve(std::string_view path) const;
  /// Whether a place on the disk lies under the folder once links are resolved.
  [[nodiscard]] bool holds(const std::filesystem::path& place) const;

  /// {"folder", "files": [{"path", "kind", "job", "bytes"}], "truncated"}: scenario, report, map or other,
  /// by name and first bytes. In order of their paths.
  [[nodiscard]] nlohmann::ordered_json list() const;
  /// The file, streamed.
  [[nodiscard]] Response read(std::string_view path) const;
  /// The content of a file beneath the folder.
  [[nodiscard]] Outcome<std::string> text(std::string_view path, std::size_t most_bytes) const;
  /// Writes a scenario, whole or not at all. `only_new` refuses to replace one.
  [[nodiscard]] Response save(std::string_view path, std::string_view text, bool only_new) const;

  /// Writes the files of a scenario, named as in requests and the scenario last: all or, but for a disk that
  /// fails while they are renamed, none. Files that are there already are replaced only when they begin as
  /// those that were saved in this way, and never through a link. `only_new` refuses to replace any.
  [[nodiscard]] Response save_scenario(std::string_view path, const std::vector<NamedContent>& files,
                                       bool only_new) const;

 private:
  Folder(std::filesystem::path root, int descriptor);
  [[nodiscard]] std::shared_ptr<const OpenFile> open_file(std::string_view path) const;
  [[nodiscard]] std::string first_bytes(std::string_view path, std::size_t count) const;

  struct Kind {
    const char* name;
    std::string job;
  };
  [[nodiscard]] Kind kind_of(const std::string& path) const;

  std::filesystem::path root_;
  std::shared_ptr<const int> descriptor_;  // of the root; closed with the last copy
};

}  // namespace outrider::server
