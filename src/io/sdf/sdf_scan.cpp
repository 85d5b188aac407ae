#include "sdf/sdf_scene.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "outrider/io/files/text.hpp"
#include "sdf/sdf_shapes.hpp"

namespace outrider {
namespace {

constexpr std::size_t most_parts = 200'000;
constexpr std::size_t most_name_bytes = std::size_t{64} << 20;
constexpr int deepest_model = 100;
constexpr int deepest_include = 8;

/// Replaces every "::" in a name by "_", because SDF reserves "::".
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

/// Returns true for the names that SDF keeps for its own frames.
bool is_reserved(std::string_view name) {
  return name == "world" || (name.size() >= 4 && name.starts_with("__") && name.ends_with("__"));
}

std::string joined(const std::string& outer, std::string_view between, std::string_view name) {
  return outer.empty() ? std::string(name) : fmt::format("{}{}{}", outer, between, name);
}

/// The elements of a scope that are still to be read.
struct OpenElements {
  const SdfFile* file;
  XmlElement next;
  std::size_t scope;
  int includes;  ///< number of files around it
};

/// An element and its file.
struct SdfPart {
  const SdfFile* file;
  XmlElement element;

  [[nodiscard]] SdfPart child(const char* name) const { return {file, element.child(name)}; }
  [[nodiscard]] std::string where() const { return file->document.where(element); }
  [[nodiscard]] std::string attribute(const char* name) const {
    return std::string(xml_attribute(element, name));
  }
};

/// Reads element by element until nothing is left or something is refused.
class Scan {
 public:
  explicit Scan(SdfFiles& files) : files_(files) {}

  Outcome<SdfScene> world_of(const SdfFile& file) {
    const SdfPart root{&file, file.document.root()};
    SdfPart world = root.child("world");
    scene_.bare = !world.element;
    if (scene_.bare) {
      world = {&file, file.is_urdf() ? XmlElement() : root.element};
      scene_.name = "yard";
    } else {
      if (const XmlElement other = world.element.next_sibling("world"))
        warn({&file, other}, "only the first <world> was read");
      UniqueNames taken;
      scene_.name = unique_name(world, taken, world.attribute("name"));
    }
    for (const XmlElement state : world.element.children("state")) read_state({&file, state});
    open_.push_back({&file, world.element.first_child(), 0, 0});
    if (file.is_urdf()) add_model(open_.back(), {root, {&file, {}}, root.attribute("name"), "", false, 0});
    while (!open_.empty() && !fault_) {
      const OpenElements at = open_.back();
      if (!at.next) {
        open_.pop_back();
      } else {
        open_.back().next = at.next.next_sibling();
        read_child(at, {at.file, at.next});
      }
    }
    if (fault_) return tl::unexpected(*fault_);
    std::ranges::stable_sort(scene_.collisions, {},
                             [this](const SdfCollision& one) { return scene_.frames[one.link].scope; });
    return std::move(scene_);
  }

 private:
  void warn(const SdfPart& part, const std::string& sentence) { files_.warnings.add(part.where(), sentence); }
  void refuse(const SdfPart& part, const std::string& sentence) {
    if (!fault_) fault_ = Fault{FaultCode::bad_input, sentence, part.where()};
  }

  void read_child(const OpenElements& at, const SdfPart& part) {
    const std::string_view kind = part.element.name();
    if (kind == "model") {
      add_model(at, {part, part.child("pose"), part.attribute("name"), part.attribute("placement_frame"),
                     false, at.includes});
    } else if (kind == "include") {
      add_include(at, part);
    } else if (kind == "link" && at.scope != 0) {
      add_link(at.scope, part);
    } else if ((kind == "frame" || kind == "joint") && !at.file->is_urdf()) {
      add_frame(at.scope, part);
    } else if (at.scope == 0 && kind == "gravity") {
      read_gravity(part);
    } else if (at.scope == 0 && kind == "physics" && at.file->version < 106) {
      read_gravity(part.child("gravity"));
    } else if (kind == "population") {
      warn(part, "a <population> was left out; place its models one by one");
    } else {
      warn_of_macro(part);
    }
  }

