#include "outrider/io/map/polygons.hpp"

#include <gtest/gtest.h>

#include "outrider/path/check.hpp"
#include "outrider/path/visibility/visibility_graph.hpp"
#include "support/data.hpp"

namespace outrider {
namespace {

using test::damaged;
using test::Folder;

const std::string square = "(0,0) (4,0) (4,4) (0,4)\n---\n";

TEST(Polygons, ReadsBlocksWithAnyWhiteSpace) {
  const auto map = polygon_map_from_text(
      "# a room\r\n(4,4)  (4,-7)\n(-7,-7) (-7,4) \n---\n( -1 , -1.5 )(-5,-1) (-5,2e0)\t\n\n--- \n(-1,3)  "
      "(2,3) \n",
      "map");
  ASSERT_TRUE(map.has_value()) << to_string(map.error());
  EXPECT_EQ(map->boundary, (std::vector<Vec2>{{4, 4}, {4, -7}, {-7, -7}, {-7, 4}}));
  EXPECT_EQ(map->obstacles, (std::vector<std::vector<Vec2>>{{{-1, -1.5}, {-5, -1}, {-5, 2}}}));
  ASSERT_EQ(map->queries.size(), 1U);
  EXPECT_EQ(map->queries[0].goal, (Vec2{2, 3}));
  EXPECT_TRUE(polygon_map_from_text(square, "map").has_value());
}

TEST(Polygons, TextReadsBackAsTheSameMap) {
  const auto map = polygon_map_from_text(
      "(0,0) (0.1,7e-5) (4,1e3) (-1.0000000000000002,0.30000000000000004)\n---\n(1,1) (2,1) (2,2)\n---\n"
      "(0.7,1) (3,1)\n(1,0.1) (1,1)\n",
      "map");
  ASSERT_TRUE(map) << to_string(map.error());
  for (const bool asks : {true, false}) {
    PolygonMap kept = *map;
    if (!asks) kept.queries.clear();
    const auto back = polygon_map_from_text(polygon_map_text(kept), "text");
    ASSERT_TRUE(back) << to_string(back.error());
    EXPECT_EQ(back->boundary, kept.boundary);
    EXPECT_EQ(back->obstacles, kept.obstacles);
    ASSERT_EQ(back->queries.size(), kept.queries.size());
    for (std::size_t i = 0; i < kept.queries.size(); ++i) {
      EXPECT_EQ(back->queries[i].start, kept.queries[i].start);
      EXPECT_EQ(back->queries[i].goal, kept.queries[i].goal);
    }
  }
}

TEST(Polygons, SaysWhatIsWrongAndWhere) {
  const auto fault_of = [](const std::string& text) {
    const auto map = polygon_map_from_text(text, "map");
    EXPECT_FALSE(map.has_value()) << text;
    if (map) return std::string{};
    EXPECT_EQ(map.error().code, FaultCode::bad_input);
    return to_string(map.error());
  };
  const std::vector<std::array<std::string, 3>> cases = {
      {"", "map", "no line ---"},
      {"(0,0) (4,0) (4,4)\n", "map", "no line ---"},
      {"(0,0) (4,0)\n---\n", "map:2", "at least three"},
      {"(0,0) (4,4) (4,0) (0,4)\n---\n", "map:2", "the boundary crosses"},
      {square + "(1,1) (2,2) (2,1) (1,2)\n", "map:3", "obstacle 1 crosses or touches itself"},
      {square + "(1,1) (2,1) (1.5,1) (1,2)\n", "map:3", "obstacle 1 crosses or touches itself"},
      {square + "(1,1) (2,1) (3,1)\n", "map:3", "itself"},
      {square + "(1,1) (1,1) (2,1) (1,1)\n", "map:3", "2 distinct corners"},
      {square + "(1,1) (2,x) (3,1)\n", "map:3", "'(2,x) (3,1)' is no corner"},
      {square + "(1,1) (2,nan) (3,1)\n", "map:3", "is no corner"},
      {square + "(1,1) (2,1e9) (3,1)\n", "map:3", "from -10000"},
      {square + "(1,1) (2,1 (3,1)\n", "map:3", "is no corner"},
      {square + "(1,1) () (3,1)\n", "map:3", "is no corner"},
      {square + "(1,1) (2,) (3,1)\n", "map:3", "is no corner"},
      {square + "obstacle\n", "map:3", "'obstacle' is no corner"},
      {square + "---\n(1,1) (2,2) (3,3)\n", "map:4", "this one has 3 points"},
      {square + "---\n(1,1) (2,2)\n---\n", "map:5", "a third ---"},
  };
  for (const auto& [text, where, sentence] : cases) {
    const std::string fault = fault_of(text);
    EXPECT_EQ(fault.rfind(where + ":", 0), 0U) << text << " -> " << fault;
    EXPECT_NE(fault.find(sentence), std::string::npos) << text << " -> " << fault;
  }
}

TEST(Polygons, BoundsHold) {
  std::string many = square;
  for (int i = 0; i < 2000; ++i) many += "(1,1) (2,1) (1,2)\n";
  const auto map = polygon_map_from_text(many, "map");
  ASSERT_FALSE(map.has_value());
  EXPECT_NE(map.error().sentence.find("4096 corners"), std::string::npos);
}

TEST(Polygons, DamageIsRefusedOrRead) {
  Rng rng = Rng(1).child("polygons");
  const std::string whole = square + "(1,1) (2,1) (1,2)\n(2,2) (3,2) (3,3) (2,3)\n---\n(0.5,0.5) (3.5,3.5)\n";
  int read = 0;
  for (int i = 0; i < 5000; ++i) {
    const auto map = polygon_map_from_text(damaged(whole, rng), "map");
    if (!map) {
      EXPECT_EQ(map.error().code, FaultCode::bad_input);
      continue;
    }
    ++read;
    EXPECT_TRUE(PolygonGround::of(map->boundary, map->obstacles, 0.1).has_value());
  }
  EXPECT_GT(read, 40);
}

/// Seventy queries: three planners that agree, and paths that the judge accepts.
TEST(Polygons, PublishedMapsAreSolvedAlikeByAllForms) {
  const auto folder = test::data_folder() / "polygons";
  OUTRIDER_NEEDS_DATA(folder);
  int solved = 0;
  for (int k = 1; k <= 7; ++k) {
    auto map = load_polygon_map((folder / ("map_" + std::to_string(k) + ".txt")).string());
    ASSERT_TRUE(map.has_value()) << to_string(map.error());
    auto ground = PolygonGround::of(map->boundary, map->obstacles, 0.18);
    ASSERT_TRUE(ground.has_value()) << ground.error().sentence;
    const auto shared = std::make_shared<const PolygonGround>(std::move(*ground));
    EXPECT_EQ(visibility_legs(*shared, true).size(), visibility_legs(*shared, false).size());
    Workspace workspace;
    for (const PointQuery& query : map->queries) {
      const Problem problem{nullptr, query.start, query.goal, shared};
      const auto swept = visibility_graph(problem, {}, {}, workspace);
      const auto paired = visibility_graph_reduced(problem, {}, {}, workspace);
      const auto implicit = visibility_graph_implicit(problem, {}, {}, workspace);
      ASSERT_TRUE(swept && paired && implicit) << "map " << k;
      EXPECT_NEAR(swept->cost, paired->cost, 1e-9 * paired->cost);
      EXPECT_NEAR(implicit->cost, paired->cost, 1e-9 * paired->cost);
      for (const auto* plan : {&*swept, &*paired, &*implicit}) {
        const auto verdict = check(*plan, problem);
        EXPECT_TRUE(verdict.has_value()) << "map " << k << ": " << verdict.error().sentence;
        EXPECT_GE(clearance_m(*plan, *shared), 0.18 - 1e-9);
      }
      ++solved;
    }
  }
  EXPECT_EQ(solved, 70);
}

}  // namespace
}  // namespace outrider
