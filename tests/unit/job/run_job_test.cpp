#include "outrider/job/run_job.hpp"

#include <gtest/gtest.h>

#include <filesystem>

#include "outrider/job/run_log.hpp"
#include "outrider/log/append.hpp"
#include "support/data.hpp"

namespace outrider {
namespace {

/// Counts to a number, a second each.
class Count final : public JobTask {
 public:
  Count() : JobTask("count") {}

  Outcome<Warnings> load() override {
    if (to < 0) return bad_input("expected a number from 0", "to");
    return Warnings{"counting is slow"};
  }

  Status run(Run& run, const RunWatch& watch) override {
    RunSteps steps(watch, 1);
    if (auto ok = steps.next("counting"); !ok) return ok;
    Report& report = run.report;
    report.status = "done";
    run.files = {{"list.txt", list}};
    for (std::int64_t i = 0; i < to; ++i) {
      steps.inner().part(static_cast<double>(i + 1) / static_cast<double>(to));
      report.metrics = {{"count", static_cast<double>(i + 1)}};
      log_event(run.log, static_cast<double>(i + 1), "number", std::to_string(i + 1));
      if (watch.stopped()) {
        mark_cancelled(report, run.log, static_cast<double>(i + 1));
        break;
      }
    }
    return {};
  }

  std::int64_t to = 3;
  std::string list;
  double pace_s = 1.0;

 protected:
  std::vector<OptionGroup> describe() override {
    return {{"",
             "the count",
             {{"to", "", -5, 100, "the last number", &to}, file_option("list", "file of names", &list)}},
            {"pace", "how fast", {{"every", "s", 0.1, 10.0, "time of a number", &pace_s}}}};
  }
};

const std::vector<Job> counting = {
    {.name = "count", .sentence = "Count.", .blank = [] { return std::make_unique<Count>(); }}};

TEST(RunJob, ReadsChangesAndRuns) {
  const test::Folder folder;
  const std::string path = folder.write("c.yaml", "job: count\nto: 4\nlist: names.txt\npace:\n  every: 2\n");
  const auto run = run_job(counting, path, {{"to", "5"}});
  ASSERT_TRUE(run) << to_string(run.error());
  EXPECT_EQ(run->report.status, "done");
  EXPECT_EQ(metric(run->report, "count"), 5.0) << "a change wins over the file";
  EXPECT_EQ(run->files.front().content, (folder.path / "names.txt").lexically_normal().string())
      << "beside the scenario";
  EXPECT_EQ(run->report.warnings, std::vector<std::string>{"counting is slow"});
  const std::vector<std::pair<std::string, std::string>> settings = {
      {"job", "count"}, {"to", "5"}, {"list", run->files.front().content}, {"pace.every", "2 s"}};
  EXPECT_EQ(run->report.settings, settings);
}

/// Counts the messages of a run that it receives.
class Counter final : public LogSink {
 public:
  void add_channel(const Channel& channel) override { topics.push_back(channel.topic); }
  void append(std::size_t, std::int64_t, std::string_view) override { ++messages; }
  std::vector<std::string> topics;
  int messages = 0;
};

TEST(RunJob, ASinkReceivesTheMessagesOfTheLog) {
  Count task;
  Counter counter;
  const auto run = run_task(counting.front(), task, {.sinks = {&counter}});
  ASSERT_TRUE(run) << to_string(run.error());
  EXPECT_EQ(counter.topics, std::vector<std::string>{"/rosout"});
  EXPECT_EQ(counter.messages, 3);
  EXPECT_EQ(events_of(run->log, "number").size(), 3U);
}

TEST(RunJob, RefusesWithTheKeyAndTheNearestOne) {
  const test::Folder folder;
  const auto fault = [&](const std::string& text, const Changes& changes = {}) {
    const auto run = run_job(counting, folder.write("c.yaml", text), changes);
    return run ? "none" : to_string(run.error());
  };
  EXPECT_NE(fault("to: 4\n").find("the key 'job' is missing"), std::string::npos);
  EXPECT_NE(fault("job: cuont\n").find("did you mean 'count'?"), std::string::npos);
  EXPECT_NE(fault("job: count\ntoo: 4\n").find("c.yaml:2"), std::string::npos);
  EXPECT_EQ(fault("job: count\nto: -2\n"), "to: expected a number from 0");
  EXPECT_EQ(fault("job: count\n", {{"to", "101"}}).substr(0, 4), "to: ");
  EXPECT_NE(fault("job: count\n", {{"pace.evry", "1"}}).find("did you mean 'pace.every'?"),
            std::string::npos);
}

TEST(RunJob, NotesWhatWasSet) {
  const test::Folder folder;
  Count task;
  ASSERT_TRUE(read_scenario(task, folder.write("c.yaml", "job: count\npace:\n  every: 2\n")));
  ASSERT_TRUE(change(task, {{"to", "2"}}));
  EXPECT_EQ(task.given, (std::set<std::string>{"job", "pace.every", "to"}));
  EXPECT_FALSE(change(task, {{"to", "x"}}));
  EXPECT_EQ(task.to, 2) << "a refused change changes nothing";
}

TEST(RunJob, AsIfTheScenarioLayElsewhere) {
  const test::Folder folder;
  Count task;
  ASSERT_TRUE(
      read_scenario(task, folder.write("c.yaml", "job: count\nlist: names.txt\n"), "other/place.yaml"));
  EXPECT_EQ(task.list, "other/names.txt");
}

TEST(RunJob, StoppedBeforeOrInTheMiddleItIsCancelled) {
  std::stop_source source;
  RunWatch watch;
  watch.stop = source.get_token();
  watch.progress = [&](const RunStep& step) {
    if (step.part > 0.5) source.request_stop();
  };
  Count task;
  task.to = 10;
  const auto middle = run_task(counting.front(), task, watch);
  ASSERT_TRUE(middle);
  EXPECT_EQ(middle->report.status, "cancelled");
  EXPECT_EQ(metric(middle->report, "count"), 6.0) << "what was done is kept";
  ASSERT_EQ(events_of(middle->log, "cancelled").size(), 1U);
  EXPECT_EQ(events_of(middle->log, "cancelled")[0].time_s(), 6.0);
  const auto before = run_task(counting.front(), task, watch);
  ASSERT_TRUE(before);
  EXPECT_EQ(before->report.status, "cancelled");
  EXPECT_EQ(before->report.job, "count");
  EXPECT_TRUE(before->report.metrics.empty());
}

/// The files that a run has begun to write are gone at once, while it still appends.
TEST(RunLog, AbandonedItLeavesNothing) {
  const test::Folder folder;
  const std::filesystem::path out = folder.path / "a" / "out";
  Count task;
  RunLog file(out.string(), "job: count\n");
  file.abandon();
  RunWatch watch{.sinks = {&file}};
  watch.progress = [&](const RunStep& step) {
    if (step.part < 0.5 || step.part > 0.9) return;  // at the second of three numbers
    EXPECT_TRUE(std::filesystem::exists(out / "running.mcap"));
    file.abandon();
    EXPECT_FALSE(std::filesystem::exists(folder.path / "a"));
  };
  ASSERT_TRUE(run_task(counting.front(), task, watch));
}

}  // namespace
}  // namespace outrider
