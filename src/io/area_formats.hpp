// The formats of areas behind io/cover_area.hpp: rings as they stand in the file.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "outrider/io/cover_area.hpp"

namespace outrider {

/// The boundary first, then the holes.
using AreaRings = std::vector<AreaRing>;

Outcome<AreaRings> rings_from_geojson(std::string_view text, const std::string& name);
Outcome<AreaRings> rings_from_gml(std::string_view text, const std::string& name);
Outcome<AreaRings> rings_from_yaml(std::string_view text, const std::string& name);

}  // namespace outrider
