// One reader for each mesh format; mesh.hpp is the manual.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "outrider/io/mesh/mesh.hpp"

namespace outrider {

Outcome<std::vector<Triangle>> mesh_from_stl(std::string_view bytes, const std::string& name);
Outcome<std::vector<Triangle>> mesh_from_obj(std::string_view text, const std::string& name,
                                             std::string_view part);
Outcome<std::vector<Triangle>> mesh_from_collada(std::string_view text, const std::string& name,
                                                 std::string_view part);

tl::unexpected<Fault> too_many_triangles(const std::string& name);

}  // namespace outrider
