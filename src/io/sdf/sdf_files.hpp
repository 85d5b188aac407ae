// Finds and reads the files of a world, within bounds.
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "files/xml.hpp"

namespace outrider {

inline constexpr int newest_sdf_version = 112;  ///< 100 times the major version, and the minor one

/// Warnings by sentence, each with its first place and its count.
class SdfWarnings {
 public:
  void add(const std::string& where, const std::string& sentence);
  /// Adds that a file which the world names was not found.
  void add_missing(const std::string& where, const std::string& sentence);
  /// Returns the first of these, with its place; empty if all files were found.
  [[nodiscard]] const std::string& first_missing() const { return first_missing_; }
  [[nodiscard]] std::vector<std::string> sentences() const;

 private:
  struct Entry {
    std::string where;
    std::string sentence;
    std::size_t count = 0;
  };
  std::vector<Entry> entries_;                  // in the order of first appearance
  std::map<std::string, std::size_t> by_text_;  // sentence -> entry
  std::string first_missing_;
};

/// A parsed file. It stays where it is as long as the SdfFiles that returned it.
struct SdfFile {
  XmlDocument document;
  std::string name;
  std::string folder;  ///< may be empty
  int version = newest_sdf_version;
  std::size_t bytes = 0;
  std::size_t tags = 0;

  [[nodiscard]] bool is_urdf() const { return document.root().name() == std::string_view("robot"); }
  /// Returns the element of its first model; that of URDF is the root.
  [[nodiscard]] XmlElement model() const {
    return is_urdf() ? document.root() : document.root().child("model");
  }
};

/// The files of one world. Each is parsed once, and counts as often as it is included: at most 64 MiB,
/// 2 million tags, 20,000 includes.
class SdfFiles {
 public:
  /// Other models are searched in the folders of `model_path`.
  explicit SdfFiles(const std::string& model_path);

  /// Parses the text of a file.
  Outcome<const SdfFile*> parse(std::string_view text, const std::string& name);

  /// Returns the file that an <include> names: the file itself, that of a model folder, or a built-in floor
  /// or light. Null, with a warning, if there is none.
  Outcome<const SdfFile*> include(const SdfFile& by, XmlElement include);

  /// Resolves file://, model://, package://, an address of Gazebo Fuel or a plain path. Returns nothing if
  /// there is no such file or folder.
  [[nodiscard]] std::optional<std::string> find(std::string_view uri, const std::string& beside) const;

  SdfWarnings warnings;

 private:
  Outcome<const SdfFile*> admit(const SdfFile& file);
  std::optional<std::string> find_model(std::string_view uri, const std::string& beside);

  std::vector<std::string> models_;
  std::map<std::string, std::unique_ptr<SdfFile>, std::less<>> parsed_;  // by name
  std::map<std::string, std::optional<std::string>> found_;              // by folder and uri of an include
  std::size_t bytes_ = 0;
  std::size_t tags_ = 0;
  std::size_t includes_ = 0;
};

}  // namespace outrider
