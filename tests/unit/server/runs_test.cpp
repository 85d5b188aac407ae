#include <signal.h>
#include <sys/wait.h>

#include <atomic>
#include <map>
#include <mutex>

#include "app_fixture.hpp"

namespace outrider::server {
namespace {

// The folder of the report is the fifth word: run SCENARIO --json --out FOLDER.
const std::string report_script = R"sh(
mkdir -p "$5"
echo '{"step":1,"steps":2,"name":"thinking","part":0.00}' >&3
echo 'this is no progress' >&3
echo '{"step":2,"steps":2,"name":"driving","part":0.50}' >&3
echo '{"outrider_report":1,"job":"guard","robot":{"start":[0,0,0]},"targets":[{"name":"cat"}],"events":[{"time_s":1,"kind":"shot","text":"Shot."}],"track":[[0,1,2,3,4,5]],"explore":{"map":{"columns":1},"walls":[]}}' >&3
echo '{"outrider_report":1,"job":"","robot":{"start":[0,0,0]},"targets":[],"events":[],"track":[[1,1,2,3,4,5]],"explore":{"map":{"columns":0},"beliefs":[7]},"pursuit":{"robots":[[],[]]}}' >&3
echo '{"outrider_report":1,"job":"","events":7,"explore":{"map":{"columns":2}}}' >&3
echo '{"outrider_report":1,"job":3}' >&3
printf '{"outrider_report":1,"job":"guard","events":[{"time_s":1,"kind":"shot","text":"Shot."}],"track":[[0,1,2,3,4,5],[1,1,2,3,4,5]]}' > "$5/guard.json"
echo '{"status":"done","files":{"report":"/x"}}'
)sh";

/// Sends what a viewer is told into a list, until it has had the message of that type.
class Listener {
 public:
  explicit Listener(App& app) : viewer_(app.live().open()) {
    thread_ = std::thread([this] {
      viewer_->serve([this](const std::string& text) {
        const std::lock_guard lock(mutex_);
        told_.push_back(Json::parse(text));
        return true;
      });
    });
  }
  ~Listener() {
    viewer_->close();
    thread_.join();
  }
  bool say(const std::string& text) { return viewer_->receive(text); }
  /// What was told, up to the first message of that type.
  std::vector<Json> until(const std::string& type) {
    for (int i = 0; i < 2000; ++i) {
      {
        const std::lock_guard lock(mutex_);
        const auto found = std::find_if(told_.begin(), told_.end(),
                                        [&](const Json& message) { return message["type"] == type; });
        if (found != told_.end()) return {told_.begin(), found + 1};
      }
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
    ADD_FAILURE() << "nothing of type " << type;
    return {};
  }

 private:
  std::shared_ptr<Viewer> viewer_;
  std::mutex mutex_;
  std::vector<Json> told_;
  std::thread thread_;
};

TEST_F(AppTest, ARunTellsWhatItIsAtAndLeavesItsReport) {
  write("a.yaml", "job: guard\n");
  write_tool(report_script);
  const std::string id = json("POST", "/api/v1/runs", R"({"scenario":"a.yaml"})", 202)["id"];
  const Json run = ended(id);
  EXPECT_EQ(run["state"], "done");
  EXPECT_EQ(run["progress"], Json::parse(R"({"step":2,"steps":2,"name":"driving","part":0.5})"));
  EXPECT_EQ(run["summary"], Json::parse(R"({"status":"done"})")) << "paths of ours are none of theirs";
  EXPECT_EQ(json("GET", "/api/v1/runs/" + id + "/report")["job"], "guard");

  Listener viewer(app());
  EXPECT_TRUE(viewer.say(R"({"type":"watch","run":")" + id + "\"}"));
  std::vector<std::string> types;
  for (const Json& message : viewer.until("end")) types.push_back(message["type"]);
  const std::vector<std::string> expected = {"hello",  "state",  "state",   "progress", "scene", "samples",
                                             "events", "growth", "samples", "map",      "end"};
  EXPECT_EQ(types, expected) << "of two tellings of progress, and of two maps, the newer";
}

TEST_F(AppTest, WhatAMissionTellsOfItsReportIsGivenOnInParts) {
  write("a.yaml", "job: guard\n");
  write_tool(report_script);
  const std::string id = json("POST", "/api/v1/runs", R"({"scenario":"a.yaml"})", 202)["id"];
  Listener viewer(app());
  EXPECT_TRUE(viewer.say(R"({"type":"watch","run":")" + id + "\"}"));
  std::map<std::string, std::vector<Json>> told;
  for (Json& message : viewer.until("end")) told[message["type"]].push_back(message);
  ASSERT_EQ(told["scene"].size(), 1U);
  const Json& scene = told["scene"][0]["report"];
  EXPECT_EQ(scene["targets"], Json::parse(R"([{"name":"cat"}])"));
  EXPECT_EQ(scene["explore"], Json::parse(R"({"walls":[]})")) << "the map comes by itself";
  EXPECT_TRUE(scene["track"].empty() && scene["events"].empty());
  EXPECT_EQ(told["events"][0]["events"][0]["text"], "Shot.");
  ASSERT_EQ(told["samples"].size(), 2U);
  EXPECT_EQ(told["samples"][1]["rows"], Json::parse("[[1,1,2,3,4,5]]"));
  EXPECT_EQ(told["growth"][0]["report"], Json::parse(R"({"explore":{"beliefs":[7]}})"))
      << "without what is empty";
  EXPECT_EQ(told["map"].back()["map"]["columns"], 2);
}

