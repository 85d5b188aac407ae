#include "outrider/io/map/map_server.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "outrider/io/files/files.hpp"
#include "support/data.hpp"
#include "support/png.hpp"
#include "support/replaced.hpp"

namespace outrider {
namespace {

const std::string good_yaml =
    "image: m.pgm  # a comment\nresolution: 0.5\norigin: [-1, 2, 0.25]\nnegate: 0\n"
    "occupied_thresh: 0.65\nfree_thresh: 0.196\n";
const std::string text_pgm = "P2\n# by hand\n3 2 # size\n255\n0 254 205\n255 100 0\n";

/// Loads m.yaml with the given image from a folder of its own.
struct MapFiles {
  test::Folder folder;
  Outcome<MapServerMap> load(const std::string& yaml, const std::string& image) {
    folder.write("m.pgm", image);
    return load_map_server(folder.write("m.yaml", yaml));
  }
};

std::vector<std::uint8_t> cells(const std::string& yaml, const std::string& image) {
  MapFiles files;
  const auto map = files.load(yaml, image);
  EXPECT_TRUE(map) << to_string(map.error());
  return map ? map->occupancy.cells : std::vector<std::uint8_t>{};
}

TEST(MapServer, ThresholdsAndRowOrder) {
  MapFiles files;
  const auto map = files.load(good_yaml, text_pgm);
  ASSERT_TRUE(map) << to_string(map.error());
  EXPECT_EQ(map->occupancy.frame, (GridFrame{{-1, 2}, 0.5, 3, 2}));
  EXPECT_EQ(map->yaw_rad, 0.25);
  // Lowest row first: 255 free, 100 is 0.608 and unknown, 0 occupied; then 0, 254, 205 (unknown).
  EXPECT_EQ(map->occupancy.cells, (std::vector<std::uint8_t>{free_cell, unknown_cell, occupied_cell,
                                                             occupied_cell, free_cell, unknown_cell}));
}

TEST(MapServer, NegateAndModes) {
  const auto negated = cells(test::replaced(good_yaml, "negate: 0", "negate: 1"), text_pgm);
  EXPECT_EQ(negated, (std::vector<std::uint8_t>{occupied_cell, unknown_cell, free_cell, free_cell,
                                                occupied_cell, occupied_cell}));
  const auto raw = cells(good_yaml + "mode: raw\n", "P2 3 2 255 0 100 255 50 101 10");
  EXPECT_EQ(raw, (std::vector<std::uint8_t>{unknown_cell, unknown_cell, free_cell, free_cell, occupied_cell,
                                            unknown_cell}));
}

TEST(MapServer, EveryFormOfTheSameImageGivesTheSameCells) {
  const auto expected = cells(good_yaml, text_pgm);
  EXPECT_EQ(cells(good_yaml, std::string("P5 3 2 255\n\x00\xfe\xcd\xff\x64\x00", 17)), expected);
  std::string wide = "P5\n#x\n3 2\n65535\n";
  for (const unsigned value : {0U, 254U, 205U, 255U, 100U, 0U}) {
    wide += static_cast<char>(value);
    wide += static_cast<char>(value);  // 257 v = v * 65535 / 255
  }
  EXPECT_EQ(cells(good_yaml, wide), expected);
  EXPECT_EQ(cells(good_yaml, test::png_of<std::uint8_t>(3, 2, {0, 254, 205, 255, 100, 0}, PNG_FORMAT_GRAY)),
            expected);
  std::vector<std::uint8_t> rgba;
  for (const std::uint8_t value : std::vector<std::uint8_t>{0, 254, 205, 255, 100, 0})
    rgba.insert(rgba.end(), {value, value, value, 255});
  EXPECT_EQ(cells(good_yaml, test::png_of<std::uint8_t>(3, 2, rgba, PNG_FORMAT_RGBA)), expected);
  rgba[3] = 0;  // the top left pixel is clear
  auto clear = expected;
  clear[3] = unknown_cell;
  EXPECT_EQ(cells(good_yaml, test::png_of<std::uint8_t>(3, 2, rgba, PNG_FORMAT_RGBA)), clear);
}

TEST(MapServer, FaultsNameFileLineAndRemedy) {
  MapFiles files;
  const auto fault = [&](const std::string& yaml, const std::string& image) {
    const auto map = files.load(yaml, image);
    return map ? "none" : to_string(map.error()).substr(files.folder.path.string().size() + 1);
  };
  EXPECT_EQ(fault(test::replaced(good_yaml, "0.5", "nan"), text_pgm),
            "m.yaml:2: 'resolution' is not valid; expected the side of a pixel in m, from 1e-4 to 1e3");
  EXPECT_EQ(fault("image: m.pgm\nresolution: 1\n", text_pgm),
            "m.yaml: the key 'origin' is missing; expected [x, y, yaw], numbers from -1e6 to 1e6");
  for (const auto& [from, to] :
       std::vector<std::pair<std::string, std::string>>{{"0.5", "0"},
                                                        {"0.5", "-1"},
                                                        {"0.5", "[1]"},
                                                        {"[-1, 2, 0.25]", "3"},
                                                        {"[-1, 2, 0.25]", "[1]"},
                                                        {"[-1, 2, 0.25]", "[1, inf, 0]"},
                                                        {"negate: 0", "negate: 2"},
                                                        {"0.196", "0.9"},
                                                        {"0.196", "x"},
                                                        {"negate: 0", "mode: best"},
                                                        {"negate: 0", "resolution: 1"},
                                                        {"resolution: 0.5", ": :"}}) {
    EXPECT_TRUE(fault(test::replaced(good_yaml, from, to), text_pgm).starts_with("m.yaml:"))
        << to << " -> " << fault(test::replaced(good_yaml, from, to), text_pgm);
  }
  EXPECT_TRUE(fault(test::replaced(good_yaml, "m.pgm", "no.pgm"), text_pgm)
                  .starts_with("no.pgm: there is no such file"));
  for (const std::string& image :
       {std::string("P5 3 2 255\n12345"), std::string("P5 100000 100000 255\n"), std::string("P5 0 2 255\n"),
        std::string("P5 3 2 70000\n"), std::string("P2 3 2 9 1 2 3 4 5 10"),
        std::string("P2 3 2 255 1 2 3 4 5 x "), std::string("P6 1 1 255\n123"), std::string("GIF89a"),
        std::string(), std::string("\x89PNG\r\n\x1a\n")}) {
    EXPECT_TRUE(fault(good_yaml, image).starts_with("m.pgm: ")) << fault(good_yaml, image);
  }
}

TEST(MapServer, WrittenMapsReadBack) {
  const test::Folder folder;
  Rng rng(4);
  MapServerMap map{Grid<std::uint8_t>({{-1.25, 0.1}, 0.05, 17, 9}), -1.5708};
  for (auto& cell : map.occupancy.cells) cell = static_cast<std::uint8_t>(rng.below(3));
  const std::string path = (folder.path / "map.yaml").string();
  ASSERT_TRUE(save_map_server(path, map));
  const auto back = load_map_server(path);
  ASSERT_TRUE(back) << to_string(back.error());
  EXPECT_EQ(back->occupancy.frame, map.occupancy.frame);
  EXPECT_EQ(back->occupancy.cells, map.occupancy.cells);
  EXPECT_EQ(back->yaw_rad, map.yaw_rad);
  EXPECT_FALSE(save_map_server((folder.path / "map.pgm").string(), map));
  EXPECT_FALSE(save_map_server((folder.path / "empty.yaml").string(), {}));
  EXPECT_FALSE(std::filesystem::exists(folder.path / "empty.pgm"));
}

TEST(MapServer, CentresTurnAboutTheOrigin) {
  const MapServerMap map{Grid<std::uint8_t>({{-0.5, 10.0}, 1.0, 3, 3}), -std::numbers::pi / 2};
  const Vec2 p = world_centre(map, {2, 0});
  EXPECT_NEAR(p.x, -0.5 + 0.5, 1e-12);
  EXPECT_NEAR(p.y, 10.0 - 2.5, 1e-12);
}

TEST(MapServer, ReadsThePublishedMaps) {
  const auto data = test::data_folder();
  OUTRIDER_NEEDS_DATA(data / "exploration");
  const auto count = [](const MapServerMap& map, Occupancy value) {
    return std::ranges::count(map.occupancy.cells, value);
  };
  const auto yard = load_map_server((data / "guard/maps/by_small.yaml").string());
  ASSERT_TRUE(yard) << to_string(yard.error());
  EXPECT_EQ(yard->occupancy.frame.width, 502);
  EXPECT_EQ(yard->yaw_rad, -1.5708);
  const auto house = load_map_server((data / "exploration/shureihz.yaml").string());
  ASSERT_TRUE(house) << to_string(house.error());
  EXPECT_NEAR(static_cast<double>(count(*house, free_cell)) * 0.05 * 0.05, 93.7, 0.05);  // README of the data
  for (const char* name : {"closed_maze_truth_2.5cm", "house_closed_truth_2.5cm", "willow_closed_truth_5cm",
                           "willow_closed_sealed_truth_5cm"}) {
    const auto truth = load_map_server((data / "exploration" / (std::string(name) + ".yaml")).string());
    ASSERT_TRUE(truth) << to_string(truth.error());
    EXPECT_GT(count(*truth, occupied_cell), 1000);
    EXPECT_EQ(count(*truth, unknown_cell), 0);
  }
}

TEST(MapServer, SurvivesDamage) {
  Rng rng(5);
  const std::string png = test::png_of<std::uint8_t>(3, 2, {0, 254, 205, 255, 100, 0}, PNG_FORMAT_GRAY);
  const test::Folder folder;
  const std::string yaml = folder.write("m.yaml", good_yaml);
  folder.write("n/m.pgm", text_pgm);
  for (int i = 0; i < 400; ++i) {
    folder.write("m.pgm", test::damaged(i % 2 == 0 ? text_pgm : png, rng));
    const auto image_damaged = load_map_server(yaml);
    const auto yaml_damaged = load_map_server(folder.write("n/m.yaml", test::damaged(good_yaml, rng)));
    for (const auto& map : {image_damaged, yaml_damaged}) {
      if (map) {
        EXPECT_EQ(map->occupancy.cells.size(), map->occupancy.frame.size());
      }
    }
  }
}

}  // namespace
}  // namespace outrider
