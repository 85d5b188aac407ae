#include "outrider/io/map/world_file.hpp"

#include <gtest/gtest.h>

#include "support/data.hpp"

namespace outrider {
namespace {

TEST(WorldFile, ContentTellsTheKindWhateverTheName) {
  const test::Folder folder;
  folder.write("m.pgm", "P2 3 1 255\n254 0 254\n");
  const std::string yaml = "image: m.pgm\nresolution: 0.5\norigin: [0, 0, 0]\n";
  const std::string slices = "# walls\na,b,0,0,4,0\n1,1,2,1\n";
  const auto solids = [&](const std::string& name, const std::string& content) {
    const auto loaded = load_world(folder.write(name, content));
    EXPECT_TRUE(loaded.has_value()) << name << ": " << to_string(loaded.error());
    return loaded ? loaded->world.solids.size() : 0;
  };
  const std::vector<std::tuple<std::string, std::string>> kinds = {
      {".sdf", test::bytes_of(test::scenarios + "yard/yard.sdf")},
      {".yaml", yaml},
      {".pgm", test::bytes_of(folder.path / "m.pgm")},
      {".csv", slices}};
  for (const auto& [ending, content] : kinds) {
    const std::size_t expected = solids("named" + ending, content);
    for (const char* name : {"a", "a.doc", "a.sdf", "a.csv.gz", "a.yaml", "a.map", "a.txt"}) {
      EXPECT_EQ(solids(name, content), expected) << name << " with the content of " << ending;
    }
  }
  EXPECT_EQ(solids("walls", slices), 3U) << "the floor and two walls";
}

TEST(WorldFile, NamesAndFaults) {
  const test::Folder folder;
  EXPECT_EQ(load_world(folder.write("yard.csv", "0,0,4,0\n"))->world.name, "yard");
  const auto unknown = load_world(folder.write("a.doc", "x"));
  EXPECT_NE(unknown.error().sentence.find("does not tell what kind of world"), std::string::npos);
  EXPECT_NE(unknown.error().where.find("a.doc"), std::string::npos);
  EXPECT_NE(to_string(load_world(folder.write("a.doc", "0,0,4,0\n0,0,4\n")).error()).find("a.doc:2"),
            std::string::npos);
  EXPECT_NE(load_world(folder.write("m.map", "type octile\n")).error().sentence.find("kind of world"),
            std::string::npos);
  EXPECT_FALSE(load_world((folder.path / "absent.sdf").string()).has_value());
}

}  // namespace
}  // namespace outrider