  void read_gravity(const SdfPart& part) {
    if (!part.element) return;
    SdfNumbers numbers(*part.file);
    scene_.gravity = numbers.of(part.element, 3);
    if (numbers.fault()) fault_ = numbers.fault();
  }

  void warn_of_macro(const SdfPart& part) {
    const std::string_view kind = part.element.name();
    if (kind.find(':') != std::string_view::npos)
      warn(part, fmt::format("a left-over <{}> was left out", excerpt(kind)));
  }

  // ---- Poses and names

  /// Reads a <pose>, with a warning if it is repaired; the identity if there is none.
  Pose3 pose_of(const SdfPart& pose) {
    const bool quaternion = pose.attribute("rotation_format") == "quat_xyzw";
    std::array<double, 8> v = {0, 0, 0, 0, 0, 0, quaternion ? 1.0 : 0.0, 0};
    std::string text(xml_text(pose.element));
    if (one_of(pose.element.name(), {"origin"})) {  // of URDF
      const auto three = [&](const char* name) { return pose.element.attribute(name).as_string("0 0 0"); };
      text = fmt::format("{} {}", three("xyz"), three("rpy"));
    }
    const auto parts = words(text, v.size());
    for (std::size_t i = 0; i < parts.size(); ++i) {
      const auto value = number<double>(parts[i]);
      if (!value) refuse(pose, fmt::format("'{}' in a <pose> is no finite number", excerpt(parts[i])));
      v[i] = value.value_or(0.0);
    }
    if (parts.size() == 3) {
      warn(pose, "a <pose> of three numbers was read as a place without a rotation");
    } else if (!parts.empty() && parts.size() != (quaternion ? 7U : 6U)) {
      refuse(pose, fmt::format("a <pose> has {} numbers; expected x y z roll pitch yaw", parts.size()));
    }
    const double unit = pose.element.attribute("degrees").as_bool() ? radians(1.0) : 1.0;
    return {{v[0], v[1], v[2]},
            rotation_of(quaternion ? std::array{v[3], v[4], v[5], v[6]}
                                   : quaternion_of(unit * v[3], unit * v[4], unit * v[5]))};
  }

  /// Returns the name of the frame that a pose is relative to.
  static std::string base_of(const SdfPart& pose) {
    const std::string old = pose.file->version < 107 ? pose.attribute("frame") : "";
    return old.empty() ? pose.attribute("relative_to") : old;
  }

  /// Makes a name unique among those of its siblings, without "::".
  std::string unique_name(const SdfPart& part, UniqueNames& taken, std::string_view given) {
    std::string wanted = without_colons(given);
    if (wanted != given) warn(part, "'::' in a name was replaced by '_'");
    if (wanted.empty()) {
      wanted = part.element.name();
      warn(part, fmt::format("a <{0}> without a name was called '{0}'", wanted));
    }
    if (is_reserved(wanted)) {
      warn(part, fmt::format("the name '{0}' is reserved and became '{0}_1'", excerpt(wanted)));
      wanted += "_1";
    }
    std::string name = taken.take(wanted);
    if (name != wanted)
      warn(part, fmt::format("<{}> names its sibling has too got a number", part.element.name()));
    return name;
  }

  /// Counts a part and its names, before they take memory.
  void count(const SdfPart& part, std::size_t name_bytes) {
    name_bytes_ += name_bytes;
    if (++parts_ > most_parts) {
      refuse(part, fmt::format("it has more than {} models, links, collisions, frames and joints with what "
                               "it includes; join small shapes in a mesh, or cut the world in two",
                               most_parts));
    } else if (name_bytes_ > most_name_bytes) {
      refuse(part, fmt::format("the names of its parts, with those of the models around them, have more than "
                               "{} bytes; shorten them",
                               most_name_bytes));
    }
  }

  // ---- Frames and collisions

