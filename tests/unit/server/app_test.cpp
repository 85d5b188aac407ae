#include "app_fixture.hpp"
#include "outrider/core/base64.hpp"

namespace outrider::server {
namespace {

// "page" by gzip, as made once by that program.
constexpr char page_gzip[] =
    "\x1f\x8b\x08\x00\x00\x00\x00\x00\x02\x03\x2b\x48\x4c\x4f\x05\x00\x20\xb6\x0a\x14\x04\x00\x00\x00";
const std::vector<page::File> page_files = {
    {"assets/a-1.js", "text/javascript", {page_gzip, sizeof page_gzip - 1}},
    {"index.html", "text/html", {page_gzip, sizeof page_gzip - 1}}};

TEST_F(AppTest, ThePageIsServedAsItWasBuilt) {
  settings_.files = page_files;
  for (const char* place : {"/", "/watch", "/index.html", "/try?map=a.map"}) {
    const Response plain = ask("GET", place);
    EXPECT_EQ(plain.status, 200) << place;
    EXPECT_EQ(plain.body, "page") << place;
    EXPECT_EQ(plain.type, "text/html");
  }
  const Response packed = ask("GET", "/assets/a-1.js", {}, {{"accept-encoding", "br, gzip"}});
  EXPECT_EQ(packed.body, page_files[0].gzip);
  const std::map<std::string, std::string> headers(packed.headers.begin(), packed.headers.end());
  EXPECT_EQ(headers.at("Content-Encoding"), "gzip");
  EXPECT_NE(headers.at("Cache-Control").find("immutable"), std::string::npos);
  EXPECT_NE(headers.at("Content-Security-Policy").find("script-src 'self'"), std::string::npos);
  EXPECT_EQ(ask("GET", "/absent.js").status, 404);
  EXPECT_EQ(ask("POST", "/").status, 405);
}

TEST_F(AppTest, WithoutThePageItSaysSo) {
  settings_.files = {};
  const Json answer = json("GET", "/", {}, 503);
  EXPECT_EQ(answer["code"], "no_page");
}

TEST_F(AppTest, AMethodThatIsNotTakenIsNamed) {
  const Response response = ask("PATCH", "/api/v1/runs");
  EXPECT_EQ(response.status, 405);
  const std::map<std::string, std::string> headers(response.headers.begin(), response.headers.end());
  EXPECT_EQ(headers.at("Allow"), "POST, GET");
  for (const char* nowhere :
       {"/api", "/api/", "/api/v1", "/api/v1/", "/api/v1/runs/a/b", "/api/v2/version"}) {
    EXPECT_EQ(ask("GET", nowhere).status, 404) << nowhere;
  }
}

/// After some wrong tokens the right one is not looked at either, so that nobody learns which one it is.
TEST_F(AppTest, GuessesOfTheTokenAreSlowed) {
  settings_.token = "0123456789abcdef";
  const auto asked = [&](const std::string& token, const std::string& client) {
    Request request{"GET", "/api/v1/version", {}, {{"host", "a"}}, {}};
    request.headers["authorization"] = "Bearer " + token;
    request.client = client;
    return app().answer(request).status;
  };
  bool right_is_refused = false;
  for (int i = 0; i < 100 && !right_is_refused; ++i) {  // on a busy machine some time passes in between
    int guesses = 0;
    while (guesses < 1000 && asked("a-wrong-token-00", "guesser") == 401) ++guesses;
    ASSERT_LT(guesses, 1000);
    right_is_refused = asked(settings_.token, "guesser") == 429;
  }
  EXPECT_TRUE(right_is_refused);
  EXPECT_EQ(asked(settings_.token, "owner"), 200);
  EXPECT_EQ(asked("", "guesser"), 401) << "no guess";
}

TEST_F(AppTest, FilesHaveAKind) {
  write("a/scenario.yaml", "job: cover\n");
  write("a/plain.yaml", "seed: 1\nworld: yard.sdf\n");
  write("a/gains.yaml", "wheels: 1\n");
  write("a/dance.yaml", "job: dance\n");
  write("a/map.yaml", "image: map.pgm\n");
  write("out/run.json", "{\"status\": \"done\", \"job\": \"guard\"}");
  write("out/run.mcap", "");
  write("a/run.json", "{}");
  write("out/other.json", "{}");
  write("room.txt", "(0,0)\n---\n");
  write("notes.txt", "notes");
  write(".git/config.yaml", "job: guard\n");
  std::filesystem::create_symlink("/etc/hostname", path("out/link.yaml"));
  std::map<std::string, std::string> kinds;
  const Json listed = json("GET", "/api/v1/files");
  for (const Json& file : listed["files"]) {
    kinds[file["path"].get<std::string>()] =
        file["kind"].get<std::string>() + " " + file.value("job", std::string());
  }
  const std::map<std::string, std::string> expected = {
      {"a/dance.yaml", "other dance"}, {"a/gains.yaml", "other "},   {"a/map.yaml", "map "},
      {"a/plain.yaml", "other "},      {"a/run.json", "other "},     {"a/scenario.yaml", "scenario cover"},
      {"notes.txt", "other "},         {"out/other.json", "other "}, {"out/run.json", "result guard"},
      {"out/run.mcap", "log "},        {"room.txt", "map "}};
  EXPECT_EQ(kinds, expected);
}

TEST_F(AppTest, WhatABrowserWouldRunIsTextToIt) {
  write("page.html", "<script>1</script>");
  write("picture.svg", "<svg/>");
  EXPECT_EQ(ask("GET", "/api/v1/files/page.html").type, "application/octet-stream");
  EXPECT_EQ(ask("GET", "/api/v1/files/picture.svg").type, "text/plain; charset=utf-8");
}

TEST_F(AppTest, FilesAreListedAndReadWithoutWaitingForPipes) {
  ASSERT_EQ(::mkfifo(path("pipe.yaml").c_str(), 0600), 0);
  write("a.yaml", "job: guard\n");
  EXPECT_EQ(json("GET", "/api/v1/files")["files"].size(), 1U);
  EXPECT_EQ(ask("GET", "/api/v1/files/pipe.yaml").status, 404);
  EXPECT_EQ(ask("POST", "/api/v1/runs", R"({"scenario":"pipe.yaml"})").status, 404);
}

/// Nothing is held of a document to find its job, whatever it holds and however often it names itself.
TEST_F(AppTest, AScenarioThatIsABombHasAJobAllTheSame) {
  std::string bomb = "a: &a [1,1,1,1,1,1,1,1,1,1]\n";
  for (char c = 'b'; c < 'k'; ++c) {
    const std::string last(1, static_cast<char>(c - 1));
    bomb += std::string(1, c) + ": &" + c + " [";
    for (int i = 0; i < 10; ++i) bomb += (i == 0 ? "*" : ", *") + last;
    bomb += "]\n";
  }
  write("bomb.yaml", bomb + "job: cover\n");
  EXPECT_EQ(json("GET", "/api/v1/files")["files"][0]["job"], "cover");
}

TEST_F(AppTest, RefusedRequestsTakeNothingFromTheOthers) {
  settings_.token = "0123456789abcdef";
  int refused = 0, limited = 0;
  for (int i = 0; i < 5000; ++i) {
    const int status = ask("GET", "/api/v1/version").status;
    (status == 401 ? refused : limited) += status == 401 || status == 429;
  }
  EXPECT_EQ(refused + limited, 5000);
  EXPECT_GT(limited, 0) << "the flood is held back";
  EXPECT_EQ(ask("GET", "/api/v1/version?token=0123456789abcdef").status, 200);
}

TEST_F(AppTest, JsonIsCountedBeforeItIsRead) {
  std::string many = "{\"grid\":[0";
  for (int i = 0; i < 2'000'001; ++i) many += ",0";
  const Json refused = json("POST", "/api/v1/maps", many + "]}", 400);
  EXPECT_NE(refused["error"].get<std::string>().find("2000000 values"), std::string::npos) << refused;
}

TEST_F(AppTest, MapsComeBackAsTheyWereDrawn) {
  const std::string grid =
      R"({"origin":[1.5,-2.0],"resolution_m":0.5,"width":3,"height":2,"runs":[0,2,1,1,2,3],"yaw_rad":0.1})";
  const Json map = json("POST", "/api/v1/maps", "{\"grid\":" + grid + "}");
  EXPECT_EQ(map["grid"], Json::parse(grid));
  for (const char* runs :
       {"[0,5]", "[0,7]", "[0,6,1]", "[3,6]", "[0,-6]", "[0,1e99]", "{}", "[0,9007199254740993]"}) {
    Json wrong = Json::parse(grid);
    wrong["runs"] = Json::parse(runs);
    EXPECT_EQ(ask("POST", "/api/v1/maps", Json{{"grid", wrong}}.dump()).status, 400) << runs;
  }
  const std::string room =
      R"({"boundary":[[0,0],[4,0],[4,3],[0,3]],"obstacles":[[[1,1],[2,1],[2,2]]],"queries":[]})";
  EXPECT_EQ(json("POST", "/api/v1/maps", "{\"polygons\":" + room + "}")["polygons"], Json::parse(room));
}

TEST_F(AppTest, TheCatalogueListsTheNamesThatATextCanBe) {
  const Json catalogue = Json::parse(ask("GET", "/api/v1/catalogue").body);
  for (const Json& planner : catalogue["path_planners"]) {
    if (planner["name"] != "a_star") continue;
    for (const Json& option : planner["options"]) {
      EXPECT_EQ(option.contains("choices"), option["type"] == "string") << option;
      if (option["name"] != "ties") continue;
      EXPECT_EQ(option["choices"], Json({"largest_g", "smallest_g"}));
    }
    return;
  }
  FAIL() << "the catalogue has no a_star";
}

TEST_F(AppTest, APictureAloneIsAMap) {
  const std::string picture("P5 2 2 255\n\xff\x00\xff\xff", 15);
  const Json map = json("POST", "/api/v1/maps?name=it%27s.pgm", picture);
  EXPECT_EQ(map["grid"]["runs"], Json::parse("[0,3,1,1]"));
  EXPECT_EQ(map["grid"]["resolution_m"], 0.05);
  EXPECT_EQ(map["warnings"].size(), 1U);
}

TEST_F(AppTest, SentencesNameFilesAsPeopleDo) {
  const std::string world =
      "<sdf version='1.6'><world name='w'><model name='a'><static>true</static><pose>0 0 1</pose><link "
      "name='l'>"
      "<collision name='c'><geometry><box><size>1 1 "
      "2</size></box></geometry></collision></link></model><model "
      "name='floor'><static>true</static><link name='l'><collision name='c'><geometry><plane><normal>0 0 "
      "1</normal>"
      "</plane></geometry></collision></link></model></world></sdf>";
  const Json map = json("POST", "/api/v1/maps?name=yard.sdf", world);
  ASSERT_EQ(map["warnings"].size(), 1U) << "of the pose of three numbers";
  EXPECT_TRUE(map["warnings"][0].get<std::string>().starts_with("yard.sdf:1: ")) << map["warnings"];
  const Json refused = json("POST", "/api/v1/maps?name=yard.sdf", "<sdf><world></sdf>", 400);
  EXPECT_EQ(refused["where"], "yard.sdf:1");
}

TEST_F(AppTest, EditsKeepTheNumbersOfObstacles) {
  const std::string room =
      R"({"boundary":[[0,0],[9,0],[9,3],[0,3]],"obstacles":[[[1,0],[2,0],[2,3],[1,3]],[[4,0],[5,0],[5,3],[4,3]]]})";
  const auto plan = [&](const std::string& edits, double from, double to) {
    return json("POST", "/api/v1/plan",
                "{\"polygons\":" + room + ",\"edits\":" + edits + ",\"radius_m\":0.1,\"start\":[" +
                    std::to_string(from) + ",1.5],\"goal\":[" + std::to_string(to) +
                    ",1.5],\"planner\":\"visibility_graph_implicit\"}")["status"];
  };
  EXPECT_EQ(plan("[]", 0.5, 3), "not_done");
  EXPECT_EQ(plan(R"([{"remove":0}])", 0.5, 3), "done");
  EXPECT_EQ(plan(R"([{"remove":0},{"remove":1}])", 0.5, 8), "done");
  EXPECT_EQ(plan(R"([{"remove":1}])", 0.5, 3), "not_done");
  EXPECT_EQ(
      plan(
          R"([{"remove":0},{"add":[[6,0],[7,0],[7,3],[6,3]]},{"remove":1},{"set":2,"polygon":[[6,0],[7,0],[7,1],[6,1]]}])",
          0.5, 8),
      "done");
}

/// Each expansion of a trace has a parent that was expanded before it, and the cost of the way there.
TEST_F(AppTest, ATraceTellsWhatTheSearchDid) {
  const std::string grid = R"({"resolution_m":0.5,"width":20,"height":20,"runs":[0,190,1,15,0,195]})";
  const Json plan = json(
      "POST", "/api/v1/plan",
      "{\"grid\":" + grid +
          R"(,"start":[1.1,1.1],"goal":[1.1,9.1],"planner":"a_star","model":"cells","radius_m":0,"trace":100000})");
  ASSERT_EQ(plan["status"], "done");
  std::map<std::pair<int, int>, double> cost;
  for (const Json& row : plan["view"]["trace"]["rows"]) {
    const std::pair<int, int> v = {row[0], row[1]}, parent = {row[2], row[3]};
    if (cost.empty()) {
      EXPECT_EQ(v, parent);
      EXPECT_EQ(row[5], 0.0);
    } else {
      ASSERT_TRUE(cost.contains(parent));
      const double step = std::hypot(v.first - parent.first, v.second - parent.second);
      EXPECT_NEAR(row[5].get<double>(), cost[parent] + step, 1e-9);
    }
    cost[v] = row[5];
  }
  const std::pair<int, int> goal = {2, 18};
  EXPECT_NEAR(0.5 * cost.at(goal), plan["rows"][0]["cost"].get<double>(), 1e-9);
  const Json part =
      json("POST", "/api/v1/plan",
           "{\"grid\":" + grid +
               R"(,"start":[1.1,1.1],"goal":[1.1,9.1],"planner":"a_star","radius_m":0,"trace":5})");
  EXPECT_EQ(part["view"]["trace"]["rows"].size(), 5U);
  EXPECT_EQ(part["view"]["trace"]["truncated"], true);
}

TEST_F(AppTest, MapsArePackedAndUnpackedAsTheyAre) {
  KnownMap cells{{}, "a.pgm", MapCells{{}, 0.25}, {"a warning"}, 0.5};
  auto& occupancy = std::get<MapCells>(cells.shape).occupancy;
  occupancy.frame = {{1.0 / 3.0, -2.0}, 0.1, 3, 2};
  occupancy.cells = {0, 1, 2, 2, 1, 0};
  const auto again = unpacked(Json::parse(packed(cells).dump()));
  ASSERT_TRUE(again);
  EXPECT_EQ(map_json(*again), map_json(cells));
  const KnownMap room{{}, "b.txt", PolygonMap{{{0, 0}, {4, 0}, {0, 1.0 / 3.0}}, {}, {}}, {}, 0.2};
  EXPECT_EQ(map_json(*unpacked(packed(room))), map_json(room));
  Json wrong = packed(cells);
  wrong["cells"]["base64"] = "AAAA";
  EXPECT_FALSE(unpacked(wrong));
  EXPECT_FALSE(unpacked(Json::object()));
}

TEST(Base64, ReadsWhatTheStandardSays) {  // RFC 4648, section 10
  const std::pair<const char*, const char*> vectors[] = {{"", ""},
                                                         {"Zg==", "f"},
                                                         {"Zm8=", "fo"},
                                                         {"Zm9v", "foo"},
                                                         {"Zm9vYg==", "foob"},
                                                         {"Zm9vYmE=", "fooba"},
                                                         {"Zm9vYmFy", "foobar"}};
  for (const auto& [text, bytes] : vectors) {
    EXPECT_EQ(base64_decoded(text), bytes);
    EXPECT_EQ(base64_encoded(bytes), text);
  }
  for (const char* wrong : {"Z", "Zg=", "Zg", "Z g=", "Zm9v\n", "===="})
    EXPECT_FALSE(base64_decoded(wrong)) << wrong;
}

}  // namespace
}  // namespace outrider::server
