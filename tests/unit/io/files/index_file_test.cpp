#include "outrider/io/files/index_file.hpp"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <filesystem>

#include "outrider/io/files/files.hpp"
#include "support/data.hpp"

namespace outrider {
namespace {

class IndexFile : public ::testing::Test {
 protected:
  [[nodiscard]] std::string path(const std::string& name) const { return (folder_.path / name).string(); }
  static std::shared_ptr<const GridMap> ground() {
    Grid<std::uint8_t> grid(GridFrame{{}, 1.0, 12, 9});
    for (int y = 2; y < 7; ++y) grid[{5, y}] = 1;
    return std::make_shared<const GridMap>(GridMap::of(grid, GridModel::cells).value());
  }

  test::Folder folder_;
  ConfiguredPlanner planner_ = find_path_planner("octile_labels")->configure();
};

TEST_F(IndexFile, IsWrittenOnceAndMapped) {
  const auto map = ground();
  Workspace built, mapped;
  EXPECT_FALSE(load_index_file(path("a.index"), planner_, {map}, built).value());
  ASSERT_TRUE(save_index_file(path("a.index"), planner_, {map}, {}, built));
  EXPECT_TRUE(load_index_file(path("a.index"), planner_, {map}, mapped).value());
  const std::string content = read_file(path("a.index")).value();
  // The mapping outlives the file, and a file that takes its place.
  ASSERT_TRUE(write_file(path("a.index"), "another"));
  EXPECT_EQ(planner_.save_index({map}, {}, mapped).value(), content);
  const Problem problem{map, {0.5, 4.5}, {11.5, 4.5}};
  EXPECT_EQ(planner_.plan(problem, {}, mapped).value(), planner_.plan(problem, {}, built).value());
}

TEST_F(IndexFile, IsRefusedByItsName) {
  const auto map = ground();
  Workspace workspace;
  ASSERT_TRUE(write_file(path("text"), "no index"));
  ASSERT_TRUE(write_file(path("empty"), ""));
  for (const char* name : {"text", "empty"}) {
    const auto loaded = load_index_file(path(name), planner_, {map}, workspace);
    ASSERT_FALSE(loaded) << name;
    EXPECT_EQ(loaded.error().code, FaultCode::bad_input);
    EXPECT_EQ(loaded.error().where, path(name));
    EXPECT_NE(loaded.error().sentence.find("; delete it"), std::string::npos) << loaded.error().sentence;
  }
  ASSERT_EQ(::mkfifo(path("pipe").c_str(), 0600), 0);
  for (const char* name : {"pipe", ""})
    EXPECT_EQ(load_index_file(path(name), planner_, {map}, workspace).error().sentence,
              "it is not a regular file; name another");
  EXPECT_EQ(save_index_file(path("none/a"), planner_, {map}, {}, workspace).error().sentence,
            "its folder does not exist; make it first");
}

TEST_F(IndexFile, IsKeptOnlyByPlannersWithAnIndex) {
  Workspace workspace;
  const auto planner = find_path_planner("jps")->configure();
  EXPECT_EQ(load_index_file(path("a"), planner, {ground()}, workspace).error().sentence,
            "the planner has no index that can be kept; take hub_labels, octile_labels or terrain_labels");
  EXPECT_FALSE(load_index_file(path("a"), planner_, {}, workspace));
}

}  // namespace
}  // namespace outrider