  /// Adds a frame to its scope, and to those that the scope is merged into. Returns its index.
  std::size_t add(SdfFrame frame, std::string_view given) {
    const std::size_t index = scene_.frames.size();
    std::size_t owner = frame.scope;
    while (scene_.scopes[owner].merged) owner = scene_.scopes[owner].parent;
    const SdfPart part{frame.file, frame.element};
    count(part, given.size() + scene_.scopes[owner].name.size());
    frame.name = unique_name(part, scene_.scopes[owner].taken, given);
    for (std::size_t at = frame.scope;; at = scene_.scopes[at].parent) {
      scene_.scopes[at].frames.emplace(frame.name, index);
      scene_.scopes[at].frames.emplace(given, index);
      if (at == owner) break;
    }
    scene_.frames.push_back(std::move(frame));
    return index;
  }

  void add_frame(std::size_t scope, const SdfPart& part) {
    const SdfPart pose = part.child("pose");
    const std::string_view otherwise = one_of(part.element.name(), {"joint"})
                                           ? xml_text(part.element, "child")
                                           : xml_attribute(part.element, "attached_to");
    const std::string base = base_of(pose);
    add({part.file,
         part.element,
         {},
         scope,
         no_index,
         base.empty() ? std::string(otherwise) : base,
         {},
         pose_of(pose)},
        part.attribute("name"));
  }

  void add_link(std::size_t scope, const SdfPart& part) {
    const std::string given = part.attribute("name");
    SdfPart pose = part.child("pose");
    std::string base = base_of(pose);
    if (const auto joint = joints_.find({part.file, given}); joint != joints_.end()) {
      pose = {part.file, joint->second.child("origin")};
      base = xml_attribute(joint->second.child("parent"), "link");
    }
    const std::size_t link =
        add({part.file, part.element, {}, scope, no_index, base, {}, pose_of(pose)}, given);
    const std::string path = joined(scene_.scopes[scope].name, "/", scene_.frames[link].name);
    UniqueNames taken;
    for (const XmlElement child : part.element.children()) {
      if (child.name() == std::string_view("collision")) {
        add_collision({part.file, child}, link, path, taken);
      } else {
        warn_of_macro({part.file, child});
      }
      if (fault_) return;
    }
  }

  void add_collision(const SdfPart& part, std::size_t link, const std::string& path, UniqueNames& taken) {
    const bool is_urdf = part.file->is_urdf();  // whose collisions have no names as a rule
    const std::string own = part.attribute("name");
    const std::string given = is_urdf && own.empty() ? "collision" : own;
    count(part, path.size() + given.size());
    const SdfPart pose = part.child(is_urdf ? "origin" : "pose");
    SdfCollision collision{part.file,     {},           {}, link, unique_name(part, taken, given),
                           base_of(pose), pose_of(pose)};
    const std::string name = path + '/' + collision.name;
    collision.shape = sdf_shape(files_, *part.file, part.element, name);
    if (!collision.shape) return;
    if (one_of(collision.shape.name(), {"mesh", "heightmap"})) {
      const std::string_view uri =
          is_urdf ? xml_attribute(collision.shape, "filename") : xml_text(collision.shape, "uri");
      const auto found = files_.find(uri, part.file->folder);
      if (!found) {
        files_.warnings.add_missing(
            part.file->document.where(collision.shape),
            fmt::format("the {} '{}' of collision '{}' was not found, so the collision was left out",
                        collision.shape.name(), excerpt(uri, 200), name));
        return;
      }
      collision.mesh = *found;
    }
    scene_.collisions.push_back(std::move(collision));
  }

  // ---- Models

  /// A model, as an <include> may change it.
  struct Model {
    SdfPart part;
    SdfPart pose;
    std::string name;
    std::string placement;
    bool merge = false;
    int includes = 0;
  };

  void add_include(const OpenElements& at, const SdfPart& part) {
    const auto file = files_.include(*part.file, part.element);
    if (!file) fault_ = file.error();
    if (!file || *file == nullptr) return;
    if (at.includes == deepest_include) {
      return refuse(part, fmt::format("includes nest more than {} deep, or in a circle", deepest_include));
    }
    const SdfPart model{*file, (*file)->model()};
    const auto has = [&](const char* kind) { return !model.child(kind).element.empty(); };
    if (!has("link") && !has("model") && !has("include")) return;  // a light or an actor
    const auto either = [&](std::string_view here, const char* there) {
      return here.empty() ? model.attribute(there) : std::string(here);
    };
    add_model(at, {model, part.child("pose").element ? part.child("pose") : model.child("pose"),
                   either(xml_text(part.element, "name"), "name"),
                   either(xml_text(part.element, "placement_frame"), "placement_frame"),
                   part.element.attribute("merge").as_bool(), at.includes + 1});
  }

