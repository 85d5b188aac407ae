#include <fcntl.h>
#include <signal.h>
#include <sys/file.h>
#include <sys/wait.h>

#include <atomic>

#include "app_fixture.hpp"

namespace outrider::server {
namespace {

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
  EXPECT_EQ(ask("GET", "/api/v1/runs/" + first + "/log").status, 404);
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

/// An error in the server while it follows a mission ends that mission, and its process, only.
TEST_F(AppTest, ARunThatTheServerLosesIsNoneOfTheOthers) {
  write("a.yaml", "job: guard\n");
  write_tool("echo $$ > pid\nexec sleep 1000\n");
  settings_.runs.at_once = 1;
  const Folder folder = *Folder::open(home_.string());
  Runs runs(folder, settings_.runs, settings_.read);
  const auto here = std::this_thread::get_id();
  std::atomic<int> heard = 0;
  runs.on_change([&] {
    if (std::this_thread::get_id() != here && ++heard == 1) throw std::bad_alloc();
  });
  const auto state = [&](const Response& started) {
    const std::string id = Json::parse(started.body)["id"];
    Json run;
    EXPECT_TRUE(testing::eventually([&] {
      run = Json::parse(runs.state(id).body);
      return run["state"] != "queued" && run["state"] != "running";
    }));
    return run;
  };
  const Json lost = state(runs.start({"a.yaml", {}, {}, {}}, {}));
  EXPECT_EQ(lost["state"], "failed");
  EXPECT_EQ(lost["error"], "the server lost this mission (std::bad_alloc); start it again");
  write_tool("echo '{\"status\":\"done\"}'\n");
  EXPECT_EQ(state(runs.start({"a.yaml", {}, {}, {}}, {}))["state"], "done");
}

/// An error between the lines of a mission leaves no process behind.
TEST_F(AppTest, AMissionThatIsLostIsEnded) {
  write_tool("echo $$ > pid\necho line >&3\nexec sleep 1000\n");
  std::stop_source stop;
  const auto follow = [&] {
    (void)run_child({.words = {settings_.runs.tool}, .folder = *OpenFolder::open(home_.string())},
                    stop.get_token(), {.on_line = [](std::string_view) { throw std::bad_alloc(); }});
  };
  EXPECT_THROW(follow(), std::bad_alloc);
  int pid = 0;
  std::ifstream(path("pid")) >> pid;
  ASSERT_GT(pid, 0);
  EXPECT_NE(::kill(pid, 0), 0) << "it still runs";
}

/// The limit counts the processor time of a program, not how long others keep it waiting.
TEST_F(AppTest, AProgramThatTakesTooMuchProcessorTimeIsEnded) {
  const auto followed = [&](const std::string& script) {
    write_tool(script);
    return run_child({.words = {settings_.runs.tool},
                      .folder = *OpenFolder::open(home_.string()),
                      .limit = std::chrono::seconds(1)},
                     {}, {});
  };
  EXPECT_TRUE(followed("while :; do :; done\n").timed_out);
  const ChildResult waited = followed("sleep 1.2\necho done\n");
  EXPECT_FALSE(waited.timed_out);
  EXPECT_EQ(waited.output, "done\n");
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

/// A mission is given the text as it was when it was asked for, its folder, and no more memory than is
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
  EXPECT_EQ(run["summary"]["root"], ".");
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

/// Besides its run, which is kept.
TEST_F(AppTest, AnUnsavedScenarioLeavesNoFileInTheFolder) {
  write_tool("ls -A > listing\ncat > /dev/null\necho '{\"status\":\"done\"}'\n");
  EXPECT_EQ(ended(json("POST", "/api/v1/runs", R"({"text":"job: guard"})", 202)["id"])["state"], "done");
  std::ifstream listing(path("listing"));
  const std::string names{std::istreambuf_iterator<char>(listing), {}};
  EXPECT_EQ(names, ".outrider\nlisting\ntool\n");
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
  const int folder = ::open(living->path().c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  EXPECT_EQ(::flock(folder, LOCK_EX | LOCK_NB), 0) << "who writes a file into a locked folder waits";
  ::close(folder);
}

}  // namespace
}  // namespace outrider::server
