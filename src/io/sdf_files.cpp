#include "sdf_files.hpp"

#include <cstdlib>
#include <filesystem>

#include "open_file.hpp"
#include "outrider/io/files.hpp"
#include "xml.hpp"

namespace outrider {
namespace {

namespace fs = std::filesystem;

constexpr int most_folders_above = 4;

/// Returns the path if it exists. Returns a forbidden path too, so that reading it gives the right fault.
std::optional<std::string> existing(const fs::path& path) {
  return file_kind(path.string()) == FileKind::missing ? std::nullopt : std::optional(path.string());
}

/// Returns the path relative to the folder, or to the next folder above it in which it exists.
std::optional<std::string> find_above(fs::path folder, std::string_view rest) {
  if (const auto beside = existing(folder / rest)) return beside;
  if (fs::path(rest).is_absolute()) return std::nullopt;
  for (int up = 0; up < most_folders_above; ++up) {
    folder /= "..";
    if (auto found = existing(folder / rest)) return found;
  }
  return std::nullopt;
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

std::string_view last_part(std::string_view uri) {
  while (uri.ends_with('/')) uri.remove_suffix(1);
  return uri.substr(uri.rfind('/') + 1);
}

std::string_view built_in_model(std::string_view uri) {
  const std::string_view name = last_part(uri);
  if (name == "sun" || name == "Sun") return "<sdf version='1.6'/>";
  if (name != "ground_plane" && name != "Ground Plane") return {};
  return "<sdf version='1.6'><model name='ground_plane'><static>true</static><link name='link'>"
         "<collision name='collision'><geometry><plane><normal>0 0 1</normal><size>100 100</size></plane>"
         "</geometry></collision></link></model></sdf>";
}

std::vector<std::string> parts_of_path(std::string_view list) {
  std::vector<std::string> folders;
  while (!list.empty()) {
    const std::size_t colon = std::min(list.find(':'), list.size());
    if (colon > 0) folders.emplace_back(list.substr(0, colon));
    list.remove_prefix(std::min(colon + 1, list.size()));
  }
  return folders;
}

std::vector<std::string> model_folders(std::string_view model_path) {
  std::vector<std::string> folders = parts_of_path(model_path);
  for (const char* variable : {"GZ_SIM_RESOURCE_PATH", "GAZEBO_MODEL_PATH"}) {
    const char* list = std::getenv(variable);
    if (list == nullptr) continue;
    for (std::string& folder : parts_of_path(list)) folders.push_back(std::move(folder));
  }
  return folders;
}

std::optional<std::string> find_uri(std::string_view uri, const SdfFolders& folders) {
  const std::size_t scheme_end = uri.find("://");
  const std::string_view scheme = scheme_end == std::string_view::npos ? "file" : uri.substr(0, scheme_end);
  const std::string_view rest = scheme_end == std::string_view::npos ? uri : uri.substr(scheme_end + 3);
  if (scheme == "model" || scheme == "package") return find_in_models(rest, folders);
  if (scheme == "https" || scheme == "http") return find_in_models(last_part(rest), folders);
  if (scheme != "file" || rest.empty()) return std::nullopt;
  return find_above(fs::path(folders.beside), rest);
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
