#include "sdf_repair.hpp"

#include <filesystem>

#include "outrider/io/files.hpp"
#include "outrider/io/text.hpp"
#include "sdf_parts.hpp"

namespace outrider {
namespace {

namespace fs = std::filesystem;
using Element = SdfElement;

constexpr std::size_t most_bytes = std::size_t{64} << 20;
constexpr std::size_t most_includes = 1000;
constexpr int deepest_include = 8;

Status repair_children(const SdfFile& file, Element& parent, const std::string& path);

/// Returns the model of an <include>; null if its file is not found or contains no model.
Outcome<Element*> expand_include(const SdfFile& file, Element& include, tinyxml2::XMLDocument& document);

/// Repairs an element. Returns false if it must be removed.
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

void leave_out(const SdfFile& file, Element& parent, Element* child) {
  const std::string_view kind = child->Name();
  if (kind.find(':') != std::string_view::npos) {
    file.warn(*child, fmt::format("a left-over <{}> was left out", excerpt(kind)));
  } else if (kind == "population") {
    file.warn(*child, "a <population> was left out; place its models one by one");
  }
  parent.DeleteChild(child);
}

/// Replaces an <include> by its model.
Status splice_include(const SdfFile& file, Element& parent, Element* include, UniqueNames& taken) {
  auto model = expand_include(file, *include, *parent.GetDocument());
  if (!model) return pass_on(model);
  if (*model != nullptr) {
    repair_name(file, **model, taken);
    parent.InsertAfterChild(include, *model);
  }
  parent.DeleteChild(include);
  return {};
}

Status repair_children(const SdfFile& file, Element& parent, const std::string& path) {
  UniqueNames frame_names;
  UniqueNames collision_names;
  for (Element *next = nullptr, *child = parent.FirstChildElement(); child != nullptr; child = next) {
    next = child->NextSiblingElement();
    const std::string_view kind = child->Name();
    if (!sdf_matters(parent.Name(), kind)) {
      leave_out(file, parent, child);
      continue;
    }
    if (kind == "include") {
      if (auto spliced = splice_include(file, parent, child, frame_names); !spliced) return spliced;
      continue;
    }
    if (one_of(kind, {"world", "model", "link", "frame", "joint"})) repair_name(file, *child, frame_names);
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

/// Collects the names of all frames in attributes of the tree; of "a::b", only the last part.
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
  if (auto few = count_tags(text, file.name, file.session.tags); !few) return pass_on(few);
  auto document = xml_document(text, file.name, "sdf");
  if (!document) return document;
  Element& root = *(*document)->RootElement();
  const auto version = number<double>(xml_attribute(root, "version"));
  if (!version) {
    file.warn(root, "a missing or unreadable version of <sdf> was taken for 1.6");
    root.SetAttribute("version", "1.6");
  }
  file.version = version.value_or(1.6);
  // 1.10 and later are newer than 1.9, but smaller as numbers.
  const std::string_view text_of = xml_attribute(root, "version");
  if (text_of.starts_with("1.1") && text_of.size() > 3) file.version = newest_sdf_version + 0.1;
  if (file.version > newest_sdf_version) {
    file.warn(root, fmt::format("SDF version {} was read as 1.9", excerpt(text_of)));
    root.SetAttribute("version", "1.9");
  }
  collect_references(root, file.session.referenced);
  return document;
}

Outcome<Element*> expand_include(const SdfFile& file, Element& include, tinyxml2::XMLDocument& document) {
  const std::string uri(xml_text(include, "uri"));
  const auto found = find_model(uri, file.folders);
  const std::string_view built_in = built_in_model(uri);
  if (!found && built_in.empty()) {
    file.warn_missing(include,
                      fmt::format("the include of '{}' was not found and was left out; give the folder that "
                                  "has '{}' as model_path",
                                  excerpt(uri, 200), excerpt(last_part(uri))));
    return nullptr;
  }
  if (file.depth == deepest_include || ++file.session.includes > most_includes) {
    return bad_input(fmt::format("includes nest more than {} deep, or in a circle, or are more than {}",
                                 deepest_include, most_includes),
                     file.where(include));
  }
  auto text = found ? read_file(*found, most_bytes) : std::string(built_in);
  if (!text) return pass_on(text);
  const std::string path = found.value_or(uri);
  SdfFile included{
      file.session, path, {fs::path(path).parent_path().string(), file.folders.models}, 1.6, file.depth + 1};
  auto parsed = parse_file(included, *text);
  if (!parsed) return pass_on(parsed);
  Element& root = *(*parsed)->RootElement();
  Element* model = root.FirstChildElement("model");
  if (model == nullptr) return nullptr;  // a light or an actor
  std::set<std::string, std::less<>> frames;
  collect_references(*model, frames);
  if (!frames.empty() && (included.version < 1.65) != (file.version < 1.65)) {
    return bad_input(fmt::format("'{}' names frames as SDF {} does; write both files for one version",
                                 excerpt(uri, 200), xml_attribute(root, "version")),
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

/// Moves the models of a file without a world into a new world.
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

void SdfWarnings::add_missing(const std::string& where, const std::string& sentence) {
  if (first_missing_.empty()) first_missing_ = fmt::format("{}: {}", where, sentence);
  add(where, sentence);
}

std::vector<std::string> SdfWarnings::sentences() const {
  std::vector<std::string> result;
  for (const Repair& entry : entries_) {
    const std::string times = entry.count > 1 ? fmt::format(" ({} times, first here)", entry.count) : "";
    result.push_back(fmt::format("{}: {}{}", entry.where, entry.sentence, times));
  }
  return result;
}

Outcome<RepairedSdf> repair_sdf(std::string_view text, const std::string& name, const std::string& model_path,
                                SdfWarnings& warnings) {
  SdfSession session{warnings, {}};
  SdfFile file{session, name, {fs::path(name).parent_path().string(), model_folders(model_path)}};
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
  auto counts = count_elements(root, name);
  if (!counts) return pass_on(counts);
  repaired.counts = std::move(*counts);
  repaired.text = xml_on_same_lines(**document);
  return repaired;
}

}  // namespace outrider
