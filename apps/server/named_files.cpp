#include "named_files.hpp"

#include <yaml-cpp/yaml.h>

#include "outrider/io/files.hpp"

namespace outrider::server {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t most_bytes = std::size_t{16} << 20U;
constexpr int most_values = 100'000;

/// The texts of a document. A document may name a part of it again and again, so values are counted.
void collect(const YAML::Node& node, std::vector<std::string>& texts, int& left) {
  if (--left < 0) return;
  if (node.IsScalar()) texts.push_back(node.Scalar());
  for (const auto& child : node) {
    collect(node.IsMap() ? child.second : child, texts, left);
  }
}

Outcome<std::vector<std::string>> texts_of_yaml(const std::string& content, const std::string& name) {
  std::vector<std::string> texts;
  int left = most_values;
  try {
    collect(YAML::Load(content), texts, left);
  } catch (const YAML::Exception& error) {
    return bad_input(std::string("this is no YAML: ") + error.msg, name);
  }
  if (left < 0) return bad_input("it has too many values", name);
  return texts;
}

/// A text may hold several paths with colons between.
std::vector<NamedFile> of_yaml(const std::vector<std::string>& texts, const fs::path& folder) {
  std::vector<NamedFile> named;
  for (const std::string& text : texts) {
    for (std::size_t begin = 0; begin <= text.size();) {
      const std::size_t end = std::min(text.find(':', begin), text.size());
      const std::string part = text.substr(begin, end - begin);
      begin = end + 1;
      std::error_code error;
      const bool path = part.find('/') != std::string::npos || fs::exists(folder / part, error);
      if (path && !part.empty()) named.push_back({part, folder / part});
    }
  }
  return named;
}

/// The texts between <uri> and </uri>, without white space around them.
std::vector<std::string> uris_in(const std::string& content) {
  std::vector<std::string> uris;
  for (std::size_t at = content.find("<uri"); at != std::string::npos; at = content.find("<uri", at)) {
    const std::size_t begin = content.find('>', at);
    const std::size_t end = std::min(content.find("</uri", at), content.size());
    at = end;
    if (begin == std::string::npos || begin >= end) break;
    const std::string text = content.substr(begin + 1, end - begin - 1);
    const std::size_t first = text.find_first_not_of(" \t\r\n");
    if (first == std::string::npos) continue;
    uris.push_back(text.substr(first, text.find_last_not_of(" \t\r\n") + 1 - first));
  }
  return uris;
}

Outcome<std::vector<NamedFile>> of_sdf(const std::string& content, const fs::path& file) {
  const fs::path folder = file.parent_path();
  std::vector<NamedFile> named;
  for (const std::string& uri : uris_in(content)) {
    if (uri.find_first_of("<&") != std::string::npos) {
      return bad_input("a uri holds markup; write the path as it is", file.filename().string());
    }
    const std::size_t scheme_end = uri.find("://");
    const std::string scheme = scheme_end == std::string::npos ? "file" : uri.substr(0, scheme_end);
    const std::string rest = scheme_end == std::string::npos ? uri : uri.substr(scheme_end + 3);
    if (scheme == "file") named.push_back({uri, folder / rest});
    if (scheme != "model" && scheme != "package") continue;  // nothing is fetched
    const std::string name = rest.substr(std::min(rest.find_first_not_of('/'), rest.size()));
    for (const char* root : {".", "models", "..", "../models"}) {
      std::error_code error;
      const fs::path place = folder / root / name;
      if (fs::exists(place, error)) named.push_back({uri, place});
    }
  }
  return named;
}

}  // namespace

Outcome<std::vector<NamedFile>> files_named_in(const fs::path& file) {
  fs::path plain = file;
  if (plain.extension() == ".gz") plain.replace_extension();
  const std::string extension = plain.extension().string();
  const bool yaml = extension == ".yaml" || extension == ".yml";
  const bool sdf = extension == ".sdf" || extension == ".world";
  std::error_code error;
  if ((!yaml && !sdf) || !fs::is_regular_file(file, error)) return std::vector<NamedFile>{};
  auto content = read_file(file.string(), most_bytes);
  if (!content) return pass_on(content);
  if (sdf) return of_sdf(*content, file);
  auto texts = texts_of_yaml(*content, file.filename().string());
  if (!texts) return pass_on(texts);
  return of_yaml(*texts, file.parent_path());
}

}  // namespace outrider::server
