// Areas to cover: one polygon with holes, in one of four formats, chosen by the ending of the file name.
//
//   .json .geojson  GeoJSON (RFC 7946): a Polygon, a Feature or a FeatureCollection with one polygon
//   .xml .gml       the first gml:Polygon of a file: outerBoundaryIs and innerBoundaryIs with gml:coordinates
//   .yaml .yml      polygon_coverage_msgs/PolygonWithHoles: polygon: {polygon: {hull:, holes:}}, in metres
//   anything else   the text of io/polygons.hpp: boundary, ---, obstacles, which are the holes; in metres
//
// GeoJSON and GML give longitude and latitude in degrees (WGS 84). They are converted to metres east and
// north of the south-west corner of the area, with the radii of curvature of the ellipsoid at its middle; the
// error is below 0.1 % for areas up to 10 km. If the area would span more than 0.2 degrees or exceed their
// range, the numbers are assumed to be metres, and `note` says so. Units overrides this choice. Files may be
// gzip-compressed.
//
// Faults: bad_input with file and line, or the position in the JSON. Bounds: those of
// path/visibility/polygon_ground.hpp. cover_ground() checks that the polygons are simple.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "outrider/core/outcome.hpp"
#include "outrider/geometry/vec.hpp"

namespace outrider {

enum class Units { told_by_size, degrees, metres };

struct AreaRing {
  std::vector<Vec2> corners;  ///< m; the first corner is not repeated at the end
  std::string where;          ///< file:line, or the position in the JSON
};

struct CoverArea {
  AreaRing boundary;
  std::vector<AreaRing> holes;
  std::string note;  ///< how the numbers were interpreted, if that is uncertain
};

Outcome<CoverArea> load_cover_area(const std::string& path, Units units = Units::told_by_size);
Outcome<CoverArea> cover_area_from_text(std::string_view text, const std::string& name, Units units);

}  // namespace outrider
