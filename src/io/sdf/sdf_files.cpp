#include "sdf/sdf_files.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>

#include "files/open_file.hpp"
#include "outrider/io/files/files.hpp"
#include "outrider/io/files/text.hpp"

namespace outrider {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t most_world_bytes = std::size_t{64} << 20;
constexpr std::size_t most_tags = 2'000'000;
constexpr std::size_t most_includes = 20'000;
constexpr int most_folders_above = 4;
constexpr int newest_fuel_version = 99;

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

std::optional<std::string> find_in(const std::vector<fs::path>& roots, std::string_view rest) {
  rest.remove_prefix(std::min(rest.find_first_not_of('/'), rest.size()));
  if (rest.empty()) return std::nullopt;
  for (const fs::path& root : roots) {
    const fs::path place = root / rest;
    const FileKind kind = file_kind(place.string());
    if (kind == FileKind::folder || kind == FileKind::other) return place.string();
  }
  return std::nullopt;
}

/// Returns the last part of a path or an address.
std::string_view last_part(std::string_view uri) {
  while (uri.ends_with('/')) uri.remove_suffix(1);
  return uri.substr(uri.rfind('/') + 1);
}

/// An address of Gazebo Fuel: host/1.0/owner/models/name, then perhaps /version, then perhaps /files/file.
struct FuelAddress {
  std::string name;
  std::string folder;   ///< folder of the model in a cache of Fuel, in lower case: host/owner/models/name
  std::string version;  ///< empty or "tip": the newest
  std::string file;     ///< empty: the model
};

FuelAddress fuel_address(std::string address) {
  for (std::size_t at = 0; (at = address.find("%20")) != std::string::npos;) address.replace(at, 3, 1, ' ');
  std::vector<std::string> parts;
  for (const fs::path& part : fs::path(address)) {
    if (!part.empty()) parts.push_back(part.string());
  }
  const auto models = std::ranges::find(parts, "models");
  if (parts.end() - models < 2 || models - parts.begin() < 2)
    return {std::string(last_part(address)), {}, {}, {}};
  FuelAddress result{models[1], lower(parts[0] + '/' + models[-1] + "/models/" + models[1]), {}, {}};
  if (parts.end() - models > 2) result.version = models[2];
  for (auto part = models + 4; parts.end() - models > 4 && part != parts.end(); ++part)
    result.file += '/' + *part;
  return result;
}

std::optional<std::string> find_fuel(const FuelAddress& fuel, const std::vector<fs::path>& roots) {
  for (const std::string& folder : {fuel.name, fuel.folder}) {
    if (folder.empty() || !find_in(roots, folder)) continue;
    const int wanted = number<int>(fuel.version).value_or(0);
    for (int version = wanted > 0 ? wanted : newest_fuel_version; version > 0; --version) {
      if (auto found = find_in(roots, fmt::format("{}/{}{}", folder, version, fuel.file))) return found;
      if (wanted > 0) break;
    }
  }
  return find_in(roots, fuel.name + fuel.file);
}

/// Returns the text of a model that every simulator has: a floor, or a light, which is nothing. Empty for any
/// other name.
std::string_view built_in_model(std::string_view name) {
  if (name == "sun" || name == "Sun") return "<sdf version='1.6'/>";
  if (name != "ground_plane" && name != "Ground Plane") return {};
  return "<sdf version='1.6'><model name='ground_plane'><static>true</static><link name='link'>"
         "<collision name='collision'><geometry><plane><normal>0 0 1</normal><size>100 100</size></plane>"
         "</geometry></collision></link></model></sdf>";
}

/// Returns 100 times the major version and the minor one; nothing for what is no version.
std::optional<int> version_of(std::string_view text) {
  const std::size_t dot = std::min(text.find('.'), text.size());
  const auto major = number<int>(text.substr(0, dot));
  const auto minor = number<int>(dot + 1 < text.size() ? text.substr(dot + 1) : "0");
  if (!major || !minor || *major < 0 || *major > 99 || *minor < 0 || *minor > 99) return std::nullopt;
  return 100 * *major + *minor;
}

}  // namespace

// ---- Warnings ------------------------------------------------------------------------------------

void SdfWarnings::add(const std::string& where, const std::string& sentence) {
  const auto [found, fresh] = by_text_.emplace(sentence, entries_.size());
  if (fresh) entries_.push_back({where, sentence});
  ++entries_[found->second].count;
}

void SdfWarnings::add_missing(const std::string& where, const std::string& sentence) {
  if (first_missing_.empty()) first_missing_ = fmt::format("{}: {}", where, sentence);
  add(where, sentence);
}

std::vector<std::string> SdfWarnings::sentences() const {
  std::vector<std::string> result;
  for (const Entry& entry : entries_) {
    const std::string times = entry.count > 1 ? fmt::format(" ({} times, first here)", entry.count) : "";
    result.push_back(fmt::format("{}: {}{}", entry.where, entry.sentence, times));
  }
  return result;
}

// ---- Files ---------------------------------------------------------------------------------------