  void add_model(const OpenElements& at, const Model& model) {
    const SdfScope& outer = scene_.scopes[at.scope];
    if (outer.depth == deepest_model)
      return refuse(model.part, fmt::format("its models nest more than {} deep; put models beside each other",
                                            deepest_model));
    const bool merge = model.merge && (at.scope != 0 || !model.part.child("link").element);
    if (model.merge && !merge)
      warn({at.file, at.next}, "a model with links cannot be merged into a world; it stays a model");
    SdfScope scope{at.scope, scene_.frames.size(), outer.name, outer.key, merge, outer.depth + 1, {}, {}};
    const std::size_t inside = scene_.scopes.size();
    const std::size_t frame = add({model.part.file,
                                   model.part.element,
                                   {},
                                   at.scope,
                                   inside,
                                   base_of(model.pose),
                                   model.placement,
                                   pose_of(model.pose)},
                                  merge ? fmt::format("_merged__{}__model__", model.name) : model.name);
    if (!merge) {
      scope.name = joined(scope.name, "/", scene_.frames[frame].name);
      scope.key = joined(scope.key, "::", scene_.frames[frame].name);
    }
    scene_.scopes.push_back(std::move(scope));
    if (model.part.file->is_urdf()) {
      for (const XmlElement joint : model.part.element.children("joint"))
        joints_.emplace(std::pair(model.part.file, xml_attribute(joint.child("child"), "link")), joint);
    }
    open_.push_back({model.part.file, model.part.element.first_child(), inside, model.includes});
  }

  // ---- Saved states

  void read_state(const SdfPart& state) {
    for (const char* name : {"sim_time", "real_time", "wall_time"}) {
      const SdfPart time = state.child(name);
      const auto parts = words(xml_text(time.element), 3);
      const bool pair = parts.size() == 2 && number<std::int64_t>(parts[0]) && number<std::int64_t>(parts[1]);
      if (time.element && !pair)
        warn(time, "a time in <state> is not seconds and nanoseconds and was left out");
    }
    for (const char* name : {"insertions", "deletions"}) {
      const SdfPart change = state.child(name);
      if (change.element.first_child())
        warn(change, fmt::format("the <{}> of <state> were left out; save the world again", name));
    }
    std::vector<std::pair<XmlElement, std::string>> open = {{state.element.first_child(), ""}};
    while (!open.empty() && !fault_) {
      const auto [child, prefix] = open.back();
      open.back().first = child.next_sibling();
      if (!child) open.pop_back();
      const SdfPart part{state.file, child};
      if (!one_of(child.name(), {"model", "link"}) || part.attribute("name").empty()) continue;
      open.emplace_back(child.first_child(), joined(prefix, "::", without_colons(part.attribute("name"))));
      count(part, open.back().second.size());
      read_stated(part, open.back().second);
    }
  }

  /// Reads the saved pose of a model or a link, which is in the frame of the world.
  void read_stated(const SdfPart& part, const std::string& key) {
    if (part.child("pose").element) scene_.stated.emplace(key, pose_of(part.child("pose")));
    const auto factors = words(xml_text(part.element, "scale"), 3);
    if (std::ranges::any_of(factors, [](std::string_view factor) { return number<double>(factor) != 1.0; }))
      warn(part, "a <scale> in <state> was not applied; sizes are those of the models");
  }

  SdfFiles& files_;
  SdfScene scene_;
  std::vector<OpenElements> open_;
  std::map<std::pair<const SdfFile*, std::string_view>, XmlElement> joints_;  // of URDF, by the link below
  std::optional<Fault> fault_;
  std::size_t parts_ = 0;
  std::size_t name_bytes_ = 0;
};

}  // namespace

Outcome<SdfScene> scan_sdf(SdfFiles& files, const SdfFile& file) { return Scan(files).world_of(file); }

}  // namespace outrider
