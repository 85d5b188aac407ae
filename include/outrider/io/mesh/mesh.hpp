// Triangle meshes: STL (text and binary), Wavefront OBJ and Collada (.dae).
//
// The format is chosen by the ending of the name; the two forms of STL are distinguished by the content.
// Files may be gzip-compressed. Only positions and faces are read. Polygons in OBJ and Collada become fans of
// triangles. In Collada, the nodes of the visual scene with their transforms and the <unit> of length are
// used; <up_axis> is ignored, as in Gazebo. Triangles without area are skipped. A part of a mesh goes by the
// name of an object or a group (OBJ), or by the name or the id of a node or a geometry (Collada); the parts
// of STL have no names.
//
// Faults: bad_input with the file (and the line, for text formats). Bounds: 64 MiB, a million triangles,
// coordinates within 1e6. O(length of the file + triangles).
#pragma once

#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "outrider/core/outcome.hpp"
#include "outrider/geometry/vec.hpp"

namespace outrider {

using Triangle = std::array<Vec3, 3>;

inline constexpr std::size_t most_triangles = 1'000'000;

/// Loads at least one triangle of the whole mesh, or of its part with that name. Coordinates are in metres if
/// the format has units, else as in the file.
Outcome<std::vector<Triangle>> load_mesh(const std::string& path, std::string_view part = "");
Outcome<std::vector<Triangle>> mesh_from_bytes(std::string_view bytes, const std::string& name,
                                               std::string_view part = "");

}  // namespace outrider
