#include "outrider/io/cover_area.hpp"

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
    EXPECT_EQ(area->boundary.corners, (std::vector<Vec2>{{0, 0}, {4, 0}, {4, 3}, {0, 3}})) << name;
    ASSERT_EQ(area->holes.size(), 1U) << name;
    EXPECT_EQ(area->holes[0].corners, (std::vector<Vec2>{{1, 1}, {2, 1}, {2, 2}, {1, 2}})) << name;
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
  refused("a.gml", "<a>\n<b/></a>", "a.gml");
  refused("a.gml", "<a>\n<gml:Polygon>\n</gml:Polygon></a>", "a.gml:2");
  refused("a.yaml", "hull: 3\n", "a.yaml:1");
  refused("a.yaml", "hull:\n  points:\n  - {x: 1}\n", "a.yaml:3");
  refused("a.txt", "(0,0) (1,0) oops\n---\n", "a.txt:1");
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
