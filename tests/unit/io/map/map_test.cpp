#include "outrider/io/map/map.hpp"

#include <gtest/gtest.h>
#include <zlib.h>

#include "outrider/io/files/files.hpp"
#include "outrider/world/occupancy.hpp"
#include "support/data.hpp"

namespace outrider {
namespace {

const std::string pgm = "P2\n3 2\n255\n254 0 254\n254 254 254\n";
const std::string yaml =
    "# a map\nimage: m.pgm\nresolution: 0.5\norigin: [10, 20, 0.5]\nnegate: 0\noccupied_thresh: 0.65\n"
    "free_thresh: 0.196\n";
const std::string octile = "type octile\nheight 2\nwidth 3\nmap\n.@.\n...\n";
const std::string room =
    "# a room\n\n(0,0) (8,0) (8,6) (0,6)\n---\n(3,0) (4,0) (4,2) (3,2)\n---\n(1,1) (7,1)\n";

std::string gzipped(const std::string& text) {
  std::string packed(text.size() + 100, '\0');
  z_stream stream{};
  deflateInit2(&stream, 9, Z_DEFLATED, 15 + 16, 8, Z_DEFAULT_STRATEGY);
  stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(text.data()));
  stream.avail_in = static_cast<uInt>(text.size());
  stream.next_out = reinterpret_cast<Bytef*>(packed.data());
  stream.avail_out = static_cast<uInt>(packed.size());
  deflate(&stream, Z_FINISH);
  packed.resize(stream.total_out);
  deflateEnd(&stream);
  return packed;
}

class MapTest : public ::testing::Test {
 protected:
  std::string write(const std::string& name, const std::string& content) {
    const std::string path = (folder_.path / name).string();
    EXPECT_TRUE(write_file(path, content).has_value());
    return path;
  }
  /// The content of each kind under the ending of its name.
  std::vector<std::tuple<std::string, std::string, MapKind>> kinds() {
    write("m.pgm", pgm);
    const std::string world = *read_file(test::scenarios + "yard/yard.sdf");
    return {{".yaml", yaml, MapKind::map_server},
            {".pgm", pgm, MapKind::image},
            {".map", octile, MapKind::movingai},
            {".txt", room, MapKind::polygons},
            {".sdf", world, MapKind::world}};
  }
  test::Folder folder_;
};

TEST_F(MapTest, ContentTellsTheKindWhateverTheName) {
  for (const auto& [ending, content, kind] : kinds()) {
    for (const std::string& name : std::vector<std::string>{"a" + ending, "a", "a.doc", "b" + ending + ".gz",
                                                            "c.map", "c.yaml", "c.txt"}) {
      const auto map = load_map(write(name, content));
      ASSERT_TRUE(map.has_value()) << name << ": " << to_string(map.error());
      EXPECT_EQ(map->kind, kind) << name;
      const auto packed = load_map(write(name, gzipped(content)));
      ASSERT_TRUE(packed.has_value()) << name << ": " << to_string(packed.error());
      EXPECT_EQ(packed->kind, kind) << name;
    }
  }
}

TEST_F(MapTest, EachKindIsWhatTheFileSays) {
  write("m.pgm", pgm);
  const auto cells = load_map(write("m.yaml", yaml));
  const auto& grid = std::get<MapCells>(cells->shape);
  EXPECT_EQ(grid.yaw_rad, 0.5);
  EXPECT_EQ(grid.occupancy.frame.origin, (Vec2{10, 20}));
  EXPECT_EQ(grid.occupancy.cells, (std::vector<std::uint8_t>{0, 0, 0, 0, occupied_cell, 0}));
  EXPECT_TRUE(cells->warnings.empty());

  const auto image = load_map((folder_.path / "m.pgm").string(), {.image_resolution_m = 0.25});
  EXPECT_EQ(std::get<MapCells>(image->shape).occupancy.frame.resolution_m, 0.25);
  EXPECT_EQ(std::get<MapCells>(image->shape).occupancy.cells, grid.occupancy.cells);
  ASSERT_EQ(image->warnings.size(), 1U);
  EXPECT_NE(image->warnings.front().find("0.25 m"), std::string::npos);

  const auto letters = load_map(write("m.map", octile));
  EXPECT_EQ(std::get<MapCells>(letters->shape).occupancy.cells,
            (std::vector<std::uint8_t>{0, 0, 0, 0, 1, 0}));

  const auto polygons = load_map(write("m.txt", room));
  const auto& shape = std::get<PolygonMap>(polygons->shape);
  EXPECT_EQ(shape.boundary.size(), 4U);
  EXPECT_EQ(shape.obstacles.size(), 1U);
  ASSERT_EQ(shape.queries.size(), 1U);
  EXPECT_EQ(shape.queries.front().goal, (Vec2{7, 1}));

  const auto world = load_map(test::scenarios + "yard/yard.sdf");
  EXPECT_FALSE(std::get<World>(world->shape).solids.empty());
}

TEST_F(MapTest, TheNameTellsWhereTheContentDoesNot) {
  for (const auto& [name, kind] : {std::pair{"a.yaml", MapKind::map_server},
                                   {"a.yml.gz", MapKind::map_server},
                                   {"a.sdf", MapKind::world},
                                   {"a.world", MapKind::world},
                                   {"a.map", MapKind::movingai},
                                   {"a.txt.gz", MapKind::polygons},
                                   {"a.png", MapKind::image},
                                   {"a.pgm", MapKind::image}}) {
    const auto found = map_kind("", name);
    ASSERT_TRUE(found.has_value()) << name;
    EXPECT_EQ(*found, kind) << name;
    const auto map = load_map(write(name, "nothing of the kind"));
    ASSERT_FALSE(map.has_value()) << name;
    EXPECT_EQ(map.error().code, FaultCode::bad_input);
    EXPECT_NE(map.error().where.find(name), std::string::npos) << to_string(map.error());
  }
}

TEST_F(MapTest, FaultsNameTheFileAndTheLine) {
  const auto refused = [&](const std::string& name, const std::string& content) {
    const auto map = load_map(write(name, content));
    return map ? std::string("taken") : to_string(map.error());
  };
  const auto unknown = refused("a.doc", "whatever");
  EXPECT_NE(unknown.find("a.doc: the name does not tell what kind of map it is"), std::string::npos);
  for (const char* ending : {".yaml", ".yml", ".sdf", ".world", ".map", ".txt", ".png", ".pgm"}) {
    EXPECT_NE(unknown.find(ending), std::string::npos) << ending;
  }
  EXPECT_NE(refused("a.doc", octile + "x").find("taken"), std::string::npos);
  EXPECT_NE(refused("a.doc", "type octile\nheight 2\nwidth x\n").find("a.doc:3"), std::string::npos);
  EXPECT_NE(refused("a.doc", "(0,0) (8,0) (8,6) (0,z)\n").find("a.doc:1"), std::string::npos);
  EXPECT_NE(refused("a.doc", "resolution: 0.5\norigin: [0, 0, 0]\n").find("'image' is missing"),
            std::string::npos);
  EXPECT_NE(refused("a.doc", "<html></html>").find("a.doc"), std::string::npos);
  EXPECT_NE(refused("scenario.yaml", "job: plan\nmap: a\n").find("scenario.yaml"), std::string::npos);
  EXPECT_NE(to_string(load_map("no/such.map").error()).find("no such file"), std::string::npos);
  EXPECT_FALSE(load_map(folder_.path.string()).has_value());
  const auto large = load_map(write("m.map", octile), {.most_cells = 5});
  EXPECT_NE(to_string(large.error()).find("m.map: a map of 3 x 2 cells is too large"), std::string::npos);
}

TEST_F(MapTest, AByteOrderMarkAndDocumentStartsAreNoContent) {
  write("m.pgm", pgm);
  EXPECT_EQ(load_map(write("a", "\xEF\xBB\xBF" + yaml))->kind, MapKind::map_server);
  EXPECT_EQ(load_map(write("a", "---\n" + yaml))->kind, MapKind::map_server);
}

}  // namespace
}  // namespace outrider
