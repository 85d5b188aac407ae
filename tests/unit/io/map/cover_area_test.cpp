#include "outrider/io/map/cover_area.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "support/data.hpp"
#include "support/random_cases.hpp"

namespace outrider {
namespace {

const char* const room_json =
    R"({"type": "Polygon", "coordinates": [[[0,0],[4,0],[4,3],[0,3],[0,0]], [[1,1],[2,1],[2,2],[1,2],[1,1]]]})";
const char* const room_gml =
    "<parcel xmlns:gml=\"g\">\n<gml:Polygon>\n<gml:outerBoundaryIs><gml:LinearRing><gml:coordinates>0,0 4,0 "
    "4,3 "
    "0,3 0,0</gml:coordinates></gml:LinearRing></gml:outerBoundaryIs>\n<gml:innerBoundaryIs><gml:LinearRing>"
    "<gml:coordinates>1,1,0 2,1,0 2,2,0 1,2,0 "
    "1,1,0</gml:coordinates></gml:LinearRing></gml:innerBoundaryIs>\n"
    "</gml:Polygon></parcel>";
const char* const room_yaml =
    "polygon:\n  polygon:\n    hull:\n      points: [{x: 0, y: 0, z: 1}, {x: 4, y: 0}, {x: 4, y: 3}, {x: 0, "
    "y: 3}]\n"
    "    holes:\n    - points: [{x: 1, y: 1}, {x: 2, y: 1}, {x: 2, y: 2}, {x: 1, y: 2}]\n";
const char* const room_text = "(0,0) (4,0) (4,3) (0,3)\n---\n(1,1) (2,1) (2,2) (1,2)\n";

TEST(CoverArea, FourFormatsOneRoom) {
  for (const auto& [name, text] : {std::pair{"a.json", room_json}, std::pair{"a.gml", room_gml},
                                   std::pair{"a.yaml", room_yaml}, std::pair{"a.txt", room_text}}) {
    const auto area = cover_area_from_text(text, name, Units::metres);
    ASSERT_TRUE(area) << to_string(area.error());
    ASSERT_EQ(area->polygons.size(), 1U) << name;
    const AreaPolygon& polygon = area->polygons.front();
    EXPECT_EQ(polygon.boundary.corners, (std::vector<Vec2>{{0, 0}, {4, 0}, {4, 3}, {0, 3}})) << name;
    ASSERT_EQ(polygon.holes.size(), 1U) << name;
    EXPECT_EQ(polygon.holes[0].corners, (std::vector<Vec2>{{1, 1}, {2, 1}, {2, 2}, {1, 2}})) << name;
  }
}

TEST(CoverArea, BadInputIsRefusedWithItsPlace) {
  const auto refused = [](const char* name, const std::string& text, const std::string& where) {
    const auto area = cover_area_from_text(text, name, Units::told_by_size);
    ASSERT_FALSE(area) << text;
    EXPECT_EQ(area.error().code, FaultCode::bad_input);
    EXPECT_EQ(area.error().where, where) << area.error().sentence;
  };
  refused("a.json", "{", "a.json");
  refused("a.json", R"({"type":"FeatureCollection","features":[]})", "a.json");
  refused("a.json", R"({"type":"Polygon","coordinates":[[[0,0],[1,"x"]]]})", "a.json: $.coordinates[0][1]");
  refused("a.json", R"({"type":"Polygon","coordinates":[[[0,0],[1,0],[0,0]]]})", "a.json: $.coordinates[0]");
  refused("a.json", R"({"type":"Polygon","coordinates":[[[0,0],[1e9,0],[1,1]]]})",
          "a.json: $.coordinates[0]");
  const std::string nested = std::string(300'000, '[') + std::string(300'000, ']');
  refused("a.json", nested, "a.json");
  refused("a.json",
          R"({"type":"Polygon","coordinates":[[[0,0],[1,0],[1,1]]],"crs":{"properties":{"name":"x","deep":)" +
              nested + "}}}",
          "a.json");
  refused("a.gml", "<a>\n<b/></a>", "a.gml");
  refused("a.gml", "<a>\n<gml:Polygon>\n</gml:Polygon></a>", "a.gml:2");
  refused("a.yaml", "hull: 3\n", "a.yaml:1");
  refused("a.yaml", "hull:\n  points:\n  - {x: 1}\n", "a.yaml:3");
  refused("a.txt", "(0,0) (1,0) oops\n---\n", "a.txt:1");
}

TEST(CoverArea, AHoleThatIsGivenAgainIsOne) {
  const std::string room = "(0,0) (9,0) (9,9) (0,9)\n---\n(1,1) (2,1) (2,2) (1,2)\n";
  const auto holes = [&](const std::string& more) {
    const auto area = cover_area_from_text(room + more, "a.txt", Units::told_by_size);
    EXPECT_TRUE(area) << to_string(area.error());
    return area ? area->polygons.at(0).holes.size() : 0;
  };
  EXPECT_EQ(holes("(1,1) (2,1) (2,2) (1,2)\n"), 1U);
  EXPECT_EQ(holes("(2,2) (1,2) (1,1) (2,1)\n(1,2) (2,2) (2,1) (1,1)\n"), 1U)
      << "from another corner, the other way";
  EXPECT_EQ(holes("(1,1) (2,1) (2,2)\n"), 2U);
  EXPECT_EQ(holes("(3,1) (4,1) (4,2) (3,2)\n"), 2U);
}

TEST(CoverArea, UtmCoordinatesAreMoved) {
  const auto area = cover_area_from_text(
      R"({"type": "Polygon", "coordinates": [[[456789.5,5428123],[456989.5,5428123],[456989.5,5428223]]],
          "crs": {"type": "name", "properties": {"name": "urn:ogc:def:crs:EPSG::25832"}}})",
      "utm.geojson", Units::told_by_size);
  ASSERT_TRUE(area) << to_string(area.error());
  EXPECT_EQ(area->frame.origin, (Vec2{456789.0, 5428123.0}));
  EXPECT_EQ(area->polygons.front().boundary.corners, (std::vector<Vec2>{{0.5, 0}, {200.5, 0}, {200.5, 100}}));
  EXPECT_NE(area->frame.crs.find("25832"), std::string::npos);
  EXPECT_EQ(area->note, "") << "no degrees are so large";
}

/// A triangle as wide as that, from (8, 49) on, in a file whose member "crs" has that name; "": no member.
Outcome<CoverArea> triangle(const std::string& crs, double wide) {
  const std::string member = R"(, "crs": {"type": "name", "properties": {"name": ")" + crs + "\"}}";
  return cover_area_from_text(
      fmt::format(R"({{"type": "Polygon", "coordinates": [[[8,49],[{0},49],[{0},{1}]]]{2}}})", 8.0 + wide,
                  49.0 + wide, crs.empty() ? "" : member),
      "a.geojson", Units::told_by_size);
}

