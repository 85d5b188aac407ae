// Areas to cover: polygons with holes, in one of four formats, chosen by the ending of the file name.
//
//   .json .geojson  GeoJSON (RFC 7946): every Polygon and MultiPolygon in it, alone or in features
//   .xml .gml       the first gml:Polygon of a file: outerBoundaryIs and innerBoundaryIs with gml:coordinates
//   .yaml .yml      polygon_coverage_msgs/PolygonWithHoles: polygon: {polygon: {hull:, holes:}}, in metres
//   anything else   the text of io/map/polygons.hpp: boundary, ---, obstacles, which are the holes; in metres
//
// GeoJSON and GML give longitude and latitude in degrees (WGS 84). They are projected to metres east and
// north of the south-west corner of the area (io/map/area_frame.hpp); distances are right within 2e-6 of
// them. A named reference system in the member "crs" of older GeoJSON files decides: CRS84 and geographic
// EPSG codes mean degrees, other EPSG codes metres. Without one, or with one that is not known, numbers that
// span more than 0.2 degrees or exceed their range are metres, and `note` says so. Units overrides all.
// Metres far from the origin, such as UTM coordinates, are moved; `frame` has the way back. Files may be
// gzip-compressed.
//
// Faults: bad_input with file and line, or the position in the JSON. Bounds: those of
// path/visibility/polygon_ground.hpp. cover_ground() checks that the polygons are simple.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "outrider/core/outcome.hpp"
#include "outrider/io/map/area_frame.hpp"

namespace outrider {

enum class Units { told_by_size, degrees, metres };

struct AreaRing {
  std::vector<Vec2> corners;  ///< m; the first corner is not repeated at the end
  std::string where;          ///< file:line, or the position in the JSON
};

struct AreaPolygon {
  AreaRing boundary;
  std::vector<AreaRing> holes;
};

struct CoverArea {
  std::vector<AreaPolygon> polygons;  ///< at least one, in the order of the file
  AreaFrame frame;                    ///< where the local metres are
  std::string note;                   ///< how the numbers were interpreted, if that is uncertain
};

Outcome<CoverArea> load_cover_area(const std::string& path, Units units = Units::told_by_size);
Outcome<CoverArea> cover_area_from_text(std::string_view text, const std::string& name, Units units);

}  // namespace outrider
