#include "sources.hpp"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <sstream>

namespace architecture {
namespace {

namespace fs = std::filesystem;

std::string layer_of(const std::string& path) {
  for (const std::string_view root : {"include/outrider/", "src/"}) {
    if (!path.starts_with(root)) continue;
    const std::string below = path.substr(root.size());
    const std::size_t job = below.starts_with("jobs/") ? below.find('/', 5) : std::string::npos;
    return below.substr(0, job != std::string::npos ? job : below.find('/'));
  }
  return path.substr(0, path.find('/'));
}

std::string read(const fs::path& file) {
  std::ifstream stream(file);
  return {std::istreambuf_iterator<char>(stream), {}};
}

/// The end of a literal or comment that starts at `i`, or `i` when none starts there.
std::size_t skip(std::string_view text, std::size_t i) {
  const auto after = [&](std::size_t found, std::size_t length) {
    return found == std::string_view::npos ? text.size() : found + length;
  };
  if (text.substr(i, 2) == "//") return after(text.find('\n', i), 0);
  if (text.substr(i, 2) == "/*") return after(text.find("*/", i + 2), 2);
  if (text.substr(i, 2) == "R\"") {
    const std::size_t open = text.find('(', i);
    std::string close(text.substr(i + 1, open - i));
    close.front() = ')';
    close.back() = '"';
    return after(text.find(close, open), close.size());
  }
  if (text[i] != '"' && text[i] != '\'') return i;
  const bool separator = text[i] == '\'' && i > 0 && std::isalnum(static_cast<unsigned char>(text[i - 1]));
  if (separator) return i;  // 1'000
  std::size_t end = i + 1;
  while (end < text.size() && text[end] != text[i]) end += text[end] == '\\' ? 2 : 1;
  return std::min(end + 1, text.size());
}

}  // namespace

std::string without_comments_and_literals(std::string_view text) {
  std::string code(text);
  for (std::size_t i = 0; i < text.size();) {
    const std::size_t line_start =
        text.rfind('\n', i) == std::string_view::npos ? 0 : text.rfind('\n', i) + 1;
    const bool include = text.substr(line_start, 8) == "#include";
    const std::size_t end = include && text[i] == '"' ? i : skip(text, i);
    for (std::size_t k = i; k < end; ++k) {
      if (code[k] != '\n') code[k] = ' ';
    }
    i = std::max(end, i + 1);
  }
  return code;
}

std::vector<Source> sources(const std::vector<std::string>& folders) {
  const fs::path root = OUTRIDER_SOURCE_DIR;
  std::vector<Source> found;
  for (const std::string& folder : folders) {
    if (!fs::exists(root / folder)) continue;
    for (const auto& entry : fs::recursive_directory_iterator(root / folder)) {
      const fs::path& file = entry.path();
      if (file.extension() != ".hpp" && file.extension() != ".cpp") continue;
      const std::string path = fs::relative(file, root).generic_string();
      std::string text = read(file);
      std::string code = without_comments_and_literals(text);
      found.push_back({path, layer_of(path), std::move(text), std::move(code)});
    }
  }
  std::sort(found.begin(), found.end(), [](const Source& a, const Source& b) { return a.path < b.path; });
  return found;
}

std::vector<std::string> lines(const std::string& text) {
  std::istringstream stream(text);
  std::vector<std::string> result;
  for (std::string line; std::getline(stream, line);) result.push_back(line);
  return result;
}

}  // namespace architecture
