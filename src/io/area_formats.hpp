// Readers of the area formats of io/cover_area.hpp. They return the rings without conversion of units.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "outrider/io/cover_area.hpp"

namespace outrider {

/// The rings of an area: the boundary first, then the holes.
using AreaRings = std::vector<AreaRing>;

Outcome<AreaRings> rings_from_geojson(std::string_view text, const std::string& name);
Outcome<AreaRings> rings_from_gml(std::string_view text, const std::string& name);
Outcome<AreaRings> rings_from_yaml(std::string_view text, const std::string& name);

}  // namespace outrider
