#include <sstream>

#include "app_fixture.hpp"

namespace outrider::server {
namespace {

const std::string room = R"({"boundary":[[0,0],[9,0],[9,3],[0,3]],"obstacles":[[[1,0],[2,0],[2,2],[1,2]]]})";
const std::string grid =
    R"({"origin":[-1,0.5],"resolution_m":0.5,"width":4,"height":2,"runs":[0,3,2,1,0,4]})";

/// A question on the ground, as a request to save it.
std::string saving(const std::string& ground, const std::string& more = "") {
  return R"({"plan":{)" + ground + R"(,"start":[0.25,0.75],"goal":[0.75,0.75],"radius_m":0.1)" + more + "}}";
}

class ScenariosTest : public AppTest {
 protected:
  [[nodiscard]] std::string content(const std::string& name) const {
    std::ostringstream text;
    text << std::ifstream(path(name), std::ios::binary).rdbuf();
    return text.str();
  }
  [[nodiscard]] std::size_t files() const {
    using Iterator = std::filesystem::recursive_directory_iterator;
    return static_cast<std::size_t>(std::distance(Iterator(home_), Iterator()));
  }
  int put(const std::string& name, const std::string& body, bool only_new = false) {
    std::map<std::string, std::string> headers;
    if (only_new) headers.emplace("if-none-match", "*");
    return ask("PUT", "/api/v1/scenarios/" + name, body, headers).status;
  }
};

TEST_F(ScenariosTest, CellsComeBackWithTheirEdits) {
  const std::string body = saving(
      "\"grid\":" + grid, R"(,"planner":"theta_star","model":"corners","edits":[{"block":[0,1,2,1]}])");
  const Json saved = json("PUT", "/api/v1/scenarios/wall.yaml", body, 201);
  EXPECT_EQ(saved["files"], Json({"wall_map.pgm", "wall_map.yaml", "wall.yaml"}));
  const Json shown = json("GET", "/api/v1/scenarios/wall.yaml");
  EXPECT_EQ(shown["map"]["grid"]["runs"], Json::parse("[0,3,2,1,1,2,0,2]"));
  EXPECT_EQ(shown["map"]["grid"]["origin"], Json::parse("[-1.0,0.5]"));
  EXPECT_EQ(shown["start"], Json::parse("[0.25,0.75]"));
  EXPECT_EQ(shown["model"], "corners");
  EXPECT_EQ(shown["radius_m"], 0.1);
}

TEST_F(ScenariosTest, PolygonsComeBackWithTheirEdits) {
  const std::string body =
      saving("\"polygons\":" + room,
             R"(,"planner":"visibility_graph","edits":[{"add":[[4,1],[5,1],[5,2]]},{"remove":0}])");
  const Json saved = json("PUT", "/api/v1/scenarios/a.yaml", body, 201);
  EXPECT_EQ(saved["files"], Json({"a_map.txt", "a.yaml"}));
  const Json shown = json("GET", "/api/v1/scenarios/a.yaml");
  EXPECT_EQ(shown["planner"], "visibility_graph");
  EXPECT_EQ(shown["map"]["polygons"]["obstacles"], Json::parse("[[[4.0,1.0],[5.0,1.0],[5.0,2.0]]]"));
}

TEST_F(ScenariosTest, OnlyWhatWasSavedHereIsReplaced) {
  const std::string body = saving("\"grid\":" + grid);
  EXPECT_EQ(put("a.yaml", body, true), 201);
  EXPECT_EQ(put("a.yaml", body, true), 412);
  EXPECT_EQ(put("a.yaml", saving("\"grid\":" + grid, R"(,"edits":[{"block":[0,0,1,1]}])")), 200);
  EXPECT_NE(content("a_map.pgm").find("Saved by"), std::string::npos);

  write("mine.yaml", "job: plan\nmap: a.map\n");
  EXPECT_EQ(put("mine.yaml", body), 403);
  write("other_map.pgm", "P5 1 1 255\n.");
  EXPECT_EQ(put("other.yaml", body), 403);
  EXPECT_EQ(content("mine.yaml"), "job: plan\nmap: a.map\n");
  EXPECT_EQ(content("other_map.pgm"), "P5 1 1 255\n.");
  EXPECT_FALSE(std::filesystem::exists(path("other.yaml")));
  EXPECT_FALSE(std::filesystem::exists(path("other_map.yaml")));
}

TEST_F(ScenariosTest, NamesAndLinksLeadNowhereElse) {
  const std::string body = saving("\"grid\":" + grid);
  const TemporaryFolder outside = std::move(*TemporaryFolder::make());
  std::filesystem::create_directory(path("real"));
  std::filesystem::create_directory_symlink(path("real"), path("inside"));
  std::filesystem::create_directory_symlink(outside.path(), path("out"));
  std::filesystem::create_symlink(outside.path() / "x", path("link_map.pgm"));
  std::filesystem::create_symlink(path("real/x.yaml"), path("here.yaml"));
  app();
  const std::size_t before = files();
  for (const char* name : {"../a.yaml", "%2e%2e/a.yaml", ".a.yaml", "a.txt", "a.yaml.txt", ".yaml",
                           "a b.yaml", "a%0a.yaml", "%22.yaml", "out/a.yaml", "inside/a.yaml", "link.yaml",
                           "here.yaml", "absent/a.yaml", "a.yaml/", "%c3%a4.yaml"}) {
    const int status = put(name, body);
    EXPECT_TRUE(status == 400 || status == 403 || status == 404) << name << " " << status;
  }
  EXPECT_EQ(files(), before);
  EXPECT_TRUE(std::filesystem::is_empty(outside.path()));
  EXPECT_EQ(put("real/a.yaml", body), 201);
}

TEST_F(ScenariosTest, WrongRequestsAreRefusedWithASentence) {
  for (const auto& [body, says] : std::vector<std::pair<std::string, std::string>>{
           {"{}", "one of plan and guard"},
           {R"({"plan":{},"guard":{}})", "one of plan and guard"},
           {R"({"plan":3})", "object"},
           {R"({"plan":{},"name":1})", "no such member"},
           {saving("\"map\":\"gone\""), "post it again"},
           {saving("\"grid\":" + grid, R"(,"edits":[{"block":[0,0,9,9]}])"), "leaves the grid"},
           {saving("\"grid\":" + grid, R"(,"options":{"no":1})"), "no such option"},
           {R"({"guard":{"scenario":"absent.yaml","start":[0,0]}})", "no such file"},
           {R"({"guard":{"scenario":"../a.yaml","start":[0,0]}})", "no path under the folder"}}) {
    const Response response = ask("PUT", "/api/v1/scenarios/a.yaml", body);
    EXPECT_EQ(response.status, 400) << body;
    EXPECT_NE(response.body.find(says), std::string::npos) << response.body;
  }
  EXPECT_EQ(ask("GET", "/api/v1/scenarios/absent.yaml").status, 404);
  write("half.yaml", "job: plan\nmap: a.map\nfrom: 0,0\n");
  write("cover.yaml", "job: cover\n");
  const std::vector<std::pair<const char*, const char*>> cases = {{"half.yaml", "it is missing"},
                                                                  {"cover.yaml", "plan and guard"}};
  for (const auto& [name, says] : cases) {
    const Response response = ask("GET", std::string("/api/v1/scenarios/") + name);
    EXPECT_EQ(response.status, 400) << name;
    EXPECT_NE(response.body.find(says), std::string::npos) << response.body;
    EXPECT_EQ(response.body.find(home_.string()), std::string::npos) << response.body;
  }
}

}  // namespace
}  // namespace outrider::server
