#include <atomic>

#include "listener.hpp"
#include "runs/growing_log.hpp"

namespace outrider::server {
namespace {

// The folder of the run is the fifth word: run SCENARIO --json --out FOLDER.
const std::string telling_script = R"sh(
mkdir -p "$5"
echo '{"step":1,"steps":2,"name":"thinking","part":0.00}' >&3
echo 'this is no progress' >&3
head -c 1000 live.mcap >&4
echo '{"step":2,"steps":2,"name":"driving","part":0.50}' >&3
tail -c +1001 live.mcap >&4
cp live.mcap "$5/run.mcap"
printf '{"status":"done","job":"guard"}' > "$5/run.json"
echo '{"status":"done","files":{"log":"/x"}}'
)sh";

class LiveTest : public AppTest {
 protected:
  LiveTest() { write_tool(telling_script); }  // the server must know where it is when it starts
  /// Starts a mission whose tool is this script; its log is in live.mcap.
  std::string start(const std::string& script, int messages) {
    write("a.yaml", "job: guard\n");
    write("live.mcap", log_of(messages));
    write_tool(script);
    return json("POST", "/api/v1/runs", R"({"scenario":"a.yaml"})", 202)["id"];
  }
};

/// Like EXPECT_EQ, without the bytes in the message.
void expect_same(std::string_view log, std::string_view expected) {
  EXPECT_EQ(log.size(), expected.size());
  EXPECT_TRUE(log == expected);
}

std::vector<std::string> types_of(const std::vector<Json>& messages) {
  std::vector<std::string> types;
  for (const Json& message : messages) types.push_back(message["type"]);
  return types;
}

TEST_F(LiveTest, ARunTellsItsProgressAndLeavesItsLog) {
  const std::string id = start(telling_script, 20'000);
  const Json run = ended(id);
  EXPECT_EQ(run["state"], "done");
  EXPECT_EQ(run["progress"], Json::parse(R"({"step":2,"steps":2,"name":"driving","part":0.5})"));
  EXPECT_EQ(run["summary"], Json::parse(R"({"status":"done"})")) << "paths of ours are none of theirs";
  EXPECT_TRUE(run["has_log"] && run["has_result"]);
  expect_same(body_of(ask("GET", "/api/v1/runs/" + id + "/log")), log_of(20'000));
  EXPECT_EQ(json("GET", "/api/v1/runs/" + id + "/result")["job"], "guard");

  Listener viewer(app());
  EXPECT_TRUE(viewer.watch(id));
  std::vector<std::string> types = types_of(viewer.until("end"));
  std::ranges::sort(types);
  const std::vector<std::string> expected = {"end", "hello", "log", "progress", "state", "state"};
  EXPECT_EQ(types, expected) << "of two tellings of progress the newer";
  expect_same(viewer.log_until("end"), log_of(20'000));
  EXPECT_EQ(viewer.log_until("log"), "");
  EXPECT_LE(viewer.largest_frame(), 65536U);
}

TEST_F(LiveTest, WhoeverComesBackGoesOnInTheMiddle) {
  const std::string id = start(telling_script, 2000);
  ended(id);
  const std::string whole = log_of(2000);
  for (const std::uint64_t at :
       {std::uint64_t{0}, std::uint64_t{1}, std::uint64_t{999}, whole.size() - 1, whole.size()}) {
    Listener viewer(app());
    EXPECT_TRUE(viewer.watch(id, 0, at));
    expect_same(viewer.log_until("end"), whole.substr(at));
    for (const Json& message : viewer.until("end")) {
      if (message["type"] == "log") {
        EXPECT_EQ(message["from"], at);
      }
    }
  }
}

TEST_F(LiveTest, AMissionGoesOnWhileAViewerStalls) {
  std::mutex held;
  std::string received;
  std::unique_lock stalls(held);
  const auto stalled = app().live().open();
  std::thread reads([&] {
    stalled->serve([&](FrameKind kind, const std::string& data) {
      const std::lock_guard wait(held);
      if (kind == FrameKind::binary) received += data;
      return kind == FrameKind::binary || Json::parse(data)["type"] != "end";
    });
  });
  const std::string id = start(telling_script, 20'000);
  EXPECT_TRUE(stalled->receive(R"({"type":"watch","run":")" + id + "\"}"));
  EXPECT_EQ(ended(id)["state"], "done");
  EXPECT_EQ(received, "");
  stalls.unlock();
  reads.join();
  expect_same(received, log_of(20'000));  // it is behind, no more
}

TEST_F(LiveTest, AMissionThatIsKilledLeavesTheLogSoFar) {
  const std::string id = start("head -c 5000 live.mcap >&4\nkill -9 $$\n", 2000);
  const Json run = ended(id);
  EXPECT_EQ(run["state"], "failed");
  EXPECT_TRUE(run["has_log"]);
  EXPECT_FALSE(run["has_result"]);
  expect_same(body_of(ask("GET", "/api/v1/runs/" + id + "/log")), log_of(2000).substr(0, 5000));
  EXPECT_EQ(ask("GET", "/api/v1/runs/" + id + "/result").status, 404);
}

TEST_F(LiveTest, ALogThatIsTooLongEndsAndItsMissionGoesOn) {
  settings_.runs.live_log_bytes = 1 << 20U;
  const std::string id = start(telling_script, 200'000);
  ASSERT_GT(log_of(200'000).size(), 2U << 20U);
  Listener viewer(app());
  EXPECT_TRUE(viewer.watch(id));
  const std::vector<Json> told = viewer.until("end");
  EXPECT_EQ(told.back()["state"], "done");
  const std::string log = viewer.log_until("end");
  EXPECT_LE(log.size(), 1U << 20U);
  expect_same(log, log_of(200'000).substr(0, log.size()));
  const auto stop =
      std::ranges::find_if(told, [](const Json& message) { return message.contains("stopped"); });
  ASSERT_NE(stop, told.end());
  EXPECT_EQ((*stop)["from"], log.size());
  EXPECT_EQ((*stop)["stopped"],
            "the live log ends here, because it has the 1 MiB that the server keeps of one; the mission goes "
            "on, and "
            "its log can be fetched when it has ended");
  expect_same(body_of(ask("GET", "/api/v1/runs/" + id + "/log")), log_of(200'000));
}

TEST_F(LiveTest, OldLiveLogsMakeRoomForNewOnes) {
  settings_.runs.live_logs_bytes = 150'000;
  settings_.runs.at_once = 1;
  const std::string first = start(telling_script, 2000);
  ASSERT_GT(2 * log_of(2000).size(), 150'000U);
  ended(first);
  const std::string second = json("POST", "/api/v1/runs", R"({"scenario":"a.yaml"})", 202)["id"];
  ended(second);
  Listener old(app());
  EXPECT_TRUE(old.watch(first));
  const std::vector<Json> told = old.until("end");
  EXPECT_EQ(told[1]["stopped"], "the live log of this run is not kept any more; fetch its log instead");
  EXPECT_EQ(old.log_until("end"), "");
  expect_same(body_of(ask("GET", "/api/v1/runs/" + first + "/log")), log_of(2000));
  Listener fresh(app());
  EXPECT_TRUE(fresh.watch(second));
  expect_same(fresh.log_until("end"), log_of(2000));
}

TEST_F(LiveTest, LogsOfMissionsThatRunAreBoundedTogether) {
  settings_.runs.live_logs_bytes = 50'000;
  const std::string id = start(telling_script, 20'000);
  Listener viewer(app());
  EXPECT_TRUE(viewer.watch(id));
  EXPECT_EQ(viewer.until("end").back()["state"], "done");
  EXPECT_LE(viewer.log_until("end").size(), 50'000U);
  expect_same(body_of(ask("GET", "/api/v1/runs/" + id + "/log")), log_of(20'000));
}

TEST_F(LiveTest, AViewerThatSaysNonsenseIsToldOrLetGo) {
  Listener viewer(app());
  EXPECT_TRUE(viewer.say(R"({"type":"dance","id":3})"));
  const Json error = viewer.until("error").back();
  EXPECT_EQ(error["id"], 3);
  for (const char* text : {"", "[]", "1", "{", "\xff"}) EXPECT_FALSE(viewer.say(text)) << text;
}

TEST_F(LiveTest, AViewerWhoseAnswersNobodyFetchesIsLetGo) {
  const auto viewer = app().live().open();  // nobody serves it
  bool taken = true;
  for (int i = 0; i < 5000 && taken; ++i) taken = viewer->receive(R"({"type":"ping","id":1})");
  EXPECT_FALSE(taken);
}

TEST(GrowingLogs, AreFilesThatGoWithThem) {
  const auto home = TemporaryFolder::make();
  const auto path = home->path() / "log.mcap";
  const OpenFolder folder = *OpenFolder::open(home->path().string());
  ByteBudget budget(10);
  {
    GrowingLog log(folder, "log.mcap", 8, budget);
    EXPECT_TRUE(log.append("abcdef"));
    EXPECT_EQ(log.part(2, 3), "cde");
    EXPECT_EQ(log.part(4, 100), "ef");
    EXPECT_EQ(log.part(7, 100), "");
    GrowingLog other(folder, "other.mcap", 100, budget);
    EXPECT_FALSE(other.append("12345")) << "4 bytes are left";
    EXPECT_EQ(other.bytes(), 0U);
    EXPECT_TRUE(other.append("1234"));
    EXPECT_TRUE(log.append("ghi")) << "its own limit comes first";
    EXPECT_NE(log.stopped(), "");
    EXPECT_EQ(log.bytes(), 6U);
    EXPECT_TRUE(std::filesystem::exists(path));
  }
  EXPECT_FALSE(std::filesystem::exists(path));
  EXPECT_TRUE(budget.take(10));
  std::ofstream(path) << "of others";
  {
    const GrowingLog nowhere(folder, "log.mcap", 8, budget);
    EXPECT_NE(nowhere.stopped(), "");
  }
  EXPECT_TRUE(std::filesystem::exists(path)) << "it was there before";
}

}  // namespace
}  // namespace outrider::server
