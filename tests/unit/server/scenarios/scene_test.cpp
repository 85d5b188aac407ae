#include "scenarios/scene.hpp"

#include "app_fixture.hpp"
#include "files/head_comment.hpp"

namespace outrider::server {
namespace {

const std::string scenarios = std::string(OUTRIDER_SOURCE_DIR) + "/scenarios";

Json scene_of(const std::string& path) {
  std::filesystem::current_path(scenarios);
  const auto scene = scenario_scene(path);
  EXPECT_TRUE(scene) << scene.error().sentence;
  return scene.value_or(Json::object());
}

TEST(Scene, OfAYardHasItsTargets) {
  const Json scene = scene_of("yard/yard.yaml");
  EXPECT_EQ(scene["targets"].size(), 24U);
  EXPECT_EQ(scene["start"], Json::parse("[0.0,-6.3]"));
  EXPECT_GT(scene["map"]["polygons"]["obstacles"].size(), 10U);
}

TEST(Scene, IsThereForEveryScenarioThatNamesAGround) {
  for (const char* path : {"arena/safest.yaml", "cover/cover_field.yaml", "cover/cover_room.yaml",
                           "explore/cave.yaml", "explore/narrow_corridor.yaml", "explore/office.yaml",
                           "explore/trap_step.yaml", "pursuit/park.yaml", "hill/hill.yaml"}) {
    EXPECT_TRUE(scene_of(path)["map"].is_object()) << path;
  }
  for (const char* path : {"slam/office.yaml", "waypoints/open_loop.yaml"})
    EXPECT_TRUE(scene_of(path)["map"].is_null());
}

TEST_F(AppTest, ASceneShowsEveryAreaThatIsToBeCovered) {
  write("areas.geojson", R"({"type":"MultiPolygon","coordinates":[
    [[[0,0],[4,0],[4,3],[0,3],[0,0]],[[1,1],[1,2],[2,2],[2,1],[1,1]]],
    [[[6,0],[9,0],[9,3],[6,0]],[[8,1],[8,1.5],[8.5,1.5],[8,1]]]]})");
  write("a.yaml", "job: cover\narea: areas.geojson\n");
  const Json map = json("GET", "/api/v1/scenes/a.yaml")["map"];
  EXPECT_EQ(map["polygons"]["boundary"].size(), 4U);
  ASSERT_EQ(map["others"].size(), 1U);
  EXPECT_EQ(map["others"][0].size(), 3U);
  EXPECT_EQ(map["polygons"]["obstacles"].size(), 2U) << "the holes of both";
}

/// Something remains of a wall one cell wide.
TEST_F(AppTest, ALargeGridIsMadeCoarser) {
  std::string image = "P5\n1000 500\n255\n" + std::string(500'000, '\xff');
  for (std::size_t y = 0; y < 500; ++y) image[image.size() - 500'000 + 1000 * y + 333] = '\0';
  write("large.pgm", image);
  write("large.yaml",
        "image: large.pgm\nresolution: 0.1\norigin: [1, 2, 0]\nnegate: 0\noccupied_thresh: "
        "0.65\nfree_thresh: 0.196\n");
  write("a.yaml", "job: explore\nworld: large.yaml\nstart: 3,4,0\n");
  const Json scene = json("GET", "/api/v1/scenes/a.yaml");
  const Json& grid = scene["map"]["grid"];
  EXPECT_EQ(grid["width"], 200);
  EXPECT_EQ(grid["height"], 100);
  EXPECT_DOUBLE_EQ(grid["resolution_m"], 0.5);
  EXPECT_EQ(grid["origin"], Json::parse("[1.0,2.0]"));
  EXPECT_EQ(scene["start"], Json::parse("[3.0,4.0]"));
  EXPECT_EQ(grid["runs"].size(), 2 * (2 * 100 + 1));
  EXPECT_EQ(grid["runs"][2], 1);
}

TEST_F(AppTest, ASceneOutsideTheFolderIsRefused) {
  write("a.yaml", "job: explore\nworld: ../../etc/passwd\n");
  write("b.yaml", "job: [\n");
  EXPECT_EQ(ask("GET", "/api/v1/scenes/a.yaml").status, 400);
  EXPECT_EQ(ask("GET", "/api/v1/scenes/b.yaml").status, 400);
  EXPECT_EQ(ask("GET", "/api/v1/scenes/absent.yaml").status, 404);
}

TEST(HeadComment, IsWhatStandsBeforeTheFirstKey) {
  EXPECT_EQ(head_comment("# One line.\n# And another.\njob: guard\n# not this\n"), "One line. And another.");
  EXPECT_EQ(head_comment("# A park.\n#   outrider run park.yaml\njob: pursue\n"), "A park.");
  EXPECT_EQ(head_comment("\n\n# First.\n#\n# A second paragraph.\n"), "First.");
  EXPECT_EQ(head_comment("# " + std::string(saved_here) + "\njob: plan\n"), "");
  EXPECT_EQ(head_comment("job: guard\n"), "");
  EXPECT_EQ(head_comment(""), "");
  EXPECT_EQ(head_comment("# bell \a\n"), "");
  EXPECT_LE(head_comment("# " + std::string(1000, 'x') + "\n").size(), longest_head_comment);
  const std::string cut = head_comment("# Words" + std::string(1000, 'x') + " and others");
  EXPECT_EQ(cut, "...") << "no word fits";
  EXPECT_EQ(head_comment("# Some words, " + std::string(1000, 'x')), "Some words, ...");
  EXPECT_EQ(head_comment("# with a return\r\njob: guard\r\n"), "with a return");
}

TEST_F(AppTest, AScenarioWithoutACommentIsDescribedByItsJob) {
  write("a.yaml", "# Mine.\njob: guard\n");
  write("b.yaml", "job: guard\n");
  write("c.yaml", "# Of a job that is none.\njob: dance\n");
  const Json files = json("GET", "/api/v1/files")["files"];
  EXPECT_EQ(files[0]["description"], "Mine.");
  EXPECT_EQ(files[1]["description"], std::string(find_job(jobs(), "guard")->sentence));
  EXPECT_FALSE(files[2].contains("description"));
}

}  // namespace
}  // namespace outrider::server
