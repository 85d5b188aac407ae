#include "sdf_parts.hpp"

#include <array>

#include "outrider/io/text.hpp"

namespace outrider {
namespace {

/// Replaces every "::" in a name by "_", because sdformat reserves "::".
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

/// Returns true for the names that sdformat keeps for its own frames.
bool is_reserved(std::string_view name) {
  return name == "world" || (name.size() >= 4 && name.starts_with("__") && name.ends_with("__"));
}

/// Collects the poses of the models and links in a saved state. They are in the world frame.
Status read_stated(const SdfFile& file, SdfElement& owner, const std::string& prefix,
                   std::map<std::string, Pose3>& stated) {
  for (SdfElement* child = owner.FirstChildElement(); child != nullptr; child = child->NextSiblingElement()) {
    if (!one_of(child->Name(), {"model", "link"}) || xml_attribute(*child, "name").empty()) continue;
    const std::string path = prefix + without_colons(xml_attribute(*child, "name"));
    if (SdfElement* pose = child->FirstChildElement("pose")) {
      if (auto repaired = repair_pose(file, *pose); !repaired) return repaired;
      std::array<double, 6> v{};
      const auto parts = words(xml_text(*pose));
      for (std::size_t i = 0; i < std::min(parts.size(), v.size()); ++i)
        v[i] = number<double>(parts[i]).value_or(0.0);
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

}  // namespace

Status repair_pose(const SdfFile& file, SdfElement& pose) {
  const auto parts = words(xml_text(pose));
  for (const std::string_view part : parts) {
    if (number<double>(part)) continue;
    return bad_input(fmt::format("'{}' in a <pose> is no finite number", excerpt(part)), file.where(pose));
  }
  const bool quaternion = xml_attribute(pose, "rotation_format") == "quat_xyzw";
  if (parts.empty() || parts.size() == (quaternion ? 7U : 6U)) return {};
  if (parts.size() != 3) {
    return bad_input(fmt::format("a <pose> has {} numbers; expected x y z roll pitch yaw", parts.size()),
                     file.where(pose));
  }
  file.warn(pose, "a <pose> of three numbers was read as a place without a rotation");
  const std::string text =
      fmt::format("{} {} {} {}", parts[0], parts[1], parts[2], quaternion ? "0 0 0 1" : "0 0 0");
  pose.SetText(text.c_str());
  return {};
}

Status read_state(const SdfFile& file, SdfElement& state, std::map<std::string, Pose3>& stated) {
  for (const char* name : {"sim_time", "real_time", "wall_time"}) {
    const SdfElement* time = state.FirstChildElement(name);
    if (time == nullptr) continue;
    const auto parts = words(xml_text(*time));
    const bool pair = parts.size() == 2 && number<std::int64_t>(parts[0]) && number<std::int64_t>(parts[1]);
    if (!pair) file.warn(*time, "a time in <state> is not seconds and nanoseconds and was left out");
  }
  for (const char* name : {"insertions", "deletions"}) {
    const SdfElement* change = state.FirstChildElement(name);
    if (change != nullptr && !change->NoChildren()) {
      file.warn(*change, fmt::format("the <{}> of <state> were left out; save the world again", name));
    }
  }
  return read_stated(file, state, "", stated);
}

bool repair_geometry(const SdfFile& file, SdfElement& collision, const std::string& path) {
  SdfElement* geometry = collision.FirstChildElement("geometry");
  if (geometry == nullptr || geometry->FirstChildElement() == nullptr) {
    file.warn(collision, fmt::format("collision '{}' has no shape and was left out", path));
    return false;
  }
  SdfElement* kept = nullptr;  // in the order of preference of sdformat
  for (const char* kind :
       {"box", "capsule", "cylinder", "ellipsoid", "plane", "sphere", "mesh", "heightmap", "empty"}) {
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
    for (SdfElement *next = nullptr, *shape = geometry->FirstChildElement(); shape != nullptr; shape = next) {
      next = shape->NextSiblingElement();
      if (shape != kept) geometry->DeleteChild(shape);
    }
  }
  if (!one_of(kept->Name(), {"mesh", "heightmap"})) return true;
  const std::string uri(xml_text(*kept, "uri"));
  const auto found = find_uri(uri, file.folders);
  if (!found) {
    file.warn_missing(
        *kept, fmt::format("the {} '{}' of collision '{}' was not found, so the collision was left out",
                           kept->Name(), excerpt(uri, 200), path));
    return false;
  }
  if (kept->FirstChildElement("submesh") != nullptr) {
    file.warn(*kept, fmt::format("collision '{}' asks for a <submesh>; the whole mesh was taken", path));
  }
  kept->FirstChildElement("uri")->SetText(found->c_str());
  return true;
}

void repair_name(const SdfFile& file, SdfElement& element, UniqueNames& taken) {
  const char* attribute = element.Attribute("name");
  if (attribute == nullptr) return;  // sdformat reports this
  std::string wanted = without_colons(attribute);
  if (wanted != attribute) file.warn(element, "'::' in a name was replaced by '_'");
  if (is_reserved(wanted)) {
    file.warn(element, fmt::format("the name '{0}' is reserved and became '{0}_1'", excerpt(wanted)));
    wanted += "_1";
  }
  const std::string name = taken.take(wanted);
  if (name != wanted) {
    file.warn(element, fmt::format("<{}> names its sibling has too got a number", element.Name()));
  }
  if (name != attribute) element.SetAttribute("name", name.c_str());
}

}  // namespace outrider
