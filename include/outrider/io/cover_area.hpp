// Areas to cover: one polygon with holes, from four formats told by the end of the name.
//
//   .json .geojson  GeoJSON (RFC 7946): a Polygon, a Feature or a FeatureCollection with one polygon
//   .xml .gml       the first gml:Polygon of a file: outerBoundaryIs and innerBoundaryIs of gml:coordinates
//   .yaml .yml      polygon_coverage_msgs/PolygonWithHoles: polygon: {polygon: {hull:, holes:}}, in metres
//   anything else   the text of io/polygons.hpp: boundary, ---, obstacles, which are the holes; in metres
//
// GeoJSON and GML give degrees of longitude and latitude (WGS 84). They become metres east and north of the
// south-west corner of the area by the radii of curvature of the ellipsoid in the middle of it: within 0.1 %
// for areas up to 10 km. Where the numbers as degrees would span more than 0.2 of them they are taken for
// metres, and `note` says so; Units says otherwise. Files may be gzip-compressed.
//
// Errors: bad_input with the file and the line, or the place in the JSON. Bounds: those of
// path/polygon_ground.hpp. Whether the polygons are simple is asked by cover_ground().
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "outrider/core/outcome.hpp"
#include "outrider/geometry/vec.hpp"

namespace outrider {

enum class Units { told_by_size, degrees, metres };

struct AreaRing {
  std::vector<Vec2> corners;  ///< m, without the first again at the end
  std::string where;          ///< file:line, or the place in the JSON
};

struct CoverArea {
  AreaRing boundary;
  std::vector<AreaRing> holes;
  std::string note;  ///< how numbers were understood, where that is not certain
};

Outcome<CoverArea> load_cover_area(const std::string& path, Units units = Units::told_by_size);
Outcome<CoverArea> cover_area_from_text(std::string_view text, const std::string& name, Units units);

}  // namespace outrider