TEST(CoverArea, TheReferenceSystemOfTheFileDecides) {
  for (const char* crs : {"urn:ogc:def:crs:OGC:1.3:CRS84", "EPSG:4326", "urn:ogc:def:crs:EPSG::4258",
                          "http://www.opengis.net/def/crs/EPSG/0/4326", "EPSG:7844"}) {
    const auto area = triangle(crs, 0.08);
    ASSERT_TRUE(area) << to_string(area.error());
    EXPECT_TRUE(area->frame.degrees) << crs;
    EXPECT_EQ(area->note, "") << crs;
    const auto wide = triangle(crs, 0.8);
    ASSERT_FALSE(wide);
    EXPECT_NE(wide.error().sentence.find("(58537.4, 0) m"), std::string::npos) << "not 0.8 m";
  }
  for (const char* crs : {"EPSG:32632", "urn:ogc:def:crs:EPSG::25832", "EPSG:3857", "EPSG:28992"}) {
    for (const double wide : {0.08, 80.0, 800.0}) {
      const auto area = triangle(crs, wide);
      ASSERT_TRUE(area) << to_string(area.error());
      EXPECT_FALSE(area->frame.degrees) << crs;
      EXPECT_EQ(area->note, "") << crs;
    }
  }
  EXPECT_FALSE(triangle("EPSG:4326", 80.0)) << "an area 80 degrees wide";
}

/// RFC 7946: without a reference system the numbers are degrees. Those that cannot be are metres.
TEST(CoverArea, SizeDecidesOnlyWithAWarning) {
  const auto small = triangle("", 0.08);
  ASSERT_TRUE(small);
  EXPECT_TRUE(small->frame.degrees);
  EXPECT_EQ(small->note, "");
  for (const double wide : {0.8, 40.0, 500.0}) {
    const auto area = triangle("", wide);
    ASSERT_TRUE(area);
    EXPECT_FALSE(area->frame.degrees) << wide;
    EXPECT_NE(area->note.find("taken for metres by their size, as no 'crs' says otherwise"),
              std::string::npos)
        << area->note;
  }
  for (const char* crs : {"local grid", "EPSG:4647", "EPSG:four"}) {
    for (const double wide : {0.08, 80.0}) {
      const auto area = triangle(crs, wide);
      ASSERT_TRUE(area);
      EXPECT_EQ(area->frame.degrees, wide < 1.0) << crs;
      EXPECT_NE(area->note.find(crs), std::string::npos) << area->note;
      EXPECT_NE(area->note.find(wide < 1.0 ? "taken for degrees" : "taken for metres"), std::string::npos);
    }
  }
}

TEST(CoverArea, EveryPolygonOfGeoJsonInItsOrder) {
  const auto area = cover_area_from_text(
      R"({"type": "FeatureCollection", "features": [
          {"type": "Feature", "geometry": {"type": "Point", "coordinates": [7, 7]}},
          {"type": "Feature", "geometry": {"type": "MultiPolygon", "coordinates": [
            [[[0,0],[4,0],[4,4],[0,4],[0,0]], [[1,1],[2,1],[2,2],[1,1]]], [[[5,0],[6,0],[6,1]]]]}},
          {"type": "Feature", "geometry": {"type": "Polygon", "coordinates": [[[8,0],[9,0],[9,1]]]}}]})",
      "a.json", Units::metres);
  ASSERT_TRUE(area) << to_string(area.error());
  ASSERT_EQ(area->polygons.size(), 3U);
  EXPECT_EQ(area->polygons[0].holes.size(), 1U);
  EXPECT_EQ(area->polygons[1].boundary.where, "a.json: $.features[1].geometry.coordinates[1][0]");
  EXPECT_EQ(area->polygons[2].boundary.corners.front(), (Vec2{8, 0}));
}

/// Damaged files are answered, not crashed on.
TEST(CoverArea, DamagedFilesAreAnswered) {
  Rng rng(7);
  for (int k = 0; k < testing::cases(200); ++k) {
    for (const auto& [name, text] : {std::pair{"a.json", room_json}, std::pair{"a.gml", room_gml},
                                     std::pair{"a.yaml", room_yaml}, std::pair{"a.txt", room_text}}) {
      const auto area = cover_area_from_text(test::damaged(text, rng), name, Units::told_by_size);
      EXPECT_TRUE(area || !area.error().sentence.empty());
    }
  }
}

}  // namespace
}  // namespace outrider
