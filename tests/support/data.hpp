// Helpers for tests that read files: published data, folders that vanish, seeded damage.
#pragma once

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

#include "outrider/core/rng.hpp"

namespace outrider::test {

/// Published data is no part of the project: tests that need it skip where it is absent.
inline std::filesystem::path data_folder() {
  if (const char* folder = std::getenv("OUTRIDER_DATA")) return folder;
  auto source = std::filesystem::path(__FILE__).parent_path() / ".." / ".." / "..";
  return (source / ".." / "shared" / "data").lexically_normal();
}

/// The folder of the published scenarios.
inline const std::string scenarios = std::string(OUTRIDER_SOURCE_DIR) + "/scenarios/";

#define OUTRIDER_NEEDS_DATA(path) \
  if (!std::filesystem::exists(path)) GTEST_SKIP() << (path).string() << " is absent; set OUTRIDER_DATA"

/// A folder of its own for one test, removed with it.
struct Folder {
  std::filesystem::path path;

  Folder() {
    std::string name = (std::filesystem::temp_directory_path() / "outrider_io_XXXXXX").string();
    path = ::mkdtemp(name.data());
  }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;
  ~Folder() { std::filesystem::remove_all(path); }

  std::string write(const std::string& name, const std::string& content) const {
    std::filesystem::create_directories((path / name).parent_path());
    std::filesystem::remove(path / name);  // some file systems flush what is truncated
    std::ofstream(path / name, std::ios::binary) << content;
    return (path / name).string();
  }
};

inline std::string bytes_of(const std::filesystem::path& path) {
  std::ostringstream content;
  content << std::ifstream(path, std::ios::binary).rdbuf();
  return content.str();
}

/// The text cut, with bytes changed, doubled and taken away.
inline std::string damaged(std::string text, Rng& rng) {
  if (text.empty()) return text;
  if (rng.below(4) == 0) text.resize(rng.below(text.size()) + 1);
  for (std::uint64_t i = rng.below(6) + 1; i > 0 && !text.empty(); --i) {
    const std::size_t at = rng.below(text.size());
    switch (rng.below(5)) {
      case 0: text[at] = static_cast<char>(rng.below(256)); break;
      case 1: text.erase(at, rng.below(8) + 1); break;
      case 2: text.insert(at, text.substr(rng.below(text.size()), rng.below(40))); break;
      case 3: text[at] = "0123456789-.e#<>/"[rng.below(17)]; break;
      default: text.insert(at, rng.below(2) == 0 ? "99999999999" : "nan"); break;
    }
  }
  return text;
}

}  // namespace outrider::test
