// The sources of the project as text, for tests that ask rules of them.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace architecture {

struct Source {
  std::string path;   ///< from the root of the project, e.g. "src/core/rng.cpp"
  std::string layer;  ///< "core", "jobs/guard"; "apps", "tests", ... outside include/ and src/
  std::string text;
  std::string code;  ///< the text with comments and string literals blanked, line by line the same

  [[nodiscard]] bool in_library() const {
    return path.starts_with("src/") || path.starts_with("include/outrider/");
  }
};

/// Every .hpp and .cpp under the named folders of the project, sorted by path.
std::vector<Source> sources(const std::vector<std::string>& folders);

/// The text with comments and the inside of string and character literals replaced by spaces.
std::string without_comments_and_literals(std::string_view text);

std::vector<std::string> lines(const std::string& text);

}  // namespace architecture
