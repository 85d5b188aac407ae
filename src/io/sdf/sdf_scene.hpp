// The frames and collisions of an SDF world, and the poses of its collisions (http://sdformat.org/spec, pose
// frame semantics). See sdf.hpp.
#pragma once

#include <fmt/format.h>

#include <array>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "outrider/geometry/spatial_pose.hpp"
#include "sdf/sdf_files.hpp"

namespace outrider {

inline constexpr std::size_t no_index = static_cast<std::size_t>(-1);

/// Gives each name only once.
class UniqueNames {
 public:
  /// Returns the wanted name, or the first free one of name_2, name_3 ... Apart from the look-up, repeated
  /// requests for the same name take constant time.
  std::string take(const std::string& wanted) {
    if (taken_.insert(wanted).second) return wanted;
    std::size_t& number = next_.try_emplace(wanted, 2).first->second;
    for (;; ++number) {
      std::string name = fmt::format("{}_{}", wanted, number);
      if (taken_.insert(name).second) return name;
    }
  }

 private:
  std::set<std::string> taken_;
  std::map<std::string, std::size_t> next_;  // by wanted name: all numbers from 2 to below this one are taken
};

/// The world (the first of its scene) or a model: frames that see each other by name.
struct SdfScope {
  std::size_t parent = no_index;
  std::size_t frame = no_index;  ///< its own frame, in the parent
  std::string name;              ///< with the names of the enclosing models, as "a/b"
  std::string key;               ///< the same in a saved state, as "a::b"
  bool merged = false;           ///< true if its frames are known in the parent, too
  int depth = 0;
  std::map<std::string, std::size_t, std::less<>> frames;  ///< by name
  UniqueNames taken;
};

/// A link, frame, joint or model.
struct SdfFrame {
  const SdfFile* file = nullptr;
  XmlElement element;
  std::string name;
  std::size_t scope = 0;          ///< the scope that it stands in
  std::size_t inside = no_index;  ///< the scope of a model
  std::string relative_to;        ///< empty: the frame of its scope
  std::string placement;          ///< the frame of a model that its pose places; empty: its own
  Pose3 pose;
};

struct SdfCollision {
  const SdfFile* file = nullptr;
  XmlElement shape;      ///< such as <box>
  std::string mesh;      ///< path of the file of a mesh or a heightmap
  std::size_t link = 0;  ///< the frame of its link
  std::string name;
  std::string relative_to;  ///< empty: its link
  Pose3 pose;
};

struct SdfScene {
  std::vector<SdfScope> scopes = {SdfScope{}};  ///< parents come before their models
  std::vector<SdfFrame> frames;
  std::vector<SdfCollision> collisions;  ///< by scope
  std::map<std::string, Pose3> stated;   ///< world poses from <state>, by "model::nested::link"
  std::string name;
  Vec3 gravity = {0.0, 0.0, -9.8};
  bool bare = false;  ///< true if there was no <world>
};

/// Collects the frames and collisions of the first world of a file, or of its models if it has none, and of
/// all that it includes; repairs what is slightly broken. Faults: bad_input with file:line. O(tags of the
/// files, as often as they are included); no recursion.
Outcome<SdfScene> scan_sdf(SdfFiles& files, const SdfFile& file);

/// Returns the rotation of a quaternion (x, y, z, w); of zero, none.
Rotation rotation_of(std::array<double, 4> q);

/// Returns the quaternion (x, y, z, w) of fixed-axis roll, pitch, yaw.
std::array<double, 4> quaternion_of(double roll_rad, double pitch_rad, double yaw_rad);

/// Returns world_T_collision of every collision. Faults: bad_input with the place of a frame whose pose is
/// relative to a frame that does not exist, or to itself. O((frames + collisions) (depth + log frames)); no
/// recursion.
Outcome<std::vector<Pose3>> collision_poses(const SdfScene& scene);

/// Returns the poses of the frames of a scope in it, by name. Faults: those of collision_poses().
Outcome<std::map<std::string, Pose3, std::less<>>> frame_poses(const SdfScene& scene, std::size_t scope);

}  // namespace outrider
