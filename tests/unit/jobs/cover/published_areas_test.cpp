#include <gtest/gtest.h>

#include "outrider/io/map/cover_area.hpp"
#include "outrider/jobs/cover/strokes/plan.hpp"
#include "support/cover_areas.hpp"
#include "support/data.hpp"
#include "support/random_cases.hpp"

namespace outrider {
namespace {

/// The parcel states its area: 17.2581 ha.
TEST(PublishedAreas, DegreesBecomeMetres) {
  const auto file = test::data_folder() / "slam" / "coverage" / "f2c_Envelope.xml";
  OUTRIDER_NEEDS_DATA(file);
  const auto area = load_cover_area(file.string());
  ASSERT_TRUE(area) << to_string(area.error());
  EXPECT_NEAR(area_of(region_of(area->polygons.front().boundary.corners, {})), 172581.0, 0.0001 * 172581.0);
}

/// Every polygon of the published data, covered by every method with a robot of a size that suits it.
TEST(PublishedAreas, EveryPublishedPolygonIsCovered) {
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
    const AreaPolygon& polygon = area->polygons.front();
    if (!whole && polygon.holes.size() > 2)
      continue;  // the forest is covered by the test of the command line
    CoverProblem problem;
    problem.boundary = polygon.boundary.corners;
    for (const AreaRing& hole : polygon.holes) problem.holes.push_back(hole.corners);
    problem.width_m = width;
    problem.tracking_error_m = 0.02 * width;
    for (int m = 0; m < (whole ? 2 : 1); ++m) {
      const CoverMethod& method = cover_methods()[static_cast<std::size_t>(m)];
      const auto plan = method.plan(problem, testing::any_order(), {});
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
