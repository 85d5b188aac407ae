#include "outrider/io/cover_area.hpp"

#include <gtest/gtest.h>

#include "data.hpp"
#include "outrider/cover/plan.hpp"
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

/// The parcel states its area: 17.2581 ha.
TEST(CoverArea, DegreesBecomeMetres) {
  const auto file = test::data_folder() / "slam" / "coverage" / "f2c_Envelope.xml";
  OUTRIDER_NEEDS_DATA(file);
  const auto area = load_cover_area(file.string());
  ASSERT_TRUE(area) << to_string(area.error());
  EXPECT_NEAR(area_of(region_of(area->boundary.corners, {})), 172581.0, 0.002 * 172581.0);
}

/// Every polygon of the published data, covered by every method with a robot of a size that suits it.
TEST(CoverArea, EveryPublishedPolygonIsCovered) {
  const auto folder = test::data_folder() / "slam" / "coverage";
  OUTRIDER_NEEDS_DATA(folder);
  const std::pair<const char*, double> files[] = {{"ethz_example_l.yaml", 0.08},
                                                  {"ethz_example_polygon_bcd_cell.yaml", 6.0},
                                                  {"f2c_test_ring.json", 0.6},
                                                  {"ethz_example_rectangle_with_hole.yaml", 8.0},
                                                  {"f2c_test.json", 12.0},
                                                  {"f2c_Envelope.xml", 24.0},
                                                  {"ethz_example_polygon_epfl.yaml", 3.0},
                                                  {"f2c_test1.xml", 39.0}};
  const bool whole = testing::cases(1) > 1;
  for (const auto& [name, width] : files) {
    const auto area = load_cover_area((folder / name).string());
    ASSERT_TRUE(area) << to_string(area.error());
    if (!whole && area->holes.size() > 2) continue;  // the forest is covered by the test of the command line
    CoverProblem problem;
    problem.boundary = area->boundary.corners;
    for (const AreaRing& hole : area->holes) problem.holes.push_back(hole.corners);
    problem.width_m = width;
    problem.stray_m = 0.02 * width;
    for (int m = 0; m < (whole ? 2 : 1); ++m) {
      const CoverMethod& method = cover_methods()[static_cast<std::size_t>(m)];
      const auto plan = method.plan(problem, {}, {});
      ASSERT_TRUE(plan) << name << ": " << to_string(plan.error());
      const auto proof = prove(*plan, problem);
      ASSERT_TRUE(proof) << name << ": " << to_string(proof.error());
      EXPECT_GE(proof->planned.fraction, 0.995) << name << " by " << method.name;
      EXPECT_GE(proof->clearance_m, problem.radius_m() - 2.0 * contact_m) << name;
    }
  }
}

}  // namespace
}  // namespace outrider
