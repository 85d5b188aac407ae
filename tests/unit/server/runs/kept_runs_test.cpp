#include "runs/kept_runs.hpp"

#include <sys/wait.h>

#include "app_fixture.hpp"

namespace outrider::server {
namespace {

namespace fs = std::filesystem;

class KeptRunsTest : public AppTest {
 protected:
  void SetUp() override {
    write("a.yaml", "job: guard\nseed: 7\n");
    write_tool(
        "mkdir -p $5 && echo log > $5/run.mcap && echo '{}' > $5/run.json && echo '{\"status\":\"done\"}'\n");
  }
  std::string started() { return json("POST", "/api/v1/runs", R"({"scenario":"a.yaml"})", 202)["id"]; }
  Json list() { return json("GET", "/api/v1/runs")["runs"]; }
  [[nodiscard]] fs::path place(const std::string& id) const { return path(".outrider/runs/" + id); }
  /// Makes the folder of a run below any place, and opens it.
  static OpenFolder opened(const fs::path& folder) {
    fs::create_directories(folder);
    return *OpenFolder::open(folder.string());
  }
  [[nodiscard]] OpenFolder folder(const std::string& id) const { return opened(place(id)); }
  std::vector<KeptRun> find() { return RunsFolder::find(*Folder::open(path("").string()), read_here()); }
  /// A run as a server leaves it that dies while the mission is under way.
  void leave_cut_short(const std::string& id) const {
    KeptRun run;
    run.id = id;
    run.scenario = "a.yaml";
    run.job = "guard";
    run.state = "running";
    run.began_s = 5;
    ASSERT_TRUE(write_state(folder(id), run));
    std::ofstream(place(id) / "live.mcap") << "part";
  }
};

TEST_F(KeptRunsTest, AreThereAgainInTheNextServer) {
  const std::string id = started();
  Json before = ended(id);
  EXPECT_EQ(before["seed"], 7) << "of the scenario";
  EXPECT_GT(before["began_s"], 1'600'000'000);
  EXPECT_GE(before["took_s"], 0.0);
  app_.reset();
  Json after = json("GET", "/api/v1/runs/" + id);
  before.erase("seq");
  after.erase("seq");
  EXPECT_EQ(after, before);
  EXPECT_EQ(body_of(ask("GET", "/api/v1/runs/" + id + "/log")), "log\n");
  EXPECT_EQ(body_of(ask("GET", "/api/v1/runs/" + id + "/result")), "{}\n");
  const std::string next = started();
  ended(next);
  EXPECT_EQ(list()[0]["id"], next);
  EXPECT_EQ(list()[1]["id"], id);
}

TEST_F(KeptRunsTest, OneThatWasUnderWayWhenItsServerDiedIsCutShort) {
  leave_cut_short("abc-1");
  const Json run = json("GET", "/api/v1/runs/abc-1");
  EXPECT_EQ(run["state"], "cut_short");
  EXPECT_EQ(run["error"], "the server ended before the mission did; it is shown as far as it came");
  EXPECT_EQ(body_of(ask("GET", "/api/v1/runs/abc-1/log")), "part");
  app_.reset();
  EXPECT_EQ(json("GET", "/api/v1/runs/abc-1")["state"], "cut_short") << "the file says so by now";
}

TEST_F(KeptRunsTest, OneThatAnotherServerCarriesOutIsLeftAlone) {
  leave_cut_short("abc-1");
  const auto other = RunsFolder::lock(folder("abc-1"));
  ASSERT_TRUE(other && other->held());
  EXPECT_TRUE(list().empty());
  EXPECT_TRUE(fs::exists(place("abc-1") / "live.mcap"));
}

/// The file that locks it cannot be opened, as in the folder of another user.
TEST_F(KeptRunsTest, OneThatMayBeUnderWayElsewhereIsNotSaidToBeCutShort) {
  leave_cut_short("abc-1");
  ASSERT_EQ(find().size(), 1U);
  leave_cut_short("abc-1");
  fs::remove(place("abc-1") / ".lock");
  fs::create_directory(place("abc-1") / ".lock");
  EXPECT_TRUE(find().empty());
}

/// A mission that waits for its server's lock comes late.
TEST_F(KeptRunsTest, AMissionWritesItsFilesWhileItsServerHoldsTheLock) {
  leave_cut_short("abc-1");
  const auto server = RunsFolder::lock(folder("abc-1"));
  ASSERT_TRUE(server && server->held());
  const std::string folder = place("abc-1").string();
  EXPECT_TRUE(write_files({{folder + "/run.json", "{}"}, {folder + "/run.svg", "<svg/>"}}, {}));
  EXPECT_TRUE(fs::exists(place("abc-1") / "run.svg"));
}

TEST_F(KeptRunsTest, TheOldestAreRemoved) {
  settings_.runs.kept = 3;
  std::vector<std::string> ids;
  for (int i = 0; i < 6; ++i) {
    ids.push_back(started());
    ended(ids.back());
  }
  app_.reset();
  const Json left = list();
  ASSERT_EQ(left.size(), 3U);
  for (std::size_t i = 0; i < 3; ++i) EXPECT_EQ(left[i]["id"], ids[5 - i]);
  EXPECT_FALSE(fs::exists(place(ids[0])));
  EXPECT_EQ(std::distance(fs::directory_iterator(path(".outrider/runs")), {}), 3);
}

TEST_F(KeptRunsTest, AMissionThatWasKilledKeepsItsLog) {
  write_tool("echo some >&4\nexec sleep 1000\n");
  const std::string id = started();
  while (json("GET", "/api/v1/runs/" + id)["state"] == "queued") std::this_thread::yield();
  while (!fs::exists(place(id) / "live.mcap") || fs::file_size(place(id) / "live.mcap") == 0)
    std::this_thread::yield();
  json("DELETE", "/api/v1/runs/" + id);
  ended(id);
  app_.reset();
  EXPECT_EQ(json("GET", "/api/v1/runs/" + id)["state"], "cancelled");
  EXPECT_EQ(body_of(ask("GET", "/api/v1/runs/" + id + "/log")), "some\n");
  EXPECT_FALSE(fs::exists(place(id) / "live.mcap"));
}

/// The runs are there, until the server ends.
TEST_F(KeptRunsTest, AFolderThatCannotBeWrittenIsSaidInASentence) {
  write(".outrider", "a file");
  const std::string id = started();
  EXPECT_EQ(ended(id)["state"], "done");
  const std::string notice = json("GET", "/api/v1/runs")["notice"];
  EXPECT_TRUE(
      notice.starts_with("runs are kept only until the server ends, since .outrider cannot be written ("))
      << notice;
  EXPECT_EQ(body_of(ask("GET", "/api/v1/runs/" + id + "/log")), "log\n");
  app_.reset();
  EXPECT_TRUE(list().empty());
  EXPECT_EQ(json("GET", "/api/v1/runs")["notice"], "");
}

/// Links lead nowhere, and what is no state of a run is none.
TEST_F(KeptRunsTest, AFolderFromAStrangerShowsNothingOfOtherPlaces) {
  const TemporaryFolder outside = std::move(*TemporaryFolder::make());
  const OpenFolder other = opened(outside.path() / "runs/abc-1");
  std::ofstream(outside.path() / "runs/abc-1/run.mcap") << "secret";
  KeptRun run;
  run.id = "abc-1";
  run.state = "done";
  ASSERT_TRUE(write_state(other, run));
  fs::create_symlink(outside.path(), path(".outrider"));
  EXPECT_TRUE(list().empty());
  ended(started());
  EXPECT_FALSE(json("GET", "/api/v1/runs")["notice"].get<std::string>().empty());
  app_.reset();
  fs::remove(path(".outrider"));
  fs::create_directories(path(".outrider/runs"));
  fs::create_symlink(outside.path() / "runs/abc-1", path(".outrider/runs/abc-1"));
  fs::create_directories(place("abc-2"));
  fs::create_symlink(outside.path() / "runs/abc-1/state.json", place("abc-2") / "state.json");
  ASSERT_TRUE(write_state(folder("abc-3"), run));  // the id is another's
  fs::create_directories(place("abc-4"));
  std::ofstream(place("abc-4") / "state.json") << R"({"id":"abc-4","state":"dancing"})";
  run.id = "abc-5";
  ASSERT_TRUE(write_state(folder("abc-5"), run));
  fs::create_symlink(outside.path() / "runs/abc-1/run.mcap", place("abc-5") / "run.mcap");
  ASSERT_EQ(list().size(), 1U);
  EXPECT_EQ(list()[0]["has_log"], false);
  EXPECT_EQ(ask("GET", "/api/v1/runs/abc-5/log").status, 404);
}

TEST(KeptRuns, StateComesBackAsItWas) {
  KeptRun run;
  run.id = "18f-12";
  run.scenario = "a.yaml";
  run.job = "guard";
  run.seed = 9;
  run.state = "not_done";
  run.error = "2 targets failed";
  run.where = "a.yaml:3";
  run.began_s = 1'700'000'000;
  run.took_s = 2.5;
  run.summary = {{"status", "not_done"}};
  const auto back = kept_run_from_json(state_json(run));
  ASSERT_TRUE(back);
  EXPECT_EQ(state_json(*back), state_json(run));
  for (const char* key : {"id", "state", "began_s", "took_s", "summary"}) {
    Json wrong = state_json(run);
    wrong[key] = "?";
    EXPECT_FALSE(kept_run_from_json(wrong)) << key;
  }
}

}  // namespace
}  // namespace outrider::server