TEST_F(AppTest, AMissionGoesOnWhileAViewerStalls) {
  write("a.yaml", "job: guard\n");
  write_tool(R"sh(
echo '{"outrider_report":1,"job":"explore","events":[],"track":[]}' >&3
i=0
while [ $i -lt 400 ]; do
  i=$((i + 1))
  echo '{"outrider_report":1,"job":"","track":[['$i',0,0,0,0,0]],"explore":{"map":{"columns":'$i'}}}' >&3
done
echo '{"status":"done"}'
)sh");
  std::mutex held;
  std::atomic<int> received = 0;
  std::unique_lock stalls(held);
  const auto stalled = app().live().open();
  std::thread reads([&] {
    stalled->serve([&](const std::string&) {
      const std::lock_guard wait(held);
      ++received;
      return true;
    });
  });
  const std::string id = json("POST", "/api/v1/runs", R"({"scenario":"a.yaml"})", 202)["id"];
  EXPECT_TRUE(stalled->receive(R"({"type":"watch","run":")" + id + "\"}"));
  Listener viewer(app());
  EXPECT_TRUE(viewer.say(R"({"type":"watch","run":")" + id + "\"}"));
  const std::vector<Json> all = viewer.until("end");
  EXPECT_EQ(ended(id)["state"], "done");
  EXPECT_EQ(received, 0);
  // Somebody who comes back in the middle, and late, has all samples of the rest and the last map only.
  const std::uint64_t middle = all[all.size() / 2]["seq"];
  Listener late(app());
  EXPECT_TRUE(late.say(R"({"type":"watch","run":")" + id + R"(","from":)" + std::to_string(middle) + "}"));
  std::vector<Json> rest, again, maps;
  for (const Json& message : all) {
    if (message["type"] == "samples" && message["seq"] > middle) rest.push_back(message);
  }
  for (const Json& message : late.until("end")) {
    if (message["type"] == "samples") again.push_back(message);
    if (message["type"] == "map") maps.push_back(message);
  }
  EXPECT_EQ(again, rest);
  ASSERT_EQ(maps.size(), 1U);
  EXPECT_EQ(maps[0]["map"]["columns"], 400);
  stalls.unlock();
  while (received < 400) std::this_thread::yield();  // it is behind, no more
  stalled->close();
  reads.join();
}

