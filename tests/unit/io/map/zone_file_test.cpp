// Zones from text, GeoJSON and filter masks of Nav2, and what is wrong with them.
#include "outrider/io/map/zone_file.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "map/cell_outlines.hpp"
#include "outrider/core/rng.hpp"

namespace outrider {
namespace {

namespace fs = std::filesystem;

const Box2 ground{{0, 0}, {10, 10}};

TEST(ZoneFile, ReadsText) {
  const auto zones = zones_from_text("keep_out 1,1 2,1 2,2; slow 0.3 4,0 6,0 6,2;", "zones.areas");
  ASSERT_TRUE(zones) << zones.error().sentence;
  ASSERT_EQ(zones->size(), 2U);
  EXPECT_EQ(zones->front().kind, Zone::Kind::keep_out);
  EXPECT_EQ(zones->back().kind, Zone::Kind::slow);
  EXPECT_EQ(zones->back().speed_mps, 0.3);
  EXPECT_TRUE(zones->back().contains({5.5, 0.5}));
  EXPECT_NEAR(zones->front().distance_to({0.0, 1.0}), 1.0, 1e-12);
}

TEST(ZoneFile, RefusesWhatMakesNoSense) {
  for (const char* text : {"keep_out 1,1 2,1", "keep_out 0,0 1,1 1,0 0,1", "slow 4,0 6,0 6,2",
                           "slow 0 4,0 6,0 6,2", "slow -1 4,0 6,0 6,2", "slow nan 4,0 6,0 6,2",
                           "no_go 1,1 2,1 2,2", "keep_out 1,1 2,1 2", "keep_out 1e9,1 2,1 2,2"}) {
    const auto zones = zones_from_text(text, "zones.areas");
    ASSERT_FALSE(zones) << text;
    EXPECT_EQ(zones.error().where, "zones.areas") << text;
    EXPECT_FALSE(zones.error().sentence.empty());
  }
}

constexpr const char* feature =
    R"({"type":"Feature","properties":{},"geometry":{"type":"Polygon","coordinates":[[[0,0],[2,0],[2,2],[0,2],[0,0]],[[0.5,0.5],[1,0.5],[1,1],[0.5,0.5]]]}})";

std::string with_properties(const std::string& properties) {
  std::string text = feature;
  return R"({"type":"FeatureCollection","features":[)" + text.replace(text.find("{},"), 2, properties) + "]}";
}

TEST(ZoneFile, ReadsGeoJson) {
  const auto zones = zones_from_geojson(with_properties(R"({"kind":"slow","speed":0.4})"), "z.geojson");
  ASSERT_TRUE(zones) << zones.error().sentence;
  ASSERT_EQ(zones->size(), 1U);
  EXPECT_EQ(zones->front().speed_mps, 0.4);
  EXPECT_TRUE(zones->front().contains({1.5, 1.5}));
  EXPECT_FALSE(zones->front().contains({0.9, 0.6}));  // the hole
  for (const char* properties :
       {"{}", "null", R"({"kind":"slow"})", R"({"kind":3})", R"({"kind":"forbidden"})"}) {
    const auto refused = zones_from_geojson(with_properties(properties), "z.geojson");
    ASSERT_FALSE(refused) << properties;
    EXPECT_NE(refused.error().where.find("z.geojson: $.features[0]"), std::string::npos)
        << refused.error().where;
  }
}

/// Writes a mask of 4 by 3 pixels of 1 m, and returns the path of its YAML file.
std::string mask(const std::string& name, const std::vector<int>& pixels, const std::string& keys) {
  const fs::path folder = fs::path(testing::TempDir()) / "zone_masks";
  fs::create_directories(folder);
  std::ofstream image(folder / (name + ".pgm"));
  image << "P2\n4 3\n255\n";
  for (const int pixel : pixels) image << pixel << ' ';
  std::ofstream(folder / (name + ".yaml")) << "image: " << name << ".pgm\nresolution: 1\nnegate: 0\n" << keys;
  return (folder / (name + ".yaml")).string();
}

const std::string scaled = "origin: [2, 3, 0]\nmode: scale\noccupied_thresh: 1.0\nfree_thresh: 0.0\n";

TEST(ZoneFile, ReadsAKeepOutMask) {
  ZoneSources sources;
  // Row 0 is the top. 0 is black: 100 percent.
  sources.keep_out_mask = mask("keep_out", {255, 255, 255, 255, 255, 0, 255, 128, 255, 255, 0, 255}, scaled);
  const auto loaded = load_zones(sources, 1.0, ground);
  ASSERT_TRUE(loaded) << loaded.error().sentence;
  ASSERT_EQ(loaded->zones.size(), 1U);
  const Zone& zone = loaded->zones.front();
  EXPECT_EQ(zone.kind, Zone::Kind::keep_out);
  EXPECT_TRUE(zone.contains({3.5, 4.5}));
  EXPECT_TRUE(zone.contains({4.5, 3.5}));
  EXPECT_FALSE(zone.contains({5.5, 4.5}));  // half
  EXPECT_EQ(zone.rings.size(), 2U);         // they meet at a corner only
  ASSERT_EQ(loaded->warnings.size(), 1U);
}

TEST(ZoneFile, ReadsASpeedMaskInPercentAndInMetresASecond) {
  ZoneSources sources;
  sources.speed_mask = mask("speed", {255, 255, 255, 255, 255, 128, 102, 255, 0, 255, 255, 255}, scaled);
  const auto loaded = load_zones(sources, 2.0, ground);
  ASSERT_TRUE(loaded) << loaded.error().sentence;
  // 128: 50 %; 102: 60 %, which leaves 40 % of 2 m/s; 0: 100 - 100 = 0, which is no limit.
  ASSERT_EQ(loaded->zones.size(), 2U);
  EXPECT_NEAR(loaded->zones[0].speed_mps, 1.0, 1e-9);
  EXPECT_TRUE(loaded->zones[0].contains({3.5, 4.5}));
  EXPECT_NEAR(loaded->zones[1].speed_mps, 0.8, 1e-9);
  sources.speed_percent = false;
  sources.speed_base = 0.0;
  sources.speed_multiplier = 0.01;
  const auto metres = load_zones(sources, 2.0, ground);
  ASSERT_TRUE(metres);
  ASSERT_EQ(metres->zones.size(), 3U);
  EXPECT_NEAR(metres->zones[0].speed_mps, 0.5, 1e-9);
  EXPECT_NEAR(metres->zones[2].speed_mps, 1.0, 1e-9);
  sources.speed_multiplier = -1.0;
  EXPECT_FALSE(load_zones(sources, 2.0, ground));
}

TEST(ZoneFile, RefusesAMaskThatDoesNotFit) {
  ZoneSources sources;
  sources.keep_out_mask = mask("off", std::vector<int>(12, 0), "origin: [20, 3, 0]\n");
  const auto off = load_zones(sources, 1.0, ground);
  ASSERT_FALSE(off);
  EXPECT_EQ(off.error().where, sources.keep_out_mask);
  EXPECT_NE(off.error().sentence.find("correct its origin"), std::string::npos);
  sources.keep_out_mask = "no/such/mask.yaml";
  EXPECT_FALSE(load_zones(sources, 1.0, ground));
}

TEST(ZoneFile, OutlinesOfCellsContainThem) {
  Rng rng(5);
  for (int round = 0; round < 20; ++round) {
    Grid<std::uint8_t> cells(GridFrame{{1.0, -2.0}, 0.5, 9, 7});
    for (auto& cell : cells.cells) cell = rng.uniform() < 0.5 ? 1 : 0;
    const Zone zone{.rings = cell_outlines(cells)};
    for (std::size_t i = 0; i < cells.cells.size(); ++i)
      EXPECT_EQ(zone.contains(cells.frame.centre(cells.frame.cell(i))), cells.cells[i] != 0);
  }
}

}  // namespace
}  // namespace outrider
