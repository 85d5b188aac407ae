#include "sdf_files.hpp"

#include <filesystem>

#include "open_file.hpp"
#include "outrider/io/files.hpp"
#include "xml.hpp"

namespace outrider {
namespace {

namespace fs = std::filesystem;

/// Returns the path if it exists. Returns a forbidden path too, so that reading it gives the right fault.
std::optional<std::string> existing(const fs::path& path) {
  return file_kind(path.string()) == FileKind::missing ? std::nullopt : std::optional(path.string());
}

std::optional<std::string> find_in_models(std::string_view rest, const SdfFolders& folders) {
  rest.remove_prefix(std::min(rest.find_first_not_of('/'), rest.size()));
  if (rest.empty()) return std::nullopt;
  const fs::path beside = folders.beside.empty() ? fs::path(".") : fs::path(folders.beside);
  std::vector<fs::path> roots = {beside, beside / "models", beside / "..", beside / ".." / "models"};
  roots.insert(roots.end(), folders.models.begin(), folders.models.end());
  for (const fs::path& root : roots) {
    const fs::path place = root / rest;
    const FileKind kind = file_kind(place.string());
    if (kind == FileKind::folder || kind == FileKind::other) return place.string();
  }
  return std::nullopt;
}

}  // namespace

std::optional<std::string> find_uri(std::string_view uri, const SdfFolders& folders) {
  const std::size_t scheme_end = uri.find("://");
  const std::string_view scheme = scheme_end == std::string_view::npos ? "file" : uri.substr(0, scheme_end);
  const std::string_view rest = scheme_end == std::string_view::npos ? uri : uri.substr(scheme_end + 3);
  if (scheme == "model" || scheme == "package") return find_in_models(rest, folders);
  if (scheme != "file" || rest.empty()) return std::nullopt;
  return existing(fs::path(folders.beside) / rest);
}

std::optional<std::string> find_model(std::string_view uri, const SdfFolders& folders) {
  auto found = find_uri(uri, folders);
  if (!found || file_kind(*found) != FileKind::folder) return found;
  std::string sdf_name = "model.sdf";
  auto text = read_file((fs::path(*found) / "model.config").string(), std::size_t{1} << 20);
  if (!text) return existing(fs::path(*found) / sdf_name);
  auto config = xml_document(*text, *found, "model");
  if (!config) return std::nullopt;
  for (const auto* sdf = (*config)->RootElement()->FirstChildElement("sdf"); sdf != nullptr;
       sdf = sdf->NextSiblingElement("sdf")) {
    if (!xml_text(*sdf).empty()) sdf_name = xml_text(*sdf);  // by convention, the last is the newest
  }
  return existing(fs::path(*found) / sdf_name);
}

}  // namespace outrider
