// The files that are served: those under one folder, and nothing that a name or a link outside of it leads
// to.
//
// A path consists of names between slashes. Names that begin with a dot, are empty, or contain a backslash, a
// control character or invalid UTF-8 are refused without touching the disk. All others are looked up beneath
// the open folder by the kernel (open_folder.hpp), which follows no link. The content of a file is read in a
// confined process (reading.hpp). Thread rule: any thread may call.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "http/message.hpp"
#include "outrider/core/outcome.hpp"
#include "outrider/io/files/files.hpp"
#include "outrider/io/files/open_folder.hpp"

namespace outrider::server {

inline constexpr std::size_t largest_served_bytes = std::size_t{64} << 20U;
inline constexpr std::size_t largest_saved_bytes = std::size_t{1} << 20U;

/// Marks the beginning of every file that belongs to a saved scenario.
inline constexpr std::string_view saved_here = "Saved by the page of outrider serve.";
bool is_saved_here(std::string_view content);

/// Returns true for a name that a path may consist of.
bool good_name(std::string_view name);
/// Returns the path if all of its names are good. Fault: bad_input.
Outcome<std::string> checked_path(std::string_view path);

class Folder {
 public:
  /// Opens a folder; refuses anything else. `path` may be relative.
  static Outcome<Folder> open(const std::string& path);

  /// Returns the folder, to be opened, written and listed.
  [[nodiscard]] const OpenFolder& gate() const { return gate_; }
  /// Returns where it was when it was opened, for people.
  [[nodiscard]] const std::string& path() const { return path_; }
  /// Returns the last name of that, for people.
  [[nodiscard]] std::string name() const { return path_.substr(path_.rfind('/') + 1); }

  /// Returns true if there is a regular file of that path.
  [[nodiscard]] bool has_file(std::string_view path) const { return open_file(path) != nullptr; }
  /// Returns a response that streams the file: at most 64 MiB, and a log of any size.
  [[nodiscard]] Response read(std::string_view path) const;
  /// Returns the content of a file beneath the folder.
  [[nodiscard]] Outcome<std::string> text(std::string_view path, std::size_t most_bytes) const;
  /// Writes a scenario, completely or not at all. `only_new` refuses to replace one.
  [[nodiscard]] Response save(std::string_view path, std::string_view text, bool only_new) const;

  /// Writes the files of a scenario, which lie beside it, the scenario last: all or none, unless the disk
  /// fails while they are renamed. Existing files are replaced only if they begin with the mark of saved
  /// files. `only_new` refuses to replace any.
  [[nodiscard]] Response save_scenario(std::string_view path, const std::vector<NamedContent>& files,
                                       bool only_new) const;

 private:
  Folder(OpenFolder gate, std::string path) : gate_(std::move(gate)), path_(std::move(path)) {}
  [[nodiscard]] std::shared_ptr<const OpenFile> open_file(std::string_view path) const;
  [[nodiscard]] std::optional<Response> write(const std::vector<NamedContent>& files, bool only_new,
                                              bool only_saved_here, bool& replaces) const;

  OpenFolder gate_;
  std::string path_;
};

}  // namespace outrider::server
