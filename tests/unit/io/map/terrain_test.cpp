#include "outrider/io/map/terrain.hpp"

#include <gtest/gtest.h>

#include <cstdint>
#include <filesystem>
#include <fstream>

#include "outrider/io/files/files.hpp"
#include "outrider/io/scenario/targets.hpp"
#include "outrider/io/sdf/sdf.hpp"
#include "support/png.hpp"

namespace outrider {
namespace {

const std::string grid_head =
    "ncols 3\nnrows 2\nxllcorner 10\nyllcorner 20\ncellsize 2\nNODATA_value -9999\n";

std::string grid_fault(const std::string& text) {
  const auto field = terrain_from_grid(text, "g.asc");
  return field ? "" : field.error().where + ": " + field.error().sentence;
}

TEST(TerrainGrid, TheFirstRowIsTheHighestAndCellsArePosts) {
  const auto field = terrain_from_grid(grid_head + "1 2 3\n4 5 6.5\n", "g.asc");
  ASSERT_TRUE(field);
  EXPECT_EQ(field->columns(), 3);
  EXPECT_EQ(field->rows(), 2);
  EXPECT_EQ(field->post(0, 0), (Vec3{11, 21, 4}));
  EXPECT_EQ(field->post(2, 0), (Vec3{15, 21, 6.5}));
  EXPECT_EQ(field->post(1, 1), (Vec3{13, 23, 2}));
}

TEST(TerrainGrid, CentresAndCaseAndLinesAreFree) {
  const auto field = terrain_from_grid(
      "NROWS 2\r\nNCOLS 2\r\nXLLCENTER 1\r\nYLLCENTER 2\r\nCELLSIZE 1\r\n1\r\n2 3\r\n4", "g");
  ASSERT_TRUE(field);
  EXPECT_EQ(field->post(0, 1), (Vec3{1, 3, 1}));
  EXPECT_EQ(field->post(1, 0), (Vec3{2, 2, 4}));
}

TEST(TerrainGrid, SaysWhatIsWrongAndWhere) {
  EXPECT_EQ(grid_fault(grid_head + "1 2 3\n4 x 6\n"),
            "g.asc:8: 'x' in column 2 of row 2 is no height; every cell takes one, in m");
  EXPECT_EQ(grid_fault(grid_head + "1 2 -9999\n4 5 6\n"),
            "g.asc:7: '-9999' in column 3 of row 1 is no height; every cell takes one, in m");
  EXPECT_EQ(grid_fault(grid_head + "1 nan 3\n4 5 6\n"),
            "g.asc:7: 'nan' in column 2 of row 1 is no height; every cell takes one, in m");
  EXPECT_EQ(grid_fault(grid_head + "1 2 3\n4 5\n"), "g.asc: it ends after 5 heights; its header says 3 x 2");
  EXPECT_EQ(grid_fault(grid_head), "g.asc: it ends after 0 heights; its header says 3 x 2");
  EXPECT_EQ(grid_fault(grid_head + "1 2 3\n4 5 6 7\n"), "g.asc:8: more than the 3 x 2 heights of the header");
  EXPECT_EQ(grid_fault("ncols 3\n1 2 3\n"),
            "g.asc: its header is incomplete; expected ncols, nrows, xllcorner, yllcorner and cellsize");
  EXPECT_EQ(grid_fault("ncols three\n"), "g.asc:1: 'ncols' takes one number, such as ncols 100");
  EXPECT_EQ(grid_fault("ncols 3\nncols 3\n"), "g.asc:2: 'ncols' is given twice; leave one");
  EXPECT_NE(
      grid_fault("ncols 1e9\nnrows 1e9\nxllcorner 0\nyllcorner 0\ncellsize 1\n1\n").find("1e+09 x 1e+09"),
      std::string::npos);
  EXPECT_NE(grid_fault("ncols 2.5\nnrows 2\nxllcorner 0\nyllcorner 0\ncellsize 1\n").find("whole numbers"),
            std::string::npos);
  EXPECT_NE(grid_fault("ncols 2\nnrows 2\nxllcorner 0\nyllcorner 0\ncellsize -1\n").find("cellsize of -1"),
            std::string::npos);
  EXPECT_NE(grid_fault(""), "");
}

TEST(TerrainPng, SixteenBitsAreHeightsAsTheyAre) {
  const auto field = terrain_from_png(test::png_of<std::uint16_t>(3, 2, {0, 1, 65535, 257, 30000, 40000}),
                                      "h.png", {5, 6, 1}, {4, 2, 10});
  ASSERT_TRUE(field) << field.error().sentence;
  EXPECT_EQ(field->post(0, 1), (Vec3{3, 7, 1}));
  EXPECT_DOUBLE_EQ(field->post(1, 1).z, 1 + 10.0 / 65535);
  EXPECT_EQ(field->post(2, 1), (Vec3{7, 7, 11}));
  EXPECT_DOUBLE_EQ(field->post(1, 0).z, 1 + 10.0 * 30000 / 65535);
}

TEST(TerrainPng, SoAreEight) {
  std::vector<std::uint8_t> ramp(256);
  for (std::size_t i = 0; i < ramp.size(); ++i) ramp[i] = static_cast<std::uint8_t>(i);
  const auto field = terrain_from_png(test::png_of<std::uint8_t>(16, 16, ramp), "h.png", {}, {1, 1, 255});
  ASSERT_TRUE(field) << field.error().sentence;
  for (int i = 0; i < 256; ++i) EXPECT_NEAR(field->post(i % 16, 15 - i / 16).z, i, 1e-9);
}

TEST(TerrainPng, AnAlphaChannelMayBeThereIfNothingIsTransparent) {
  const auto colours = test::png_of<std::uint8_t>(
      2, 2, {0, 0, 0, 255, 9, 9, 9, 255, 200, 200, 200, 255, 255, 255, 255, 255}, PNG_FORMAT_RGBA);
  const auto field = terrain_from_png(colours, "h.png", {}, {1, 1, 255});
  ASSERT_TRUE(field) << field.error().sentence;
  EXPECT_NEAR(field->post(1, 1).z, 9, 1e-9);
  EXPECT_NEAR(field->post(0, 0).z, 200, 1e-9);
  const auto wide =
      terrain_from_png(test::png_of<std::uint16_t>(2, 2, {0, 65535, 257, 65535, 30000, 65535, 65535, 65535},
                                                   PNG_FORMAT_LINEAR_Y_ALPHA),
                       "h.png", {}, {1, 1, 65535});
  ASSERT_TRUE(wide) << wide.error().sentence;
  EXPECT_NEAR(wide->post(1, 1).z, 257, 1e-9);
  const auto clear = test::png_of<std::uint8_t>(2, 2, {0, 255, 9, 254, 1, 255, 2, 255}, PNG_FORMAT_GA);
  const auto refused = terrain_from_png(clear, "h.png", {}, {1, 1, 1});
  ASSERT_FALSE(refused);
  EXPECT_NE(refused.error().sentence.find("transparent"), std::string::npos);
}

TEST(TerrainPng, RefusesWhatIsNoImageOfHeights) {
  EXPECT_FALSE(terrain_from_png("\x89PNG\r\n", "h.png", {}, {1, 1, 1}));
  std::string cut = test::png_of<std::uint16_t>(64, 64, std::vector<std::uint16_t>(4096, 7));
  cut.resize(cut.size() / 2);
  EXPECT_FALSE(terrain_from_png(cut, "h.png", {}, {1, 1, 1}));
  EXPECT_FALSE(terrain_from_png(test::png_of<std::uint8_t>(1, 4, {1, 2, 3, 4}), "h.png", {}, {1, 1, 1}));
  const auto thin = terrain_from_png(test::png_of<std::uint8_t>(2, 2, {1, 2, 3, 4}), "h.png", {}, {0, 1, 1});
  ASSERT_FALSE(thin);
  EXPECT_NE(thin.error().sentence.find("a size of 0 x 1 x 1 m"), std::string::npos);
}

class TerrainFiles : public ::testing::Test {
 protected:
  void SetUp() override {
    folder_ = std::filesystem::temp_directory_path() /
              ("outrider-terrain-" + std::to_string(reinterpret_cast<std::uintptr_t>(this)));
    std::filesystem::create_directories(folder_);
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }
  std::string write(const std::string& name, const std::string& content) {
    const std::string path = (folder_ / name).string();
    EXPECT_TRUE(write_file(path, content));
    return path;
  }
  std::filesystem::path folder_;
};

TEST_F(TerrainFiles, AnImageNeedsASizeAndAGridHasOne) {
  const std::string grid = write("g.asc", grid_head + "1 2 3\n4 5 6\n");
  const std::string image = write("h.png", test::png_of<std::uint8_t>(2, 2, {0, 0, 0, 255}));
  EXPECT_TRUE(load_terrain(grid, "", ""));
  EXPECT_EQ(load_terrain(grid, "1,1,1", "").error().where, "terrain_size");
  EXPECT_EQ(load_terrain(grid, "", "0,0,0").error().where, "terrain_position");
  EXPECT_EQ(load_terrain(image, "", "").error().where, "terrain_size");
  EXPECT_EQ(load_terrain(image, "4,4", "").error().where, "terrain_size");
  const auto field = load_terrain(image, "4,2,3", "1,0,-1");
  ASSERT_TRUE(field);
  EXPECT_EQ(field->post(1, 0), (Vec3{3, -1, 2}));
}

TEST_F(TerrainFiles, AHeightmapIsTheTerrainOfAWorld) {
  write("h.png", test::png_of<std::uint16_t>(3, 3, {0, 0, 0, 0, 65535, 0, 0, 0, 0}));
  const auto world_of = [&](const std::string& pose, const std::string& twice) {
    const std::string model =
        "<static>1</static><pose>" + pose +
        "</pose><link name='l'><collision name='c'><geometry><heightmap><uri>h.png</uri>"
        "<size>8 6 2</size><pos>0 0 0.5</pos></heightmap></geometry></collision></link></model>";
    return write("w.sdf", "<sdf version='1.9'><world name='w'><model name='m'>" + model +
                              (twice.empty() ? "" : "<model name='n'>" + model) + "</world></sdf>");
  };
  const auto loaded = load_sdf(world_of("1 2 0 0 0 0", ""));
  ASSERT_TRUE(loaded) << loaded.error().sentence;
  const World& world = loaded->world;
  ASSERT_NE(world.terrain, nullptr);
  EXPECT_NEAR(world.ground_z_m({1, 2}), 2.5, 1e-12);
  EXPECT_NEAR(world.ground_z_m({-3, -1}), 0.5, 1e-12);
  EXPECT_EQ(world.bounds.low, (Vec2{-3, -1}));
  EXPECT_EQ(world.floor_z_m, 0.5);
  EXPECT_FALSE(load_sdf(world_of("1 2 0 0 0 0.3", "")));
  EXPECT_FALSE(load_sdf(world_of("1 2 0 0 0 0", "twice")));
}

TEST(TargetsOnTerrain, StandOnTheGroundUnlessTheySayWhere) {
  const auto field = terrain_from_grid(grid_head + "1 1 1\n1 1 1\n", "g.asc");
  ASSERT_TRUE(field);
  const World hill = World{}.on(std::make_shared<const HeightField>(*field));
  const auto targets = targets_from_text("type=1 x=12 y=22\ntype=1 x=12 y=22 z=0.25\n", "t", hill);
  ASSERT_TRUE(targets);
  EXPECT_EQ((*targets)[0].base.z, 1.0);
  EXPECT_EQ((*targets)[1].base.z, 0.25);
}

}  // namespace
}  // namespace outrider
