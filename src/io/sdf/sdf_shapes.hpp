// Converts the shapes of SDF collisions to shapes of solids.
#pragma once

#include <algorithm>
#include <initializer_list>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "outrider/io/mesh/mesh.hpp"
#include "outrider/world/solid.hpp"
#include "sdf/sdf_files.hpp"

namespace outrider {

inline bool one_of(std::string_view name, std::initializer_list<std::string_view> names) {
  return std::ranges::find(names, name) != names.end();
}

/// A shape and its pose in the collision.
struct SdfPiece {
  Shape shape;
  Pose3 collision_T_piece = {};
  std::string suffix = {};  ///< suffix of its name, if a collision has several pieces
};

/// The mesh files of one world, each read once.
struct SdfMeshes {
  std::map<std::string, std::vector<Triangle>> by_part;  ///< by path, and the part of it
  std::size_t placed = 0;                                ///< number of triangles in the world so far
};

/// Reads the numbers of elements, and keeps the first fault.
class SdfNumbers {
 public:
  explicit SdfNumbers(const SdfFile& file) : file_(file) {}

  /// Returns the numbers of an element, up to three. Fault: bad_input with its place.
  Vec3 of(XmlElement element, std::size_t count);
  /// Returns those of a child or an attribute, or what SDF takes if there is none.
  Vec3 of(XmlElement shape, const char* part, std::size_t count, Vec3 otherwise);
  [[nodiscard]] const std::optional<Fault>& fault() const { return fault_; }

 private:
  Vec3 read(XmlElement element, const char* name, std::string_view text, std::size_t count);

  const SdfFile& file_;
  std::optional<Fault> fault_;
};

/// Returns the shape of a collision, the preferred one of several; none, with a warning, if it has none that
/// is modelled. `name` is for warnings.
XmlElement sdf_shape(SdfFiles& files, const SdfFile& file, XmlElement collision, const std::string& name);

/// Converts a shape; `mesh` is the path of its file, if it is a mesh. Refuses what is no number, sizes that
/// are not above 0 and at most 1e6 m, planes without a direction, meshes that cannot be loaded, and more than
/// 2 million triangles in one world. With a warning, a mesh that lacks the part that is asked for is taken as
/// a whole, and a polyline that encloses nothing is left out.
Outcome<std::vector<SdfPiece>> sdf_pieces(SdfFiles& files, const SdfFile& file, XmlElement shape,
                                          const std::string& mesh, SdfMeshes& meshes);

/// Converts a heightmap at a pose. Black is at its position, white above it by the z of its size. Refuses a
/// pose with a rotation; has the faults of terrain.hpp.
Outcome<HeightField> sdf_terrain(const SdfFile& file, XmlElement heightmap, const std::string& path,
                                 const Pose3& world_T_collision);

}  // namespace outrider