TEST_F(AppTest, ARunIsCancelledWhileItWaitsAndWhileItWorks) {
  write("a.yaml", "job: guard\n");
  write_tool("trap '' TERM\nsleep 1000 & wait\nsleep 1000\n");  // it will not end when it is asked to
  settings_.runs.at_once = 1;
  settings_.runs.waiting = 1;
  const std::string first = json("POST", "/api/v1/runs", R"({"scenario":"a.yaml"})", 202)["id"];
  while (json("GET", "/api/v1/runs/" + first)["state"] == "queued") std::this_thread::yield();
  const std::string second = json("POST", "/api/v1/runs", R"({"scenario":"a.yaml"})", 202)["id"];
  EXPECT_EQ(ask("POST", "/api/v1/runs", R"({"scenario":"a.yaml"})").status, 429);
  EXPECT_EQ(json("DELETE", "/api/v1/runs/" + second)["state"], "cancelled");
  json("DELETE", "/api/v1/runs/" + first);
  EXPECT_EQ(ended(first)["state"], "cancelled");
  EXPECT_EQ(json("DELETE", "/api/v1/runs/" + first)["state"], "cancelled");
  EXPECT_EQ(ask("GET", "/api/v1/runs/" + first + "/report").status, 404);
}

TEST_F(AppTest, ARunThatBreaksIsSaidToHaveFailed) {
  write("a.yaml", "job: guard\n");
  write_tool("echo 'something broke' >&2\nkill -9 $$\n");
  const Json broken = ended(json("POST", "/api/v1/runs", R"({"scenario":"a.yaml"})", 202)["id"]);
  EXPECT_EQ(broken["state"], "failed");
  EXPECT_EQ(broken["error"], "the mission ended before it had an answer: something broke");
  write_tool(R"(echo '{"reason":"no such word","where":"'$2':3"}'; exit 2)");
  const Json refused = ended(json("POST", "/api/v1/runs", R"({"text":"job: guard"})", 202)["id"]);
  EXPECT_EQ(refused["state"], "refused");
  EXPECT_EQ(refused["where"], "scenario:3");
  const Json named = ended(json("POST", "/api/v1/runs", R"({"scenario":"a.yaml"})", 202)["id"]);
  EXPECT_EQ(named["where"], "a.yaml:3");
}

/// What goes wrong in the server while it follows a mission ends that mission, and its process, only.
TEST_F(AppTest, ARunThatTheServerLosesIsNoneOfTheOthers) {
  write("a.yaml", "job: guard\n");
  write_tool("echo $$ > pid\nexec sleep 1000\n");
  settings_.runs.at_once = 1;
  const Folder folder = *Folder::open(home_.path().string());
  Runs runs(folder, settings_.runs, settings_.jobs);
  const auto here = std::this_thread::get_id();
  std::atomic<int> heard = 0;
  runs.on_change([&] {
    if (std::this_thread::get_id() != here && ++heard == 1) throw std::bad_alloc();
  });
  const auto state = [&](const Response& started) {
    const std::string id = Json::parse(started.body)["id"];
    for (int i = 0; i < 2000; ++i) {
      const Json run = Json::parse(runs.state(id).body);
      if (run["state"] != "queued" && run["state"] != "running") return run;
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
    return Json();
  };
  const Json lost = state(runs.start({"a.yaml", {}, {}, {}}));
  EXPECT_EQ(lost["state"], "failed");
  EXPECT_EQ(lost["error"], "the server lost this mission (std::bad_alloc); start it again");
  write_tool("echo '{\"status\":\"done\"}'\n");
  EXPECT_EQ(state(runs.start({"a.yaml", {}, {}, {}}))["state"], "done");
}

/// An error between the lines of a mission leaves no process behind.
TEST_F(AppTest, AMissionThatIsLostIsEnded) {
  write_tool("echo $$ > pid\necho line >&3\nexec sleep 1000\n");
  std::stop_source stop;
  const auto follow = [&] {
    (void)run_child({.words = {settings_.runs.tool}, .folder = home_.path().string()}, stop.get_token(),
                    [](std::string_view) { throw std::bad_alloc(); });
  };
  EXPECT_THROW(follow(), std::bad_alloc);
  int pid = 0;
  std::ifstream(path("pid")) >> pid;
  ASSERT_GT(pid, 0);
  EXPECT_NE(::kill(pid, 0), 0) << "it still runs";
}

TEST_F(AppTest, WhatIsTooLargeToBeToldIsSaidToBe) {
  write("a.yaml", "job: guard\n");
  write_tool(R"sh(
echo '{"omitted":"scene","bytes":5767168,"most_bytes":4194304}' >&3
echo '{"omitted":"something","bytes":1,"most_bytes":1}' >&3
echo '{"status":"done"}'
)sh");
  const std::string id = json("POST", "/api/v1/runs", R"({"scenario":"a.yaml"})", 202)["id"];
  Listener viewer(app());
  EXPECT_TRUE(viewer.say(R"({"type":"watch","run":")" + id + "\"}"));
  std::vector<Json> told;
  for (const Json& message : viewer.until("end")) {
    if (message["type"] == "omitted") told.push_back(message);
  }
  ASSERT_EQ(told.size(), 1U);
  EXPECT_EQ(told[0]["what"], "scene");
  EXPECT_EQ(
      told[0]["sentence"],
      "what stands still here takes 5.5 MiB, and at most 4.0 MiB are told while a mission runs; the report "
      "has it in the end");
}

