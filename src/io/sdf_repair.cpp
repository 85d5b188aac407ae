#include "sdf_repair.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <initializer_list>
#include <set>

#include "outrider/io/files.hpp"
#include "sdf_files.hpp"
#include "text.hpp"
#include "xml.hpp"

namespace outrider {
namespace {

namespace fs = std::filesystem;
using Element = tinyxml2::XMLElement;

constexpr std::size_t most_bytes = std::size_t{64} << 20;
constexpr std::size_t most_includes = 1000;
constexpr int deepest_include = 8;
constexpr double newest_version = 1.9;

/// What all files of one world share.
struct Session {
  SdfWarnings& warnings;
  std::set<std::string, std::less<>> referenced;  // frames named by an attribute anywhere
  std::size_t includes = 0;
  std::size_t bytes = 0;
};

/// One file of it.
struct SdfFile {
  Session& session;
  std::string name;
  SdfFolders folders;
  double version = newest_version;
  int depth = 0;

  [[nodiscard]] std::string where(const Element& element) const {
    return fmt::format("{}:{}", name, element.GetLineNum());
  }
  void warn(const Element& element, const std::string& sentence) const {
    session.warnings.add(where(element), sentence);
  }
};

/// The name with every "::" as "_": sdformat keeps "::" for itself.
std::string without_colons(std::string_view given) {
  std::string name;
  for (const char c : given) {
    if (c == ':' && name.ends_with(':')) {
      name.back() = '_';
    } else {
      name += c;
    }
  }
  return name;
}

bool one_of(std::string_view name, std::initializer_list<std::string_view> names) {
  return std::ranges::find(names, name) != names.end();
}

/// Elements that say where collisions stand; the rest (visuals, plugins, lights ...) is none of ours.
bool matters(const Element& parent, const Element& child) {
  const std::string_view in = parent.Name();
  const std::string_view name = child.Name();
  if (in == "sdf") return one_of(name, {"world", "model", "include"});
  if (in == "world") return one_of(name, {"model", "include", "frame", "gravity", "physics"});
  if (in == "physics") return name == "gravity";
  if (in == "model") return one_of(name, {"model", "include", "frame", "link", "joint", "pose", "static"});
  if (in == "link") return one_of(name, {"pose", "collision"});
  if (in == "collision") return one_of(name, {"pose", "geometry"});
  if (in == "joint") return !one_of(name, {"sensor", "physics"});
  return true;
}

// ---- Poses ---------------------------------------------------------------------------------------

/// Refuses what is no pose; three numbers get a rotation of zero.
Status repair_pose(const SdfFile& file, Element& pose) {
  const auto parts = words(xml_text(pose));
  for (const std::string_view part : parts) {
    if (number<double>(part)) continue;
    return bad_input(fmt::format("'{}' in a <pose> is no finite number", excerpt(part)), file.where(pose));
  }
  const bool quaternion = xml_attribute(pose, "rotation_format") == "quat_xyzw";
  if (parts.empty() || parts.size() == (quaternion ? 7U : 6U)) return {};
  if (parts.size() != 3) {
    return bad_input(fmt::format("a <pose> has {} numbers; it takes x y z roll pitch yaw", parts.size()),
                     file.where(pose));
  }
  file.warn(pose, "a <pose> of three numbers was read as a place without a rotation");
  const std::string text =
      fmt::format("{} {} {} {}", parts[0], parts[1], parts[2], quaternion ? "0 0 0 1" : "0 0 0");
  pose.SetText(text.c_str());
  return {};
}

// ---- State ---------------------------------------------------------------------------------------

/// Collects the poses of the models and links of a saved state; they are in the world's frame.
Status read_stated(const SdfFile& file, Element& owner, const std::string& prefix,
                   std::map<std::string, Pose3>& stated) {
  for (Element* child = owner.FirstChildElement(); child != nullptr; child = child->NextSiblingElement()) {
    if (!one_of(child->Name(), {"model", "link"})) continue;
    const std::string path = prefix + without_colons(xml_attribute(*child, "name"));
    if (Element* pose = child->FirstChildElement("pose")) {
      if (auto repaired = repair_pose(file, *pose); !repaired) return repaired;
      std::array<double, 6> v{};
      const auto parts = words(xml_text(*pose));
      for (std::size_t i = 0; i < std::min(parts.size(), v.size()); ++i) v[i] = *number<double>(parts[i]);
      stated.emplace(path, Pose3{{v[0], v[1], v[2]}, Rotation::from_rpy(v[3], v[4], v[5])});
    }
    for (const std::string_view factor : words(xml_text(*child, "scale"))) {
      if (number<double>(factor) == 1.0) continue;
      file.warn(*child, "a <scale> in <state> was not applied; sizes are those of the models");
      break;
    }
    if (auto nested = read_stated(file, *child, path + "::", stated); !nested) return nested;
  }
  return {};
}

Status read_state(const SdfFile& file, Element& state, std::map<std::string, Pose3>& stated) {
  for (const char* name : {"sim_time", "real_time", "wall_time"}) {
    const Element* time = state.FirstChildElement(name);
    if (time == nullptr) continue;
    const auto parts = words(xml_text(*time));
    const bool pair = parts.size() == 2 && number<std::int64_t>(parts[0]) && number<std::int64_t>(parts[1]);
    if (!pair) file.warn(*time, "a time in <state> is not seconds and nanoseconds and was left out");
  }
  for (const char* name : {"insertions", "deletions"}) {
    const Element* change = state.FirstChildElement(name);
    if (change != nullptr && !change->NoChildren()) {
      file.warn(*change, fmt::format("the <{}> of <state> were left out; save the world again", name));
    }
  }
  return read_stated(file, state, "", stated);
}

// ---- Collisions ----------------------------------------------------------------------------------

/// True when the collision stays. `path` names it in warnings.
bool repair_geometry(const SdfFile& file, Element& collision, const std::string& path) {
  Element* geometry = collision.FirstChildElement("geometry");
  if (geometry == nullptr || geometry->FirstChildElement() == nullptr) {
    file.warn(collision, fmt::format("collision '{}' has no shape and was left out", path));
    return false;
  }
  Element* kept = nullptr;  // sdformat's own order of preference
  for (const char* kind : {"box", "capsule", "cylinder", "ellipsoid", "plane", "sphere", "mesh", "empty"}) {
    if (kept == nullptr) kept = geometry->FirstChildElement(kind);
  }
  if (kept == nullptr) {
    file.warn(collision, fmt::format("collision '{}' is a <{}>, which is not modelled; it was left out", path,
                                     excerpt(geometry->FirstChildElement()->Name())));
    return false;
  }
  if (kept->Name() == std::string_view("empty")) return false;
  if (kept->PreviousSiblingElement() != nullptr || kept->NextSiblingElement() != nullptr) {
    file.warn(*geometry, fmt::format("a <geometry> has several shapes; its <{}> was kept", kept->Name()));
    for (Element *next = nullptr, *shape = geometry->FirstChildElement(); shape != nullptr; shape = next) {
      next = shape->NextSiblingElement();
      if (shape != kept) geometry->DeleteChild(shape);
    }
  }
  if (kept->Name() != std::string_view("mesh")) return true;
  const std::string uri(xml_text(*kept, "uri"));
  const auto found = find_uri(uri, file.folders);
  if (!found) {
    file.warn(*kept,
              fmt::format("the mesh '{}' of collision '{}' was not found, so the collision was left out",
                          excerpt(uri), path));
    return false;
  }
  if (kept->FirstChildElement("submesh") != nullptr) {
    file.warn(*kept, fmt::format("collision '{}' asks for a <submesh>; the whole mesh was taken", path));
  }
  kept->FirstChildElement("uri")->SetText(found->c_str());
  return true;
}

// ---- Names ---------------------------------------------------------------------------------------

/// Makes the name of a frame or a collision unique among its siblings, and free of "::".
void repair_name(const SdfFile& file, Element& element, std::set<std::string>& taken) {
  const char* attribute = element.Attribute("name");
  if (attribute == nullptr) return;  // sdformat says so
  std::string name = without_colons(attribute);
  if (name != attribute) file.warn(element, "'::' in a name was replaced by '_'");
  const std::string wanted = name;
  for (int i = 2; taken.contains(name); ++i) name = fmt::format("{}_{}", wanted, i);
  if (name != wanted) {
    file.warn(element, fmt::format("<{}> names its sibling has too got a number", element.Name()));
  }
  taken.insert(name);
  if (name != attribute) element.SetAttribute("name", name.c_str());
}

// ---- The walk ------------------------------------------------------------------------------------

Status repair_children(const SdfFile& file, Element& parent, const std::string& path);

/// What an <include> brings into its parent; null when its file is not found or holds no model.
Outcome<Element*> expand_include(const SdfFile& file, Element& include, tinyxml2::XMLDocument& document);

/// False when the element is to be left out.
Outcome<bool> repair_element(const SdfFile& file, Element& element, const std::string& path) {
  const std::string_view kind = element.Name();
  if (kind == "pose") {
    if (auto repaired = repair_pose(file, element); !repaired) return pass_on(repaired);
    return true;
  }
  if (kind == "joint" && !file.session.referenced.contains(xml_attribute(element, "name"))) return false;
  if (auto repaired = repair_children(file, element, path); !repaired) return pass_on(repaired);
  if (kind == "collision") return repair_geometry(file, element, path);
  if (kind == "physics") return element.FirstChildElement("gravity") != nullptr;
  if (kind == "model") {
    return element.FirstChildElement("link") != nullptr || element.FirstChildElement("model") != nullptr;
  }
  return true;
}

Status repair_children(const SdfFile& file, Element& parent, const std::string& path) {
  std::set<std::string> frame_names;
  std::set<std::string> collision_names;
  for (Element *next = nullptr, *child = parent.FirstChildElement(); child != nullptr; child = next) {
    next = child->NextSiblingElement();
    const std::string_view kind = child->Name();
    if (!matters(parent, *child)) {
      if (kind.find(':') != std::string_view::npos) {
        file.warn(*child, fmt::format("a left-over <{}> was left out", excerpt(kind)));
      } else if (kind == "population") {
        file.warn(*child, "a <population> was left out; place its models one by one");
      }
      parent.DeleteChild(child);
      continue;
    }
    if (kind == "include") {
      auto model = expand_include(file, *child, *parent.GetDocument());
      if (!model) return pass_on(model);
      if (*model != nullptr) {
        repair_name(file, **model, frame_names);
        parent.InsertAfterChild(child, *model);
      }
      parent.DeleteChild(child);
      continue;
    }
    if (one_of(kind, {"model", "link", "frame", "joint"})) repair_name(file, *child, frame_names);
    if (kind == "collision") repair_name(file, *child, collision_names);
    const bool named = one_of(kind, {"model", "link", "collision"});
    const std::string child_path =
        named ? fmt::format("{}{}{}", path, path.empty() ? "" : "/", xml_attribute(*child, "name")) : path;
    auto keep = repair_element(file, *child, child_path);
    if (!keep) return pass_on(keep);
    if (!*keep) parent.DeleteChild(child);
  }
  return {};
}

/// Notes every frame that an attribute of the tree names, also the last part of "a::b".
void collect_references(const Element& element, std::set<std::string, std::less<>>& referenced) {
  for (const char* attribute : {"relative_to", "attached_to", "placement_frame", "frame"}) {
    const std::string_view name = xml_attribute(element, attribute);
    if (name.empty()) continue;
    const std::size_t last = name.rfind("::");
    referenced.emplace(last == std::string_view::npos ? name : name.substr(last + 2));
  }
  for (const Element* child = element.FirstChildElement(); child != nullptr;
       child = child->NextSiblingElement()) {
    collect_references(*child, referenced);
  }
}

Outcome<XmlDocument> parse_file(SdfFile& file, std::string_view text) {
  file.session.bytes += text.size();
  if (file.session.bytes > most_bytes) {
    return bad_input(fmt::format("it has more than {} bytes with what it includes", most_bytes), file.name);
  }
  auto document = xml_document(text, file.name, "sdf");
  if (!document) return document;
  Element& root = *(*document)->RootElement();
  const auto version = number<double>(xml_attribute(root, "version"));
  if (!version) {
    file.warn(root, "a missing or unreadable version of <sdf> was taken for 1.6");
    root.SetAttribute("version", "1.6");
  }
  file.version = version.value_or(1.6);
  // 1.10 and later are newer than 1.9, though smaller as numbers.
  const std::string_view text_of = xml_attribute(root, "version");
  if (text_of.starts_with("1.1") && text_of.size() > 3) file.version = newest_version + 0.1;
  if (file.version > newest_version) {
    file.warn(root, fmt::format("SDF version {} was read as 1.9", excerpt(text_of)));
    root.SetAttribute("version", "1.9");
  }
  collect_references(root, file.session.referenced);
  return document;
}

Outcome<Element*> expand_include(const SdfFile& file, Element& include, tinyxml2::XMLDocument& document) {
  const std::string uri(xml_text(include, "uri"));
  const auto found = find_model(uri, file.folders);
  if (!found) {
    file.warn(include,
              fmt::format("the include of '{}' was not found and was left out; name its folder in model_path",
                          excerpt(uri)));
    return nullptr;
  }
  if (file.depth == deepest_include || ++file.session.includes > most_includes) {
    return bad_input(fmt::format("includes nest more than {} deep, or in a circle, or are more than {}",
                                 deepest_include, most_includes),
                     file.where(include));
  }
  auto text = read_file(*found, most_bytes);
  if (!text) return pass_on(text);
  SdfFile included{file.session,
                   *found,
                   {fs::path(*found).parent_path().string(), file.folders.models},
                   1.6,
                   file.depth + 1};
  auto parsed = parse_file(included, *text);
  if (!parsed) return pass_on(parsed);
  Element& root = *(*parsed)->RootElement();
  Element* model = root.FirstChildElement("model");
  if (model == nullptr) return nullptr;  // a light or an actor
  std::set<std::string, std::less<>> frames;
  collect_references(*model, frames);
  if (!frames.empty() && (included.version < 1.65) != (file.version < 1.65)) {
    return bad_input(fmt::format("'{}' names frames as SDF {} does; write both files for one version",
                                 excerpt(uri), xml_attribute(root, "version")),
                     file.where(include));
  }
  if (auto repaired = repair_children(included, root, ""); !repaired) return pass_on(repaired);
  model = root.FirstChildElement("model");
  if (model == nullptr) return nullptr;
  Element* copy = model->DeepClone(&document)->ToElement();
  if (const auto name = xml_text(include, "name"); !name.empty())
    copy->SetAttribute("name", std::string(name).c_str());
  if (const auto frame = xml_text(include, "placement_frame"); !frame.empty()) {
    copy->SetAttribute("placement_frame", std::string(frame).c_str());
  }
  if (Element* pose = include.FirstChildElement("pose")) {
    if (auto repaired = repair_pose(file, *pose); !repaired) return pass_on(repaired);
    if (Element* own = copy->FirstChildElement("pose")) copy->DeleteChild(own);
    copy->InsertFirstChild(pose->DeepClone(&document));
  }
  return copy;
}

/// Puts the models of a file without a world into one.
void make_world(Element& root) {
  Element* world = root.GetDocument()->NewElement("world");
  world->SetAttribute("name", "yard");
  for (Element *next = nullptr, *child = root.FirstChildElement(); child != nullptr; child = next) {
    next = child->NextSiblingElement();
    if (one_of(child->Name(), {"model", "include"})) world->InsertEndChild(child);
  }
  root.InsertEndChild(world);
}

}  // namespace

void SdfWarnings::add(const std::string& where, const std::string& sentence) {
  const auto [found, fresh] = by_text_.emplace(sentence, entries_.size());
  if (fresh) entries_.push_back({where, sentence});
  ++entries_[found->second].count;
}

std::vector<std::string> SdfWarnings::sentences() const {
  std::vector<std::string> result;
  for (const Entry& entry : entries_) {
    const std::string times = entry.count > 1 ? fmt::format(" ({} times, first here)", entry.count) : "";
    result.push_back(fmt::format("{}: {}{}", entry.where, entry.sentence, times));
  }
  return result;
}

Outcome<RepairedSdf> repair_sdf(std::string_view text, const std::string& name, const std::string& model_path,
                                SdfWarnings& warnings) {
  Session session{warnings, {}};
  SdfFolders folders{fs::path(name).parent_path().string(), {}};
  for (std::string_view rest = model_path; !rest.empty();) {
    const std::size_t colon = std::min(rest.find(':'), rest.size());
    if (colon > 0) folders.models.emplace_back(rest.substr(0, colon));
    rest.remove_prefix(std::min(colon + 1, rest.size()));
  }
  SdfFile file{session, name, std::move(folders)};
  auto document = parse_file(file, text);
  if (!document) return pass_on(document);
  Element& root = *(*document)->RootElement();

  RepairedSdf repaired;
  repaired.bare = root.FirstChildElement("world") == nullptr;
  if (repaired.bare) {
    make_world(root);
    file.warn(root, "there is no <world>; its models were put into one, on a floor at z = 0");
  }
  Element* world = root.FirstChildElement("world");
  if (Element* other = world->NextSiblingElement("world")) {
    file.warn(*other, "only the first <world> was read");
    while ((other = world->NextSiblingElement("world")) != nullptr) root.DeleteChild(other);
  }
  for (Element* state = world->FirstChildElement("state"); state != nullptr;
       state = state->NextSiblingElement("state")) {
    if (auto read = read_state(file, *state, repaired.stated); !read) return pass_on(read);
  }
  if (auto walked = repair_children(file, root, ""); !walked) return pass_on(walked);
  repaired.text = xml_on_same_lines(**document);
  return repaired;
}

}  // namespace outrider