SdfFiles::SdfFiles(const std::string& model_path) {
  const char* const gazebo = std::getenv("GZ_SIM_RESOURCE_PATH");
  const char* const classic = std::getenv("GAZEBO_MODEL_PATH");
  for (const char* const list : {model_path.c_str(), gazebo, classic}) {
    for (const std::string_view folder : filled_parts_between(list == nullptr ? "" : list, ':'))
      models_.emplace_back(folder);
  }
}

Outcome<const SdfFile*> SdfFiles::parse(std::string_view text, const std::string& name) {
  const auto tags = static_cast<std::size_t>(std::ranges::count(text, '<'));
  if (tags > most_tags) return admit({{}, name, {}, {}, text.size(), tags});
  auto document = XmlDocument::parse(text, name, "");
  if (!document) return pass_on(document);
  const std::string_view root = document->root().name();
  if (root != "sdf" && root != "robot")
    return bad_input(fmt::format("its root element is <{}>, not <sdf>", excerpt(root)), name);
  const auto version = version_of(xml_attribute(document->root(), "version")).value_or(106);
  const std::string folder = fs::path(name).parent_path().string();
  auto file =
      std::make_unique<SdfFile>(SdfFile{std::move(*document), name, folder, version, text.size(), tags});
  return admit(*parsed_.insert_or_assign(name, std::move(file)).first->second);
}

Outcome<const SdfFile*> SdfFiles::admit(const SdfFile& file) {
  bytes_ += file.bytes;
  tags_ += file.tags;
  if (bytes_ > most_world_bytes)
    return bad_input(fmt::format("it has more than {} bytes with what it includes", most_world_bytes),
                     file.name);
  if (tags_ > most_tags) {
    return bad_input(fmt::format("it has {} tags with what it includes, and at most {} are read; leave out "
                                 "what has no collisions, or cut the world in two",
                                 tags_, most_tags),
                     file.name);
  }
  const XmlElement root = file.document.root();
  if (file.is_urdf()) return &file;
  if (!version_of(xml_attribute(root, "version"))) {
    warnings.add(file.document.where(root), "a missing or unreadable version of <sdf> was taken for 1.6");
  } else if (file.version > newest_sdf_version) {
    warnings.add(file.document.where(root),
                 fmt::format("SDF version {} was read as {}.{}", excerpt(xml_attribute(root, "version")),
                             newest_sdf_version / 100, newest_sdf_version % 100));
  }
  return &file;
}

std::optional<std::string> SdfFiles::find(std::string_view uri, const std::string& beside) const {
  const std::size_t scheme_end = uri.find("://");
  const std::string_view scheme = scheme_end == std::string_view::npos ? "file" : uri.substr(0, scheme_end);
  const std::string_view rest = scheme_end == std::string_view::npos ? uri : uri.substr(scheme_end + 3);
  const fs::path here = beside.empty() ? fs::path(".") : fs::path(beside);
  if (scheme == "file") return rest.empty() ? std::nullopt : find_above(fs::path(beside), rest);
  std::vector<fs::path> roots = {here, here / "models", here / "..", here / ".." / "models"};
  roots.insert(roots.end(), models_.begin(), models_.end());
  if (scheme == "model" || scheme == "package") return find_in(roots, rest);
  if (scheme != "https" && scheme != "http") return std::nullopt;
  return find_fuel(fuel_address(std::string(rest)), roots);
}

std::optional<std::string> SdfFiles::find_model(std::string_view uri, const std::string& beside) {
  const auto [known, fresh] = found_.try_emplace(fmt::format("{}\n{}", beside, uri));
  if (!fresh) return known->second;
  auto found = find(uri, beside);
  if (found && file_kind(*found) == FileKind::folder) {
    const fs::path folder = *found;
    std::string sdf_name = "model.sdf";
    const auto text = read_file((folder / "model.config").string(), std::size_t{1} << 20);
    const auto config = XmlDocument::parse(text ? *text : "<model/>", *found, "model");
    if (!config) return std::nullopt;
    int newest = 0;
    for (const XmlElement sdf : config->root().children("sdf")) {
      const int version = version_of(xml_attribute(sdf, "version")).value_or(0);
      if (xml_text(sdf).empty() || version > newest_sdf_version || version < newest) continue;
      newest = version;
      sdf_name = xml_text(sdf);
    }
    found = existing(folder / sdf_name);
  }
  return known->second = found;
}

Outcome<const SdfFile*> SdfFiles::include(const SdfFile& by, XmlElement include) {
  const std::string uri(xml_text(include, "uri"));
  const auto found = find_model(uri, by.folder);
  const std::string_view known = built_in_model(fuel_address(uri).name);
  if (!found && known.empty()) {
    warnings.add_missing(by.document.where(include),
                         fmt::format("the include of '{}' was not found and was left out; give the folder "
                                     "that has '{}' as model_path",
                                     excerpt(uri, 200), excerpt(last_part(uri))));
    return nullptr;
  }
  if (++includes_ > most_includes)
    return bad_input(fmt::format("it has more than {} includes; cut the world in two", most_includes),
                     by.document.where(include));
  if (const auto before = parsed_.find(found.value_or(uri)); before != parsed_.end())
    return admit(*before->second);
  if (!found) return parse(known, uri);
  auto text = read_file(*found, most_world_bytes);
  if (!text) return pass_on(text);
  return parse(*text, *found);
}

}  // namespace outrider