TEST_F(AppTest, ARunThatTakesTooLongIsEnded) {
  write("a.yaml", "job: guard\n");
  write_tool("exec sleep 1000\n");
  settings_.runs.limit = std::chrono::seconds(0);
  EXPECT_EQ(ended(json("POST", "/api/v1/runs", R"({"scenario":"a.yaml"})", 202)["id"])["state"], "failed");
}

TEST_F(AppTest, TheNewestRunsAreKept) {
  write("a.yaml", "job: guard\n");
  write_tool("echo '{}'\n");
  std::string last;
  settings_.runs.kept = 3;
  for (int i = 0; i < 6; ++i) {
    last = json("POST", "/api/v1/runs", R"({"scenario":"a.yaml"})", 202)["id"];
    ended(last);
  }
  const Json runs = json("GET", "/api/v1/runs")["runs"];
  EXPECT_EQ(runs.size(), 4U) << "and the last, which had not ended when it came";
  EXPECT_EQ(runs[0]["id"], last);
}

TEST_F(AppTest, ManyMissionsGoWithTheServer) {
  write("a.yaml", "job: guard\n");
  write_tool("exec sleep 1000\n");
  for (int i = 0; i < 6; ++i) json("POST", "/api/v1/runs", R"({"scenario":"a.yaml"})", 202);
  app_.reset();  // would hang if it waited for them
}

TEST_F(AppTest, AViewerThatSaysNonsenseIsToldOrLetGo) {
  Listener viewer(app());
  EXPECT_TRUE(viewer.say(R"({"type":"dance","id":3})"));
  const Json error = viewer.until("error").back();
  EXPECT_EQ(error["id"], 3);
  for (const char* text : {"", "[]", "1", "{", "\xff"}) EXPECT_FALSE(viewer.say(text)) << text;
}

TEST_F(AppTest, AViewerWhoseAnswersNobodyFetchesIsLetGo) {
  const auto viewer = app().live().open();  // nobody serves it
  bool taken = true;
  for (int i = 0; i < 5000 && taken; ++i) taken = viewer->receive(R"({"type":"ping","id":1})");
  EXPECT_FALSE(taken);
}

/// A send that never comes back holds up its own thread, and nobody else.
TEST_F(AppTest, AViewerThatStallsHoldsNobodyUp) {
  write("a.yaml", "job: guard\n");
  write_tool(report_script);
  const auto stalled = app().live().open();
  std::mutex mutex;
  std::unique_lock held(mutex);
  std::thread serving([&] {
    stalled->serve([&](const std::string&) {
      const std::lock_guard waits(mutex);
      return false;
    });
  });
  Listener viewer(app());
  viewer.say(R"({"type":"runs"})");
  const std::string id = json("POST", "/api/v1/runs", R"({"scenario":"a.yaml"})", 202)["id"];
  stalled->receive(R"({"type":"watch","run":")" + id + "\"}");
  viewer.say(R"({"type":"watch","run":")" + id + "\"}");
  EXPECT_EQ(viewer.until("end").back()["run"], id);
  held.unlock();
  serving.join();
}

