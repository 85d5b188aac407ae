// Triangle meshes: STL (text and binary), Wavefront OBJ and Collada (.dae).
//
// The format is told by the ending of the name, STL's two forms by the content; files may be
// gzip-compressed. Only positions and faces are read. OBJ and Collada polygons become fans of
// triangles. Collada: the nodes of the visual scene with their transforms, and the <unit> of length;
// <up_axis> is ignored, as Gazebo does. Triangles without area are left out.
//
// Errors: bad_input with the file (and line of text formats). Bounds: 64 MiB, a million triangles,
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

/// At least one triangle, in metres where the format has units, else as the file says.
Outcome<std::vector<Triangle>> load_mesh(const std::string& path);
Outcome<std::vector<Triangle>> mesh_from_bytes(std::string_view bytes, const std::string& name);

}  // namespace outrider
