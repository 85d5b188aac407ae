// Readers of the area formats of io/map/cover_area.hpp. They return the rings without conversion of units.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "outrider/io/map/cover_area.hpp"

namespace outrider {

/// The rings of a polygon: the boundary first, then the holes.
using AreaRings = std::vector<AreaRing>;

/// The polygons of a file, and what it says of its coordinates.
struct AreaFile {
  std::vector<AreaRings> polygons;
  std::vector<std::string> properties = {};  ///< for each polygon those of its feature as JSON text
  std::string crs = {};                      ///< the member "crs" of GeoJSON as JSON text
  std::string crs_name = {};                 ///< the name in it; empty: none
  Units units = Units::told_by_size;
};

Outcome<AreaFile> area_from_geojson(std::string_view text, const std::string& name);
Outcome<AreaRings> rings_from_gml(std::string_view text, const std::string& name);
Outcome<AreaRings> rings_from_yaml(std::string_view text, const std::string& name);

}  // namespace outrider