/// What a mission is given: the text as it was when it was asked for, its folder, and no more memory than is
/// allowed.
TEST_F(AppTest, AMissionWorksOnTheTextThatWasChecked) {
  write("a.yaml", "job: guard\nseed: 1\n");
  write_tool(
      R"(text=$(cat); echo "{\"status\":\"done\",\"text\":\"$(echo $text)\",\"name\":\"$2\",\"root\":\"$OUTRIDER_CONFINE\",)"
      R"(\"memory\":\"$(ulimit -d)\"}")");
  settings_.runs.memory_bytes = std::size_t{256} << 20U;
  const Json run = ended(json("POST", "/api/v1/runs", R"({"scenario":"a.yaml"})", 202)["id"]);
  EXPECT_EQ(run["summary"]["text"], "job: guard seed: 1");
  EXPECT_EQ(run["summary"]["name"], "a.yaml");
  EXPECT_EQ(run["summary"]["root"], home_.path().string());
  EXPECT_EQ(run["summary"]["memory"], limits_memory ? "262144" : "unlimited") << "KiB";
}

TEST_F(AppTest, WhatIsWrittenOverAScenarioComesTooLateForItsRun) {
  write("a.yaml", "job: guard\nseed: 1\n");
  write_tool(
      R"(until [ -e go ]; do sleep 0.01; done; text=$(cat); echo "{\"status\":\"done\",\"text\":\"$(echo $text)\"}")");
  settings_.runs.at_once = 1;
  const std::string first = json("POST", "/api/v1/runs", R"({"scenario":"a.yaml"})", 202)["id"];
  const std::string second = json("POST", "/api/v1/runs", R"({"scenario":"a.yaml"})", 202)["id"];
  EXPECT_EQ(json("GET", "/api/v1/runs/" + second)["state"], "queued");
  EXPECT_EQ(ask("PUT", "/api/v1/files/a.yaml", "job: guard\nworld: ../outside.sdf\n").status, 200);
  write("go", "");
  EXPECT_EQ(ended(first)["summary"]["text"], "job: guard seed: 1");
  EXPECT_EQ(ended(second)["summary"]["text"], "job: guard seed: 1");
}

/// The same sentences as `outrider run` has.
TEST_F(AppTest, AScenarioWithoutAJobIsRefused) {
  write_tool("cat > /dev/null\necho '{\"status\":\"done\"}'\n");
  write("plain.yaml", "seed: 1\nworld: yard.sdf\n");
  write("dance.yaml", "job: dance\n");
  const Json missing = json("POST", "/api/v1/runs", R"({"scenario":"plain.yaml"})", 400);
  EXPECT_EQ(missing["error"], job_of_scenario(jobs(), path("plain.yaml")).error().sentence);
  EXPECT_EQ(missing["where"], "plain.yaml");
  const Json unknown = json("POST", "/api/v1/runs", R"({"scenario":"dance.yaml"})", 400);
  EXPECT_EQ(unknown["error"], job_of_scenario(jobs(), path("dance.yaml")).error().sentence);
}

TEST_F(AppTest, AnUnsavedScenarioLeavesNoFileInTheFolder) {
  write_tool("ls -A > listing\ncat > /dev/null\necho '{\"status\":\"done\"}'\n");
  EXPECT_EQ(ended(json("POST", "/api/v1/runs", R"({"text":"job: guard"})", 202)["id"])["state"], "done");
  std::ifstream listing(path("listing"));
  const std::string names{std::istreambuf_iterator<char>(listing), {}};
  EXPECT_EQ(names, "listing\ntool\n");
}

TEST(TemporaryFolders, AreRemovedOnceTheirServerIsGone) {
  const auto living = TemporaryFolder::make();
  ASSERT_TRUE(living);
  const pid_t killed = ::fork();
  if (killed == 0) {
    const auto abandoned = TemporaryFolder::make();
    std::ofstream(living->path() / "name") << abandoned->path().string();
    ::raise(SIGKILL);
  }
  ::waitpid(killed, nullptr, 0);
  std::ifstream file(living->path() / "name");
  const std::string abandoned{std::istreambuf_iterator<char>(file), {}};
  ASSERT_TRUE(std::filesystem::is_directory(abandoned)) << "it was left behind";
  TemporaryFolder::remove_abandoned();
  EXPECT_FALSE(std::filesystem::exists(abandoned));
  EXPECT_TRUE(std::filesystem::is_directory(living->path()));
}

}  // namespace
}  // namespace outrider::server
