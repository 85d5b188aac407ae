// The laws that every job keeps, of a catalogue or of a stranger's own:
//
//   job_contract(patrol_job(), "patrol.yaml");
//
// The scenario is a small one, over in some tenths of a second.
#pragma once

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <filesystem>
#include <set>
#include <string>
#include <vector>

#include "outrider/io/scenario/scenario.hpp"
#include "outrider/job/run_job.hpp"
#include "outrider/log/messages/scene_messages.hpp"
#include "outrider/log/topics.hpp"
#include "support/data.hpp"
#include "support/run_bytes.hpp"

namespace outrider::test {

/// The option that a check is at, by its key.
struct KeyedOption {
  std::string key;
  Option option;
};

inline std::vector<KeyedOption> keyed_options(JobTask& task) {
  std::vector<KeyedOption> all;
  for (const OptionGroup& group : task.options()) {
    for (const Option& option : group.options) all.push_back({key_of(group, option), option});
  }
  return all;
}

/// All of a run that must repeat, or why there is none.
inline std::string bytes_of_run(Outcome<Run> run) {
  return run ? bytes_of_run(*run) : to_string(run.error());
}

inline Outcome<Run> run_scenario(const Job& job, const std::string& scenario, const RunWatch& watch = {}) {
  return run_job({job}, scenario, {}, watch);
}

/// Counts the messages of a run, and may raise the token at one of them.
struct StoppingSink final : LogSink {
  std::stop_source stop;
  int at = 0;  ///< raised at the at-th message; 0: never
  int messages = 0;
  void add_channel(const Channel&) override {}
  void append(std::size_t, std::int64_t, std::string_view) override {
    if (++messages == at) stop.request_stop();
  }
};

/// A token that is raised before the run ends it before anything is done.
inline void stops_at_once(const Job& job, const std::string& scenario) {
  std::stop_source stop;
  stop.request_stop();
  RunWatch watch;
  watch.stop = stop.get_token();
  const auto task = job.blank();
  ASSERT_TRUE(read_scenario(*task, scenario));
  ASSERT_TRUE(task->load());
  Run run;
  const auto done = task->run(run, watch);
  if (done) {
    EXPECT_EQ(run.report.status, "cancelled");
  } else {
    EXPECT_EQ(done.error().code, FaultCode::cancelled) << to_string(done.error());
  }
  const auto told = run_scenario(job, scenario, watch);
  ASSERT_TRUE(told) << to_string(told.error());
  EXPECT_EQ(told->report.status, "cancelled");
  EXPECT_FALSE(told->report.reason.empty());
  EXPECT_EQ(told->report.job, job.name);
}

/// A run whose token was raised under way is cancelled, or was over: then it is the run that nobody stopped.
inline void expect_cancelled_or_done(Outcome<Run> run, const std::string& undisturbed) {
  ASSERT_TRUE(run) << to_string(run.error());
  if (run->report.status != "cancelled") {
    EXPECT_EQ(bytes_of_run(std::move(run)), undisturbed);
    return;
  }
  EXPECT_FALSE(run->report.reason.empty());
}

inline void stops_midway(const Job& job, const std::string& scenario) {
  int steps = 0;
  RunWatch watch;
  StoppingSink counter;
  watch.sinks = {&counter};
  watch.progress = [&](const RunStep&) { ++steps; };
  const std::string undisturbed = bytes_of_run(run_scenario(job, scenario, watch));
  const int messages = counter.messages;
  EXPECT_GT(steps, 0) << "it tells nothing of its progress";
  for (const int at : std::set{1, (steps + 1) / 2, steps}) {
    SCOPED_TRACE(fmt::format("stopped at progress {} of {}", at, steps));
    std::stop_source stop;
    int told = 0;
    RunWatch stopping;
    stopping.stop = stop.get_token();
    stopping.progress = [&](const RunStep&) {
      if (++told == at) stop.request_stop();
    };
    auto run = run_scenario(job, scenario, stopping);
    if (at == 1 && run) {
      EXPECT_EQ(run->report.status, "cancelled");
    }
    expect_cancelled_or_done(std::move(run), undisturbed);
  }
  for (const int at : std::set{1, (messages + 1) / 2}) {
    if (at > messages || at == 0) continue;
    SCOPED_TRACE(fmt::format("stopped at message {} of {}", at, messages));
    StoppingSink sink;
    sink.at = at;
    RunWatch stopping;
    stopping.stop = sink.stop.get_token();
    stopping.sinks = {&sink};
    expect_cancelled_or_done(run_scenario(job, scenario, stopping), undisturbed);
  }
}

/// The same bytes each time, on one thread and on two, and whoever looks on.
inline void repeats(const Job& job, const std::string& scenario) {
  auto first = run_scenario(job, scenario);
  ASSERT_TRUE(first) << to_string(first.error());
  const std::string& status = first->report.status;
  EXPECT_TRUE(status == "done" || status == "not_done" || status == "doubtful" || status == "unconfirmed")
      << status;
  const std::string bytes = bytes_of_run(std::move(first));
  EXPECT_EQ(bytes_of_run(run_scenario(job, scenario)), bytes);
  for (const std::size_t threads : {1U, 2U}) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    EXPECT_EQ(bytes_of_run(run_scenario(job, scenario)), bytes) << threads << " threads";
  }
}

/// A run tells the truth about its seed: it names the seed that was chosen, or nothing depends on it.
inline void tells_whether_it_is_seeded(const Job& job, const std::string& scenario) {
  const auto info_of = [](const Run& run) {
    const auto* info = run.log.latest<outrider_msgs::RunInfo>(topic::run);
    return info == nullptr ? outrider_msgs::RunInfo{} : *info;
  };
  auto first = run_scenario(job, scenario);
  ASSERT_TRUE(first) << to_string(first.error());
  const auto task = job.blank();
  const bool has_seed =
      std::ranges::any_of(keyed_options(*task), [](const KeyedOption& one) { return one.key == "seed"; });
  if (!has_seed) {
    EXPECT_FALSE(info_of(*first).seeded);
    return;
  }
  for (const std::string seed : {"0", "7"}) {
    auto other = run_job({job}, scenario, {{"seed", seed}});
    ASSERT_TRUE(other) << to_string(other.error());
    EXPECT_EQ(info_of(*other).seeded, info_of(*first).seeded);
    if (info_of(*other).seeded) {
      EXPECT_EQ(std::to_string(info_of(*other).seed), seed);
    } else {
      EXPECT_EQ(bytes_of_log(other->log), bytes_of_log(first->log)) << "seed " << seed;
    }
  }
}

/// Texts that an option must refuse.
inline std::vector<std::string> bad_values(const Option& option) {
  const auto below = [](double low) { return low - std::max(1.0, 0.5 * std::abs(low)); };
  const auto above = [](double high) { return high + std::max(1.0, 0.5 * std::abs(high)); };
  if (std::holds_alternative<bool*>(option.value)) return {"perhaps"};
  if (std::holds_alternative<double*>(option.value)) {
    return {"many", "nan", "inf", fmt::format("{:.17g}", below(option.low)),
            fmt::format("{:.17g}", above(option.high))};
  }
  if (std::holds_alternative<std::int64_t*>(option.value)) {
    return {"many", "1.5", fmt::format("{:.0f}", below(option.low)),
            fmt::format("{:.0f}", above(option.high))};
  }
  return {};  // what a text may be the job alone knows
}

/// Each option refuses what it cannot be with a sentence that names it, and stays as it was.
inline void refuses_bad_values(const Job& job) {
  const Folder folder;
  const auto task = job.blank();
  std::set<std::string> keys;
  for (const auto& [key, option] : keyed_options(*task)) {
    EXPECT_TRUE(keys.insert(key).second) << key << " stands there twice";
    EXPECT_FALSE(option.sentence.empty()) << key;
    const std::string before = value_text(option);
    for (const std::string& bad : bad_values(option)) {
      const auto refused = change(*task, {{key, bad}});
      ASSERT_FALSE(refused) << key << ": " << bad;
      EXPECT_EQ(refused.error().code, FaultCode::bad_input) << key << ": " << bad;
      EXPECT_EQ(refused.error().where, key) << bad;
      EXPECT_GT(refused.error().sentence.size(), 10U) << key << ": " << bad;
      EXPECT_EQ(value_text(option), before) << key << ": " << bad;
      const std::size_t dot = key.find('.');
      const std::string text = dot == std::string::npos ? fmt::format("{}: {}\n", key, bad)
                                                        : fmt::format("{}:\n  {}: {}\n", key.substr(0, dot),
                                                                      key.substr(dot + 1), bad);
      const auto scenario = folder.write("bad.yaml", fmt::format("job: {}\n{}", job.name, text));
      const auto unread = read_scenario(*task, scenario);
      ASSERT_FALSE(unread) << text;
      EXPECT_EQ(unread.error().code, FaultCode::bad_input) << text;
      EXPECT_NE(to_string(unread.error()).find("bad.yaml"), std::string::npos) << to_string(unread.error());
      EXPECT_NE(to_string(unread.error()).find(option.name), std::string::npos) << to_string(unread.error());
    }
  }
}

/// A key that it does not have is named, in a scenario with the line.
inline void refuses_unknown_keys(const Job& job) {
  const Folder folder;
  const auto task = job.blank();
  const auto refused = change(*task, {{"no_such_key", "1"}});
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().code, FaultCode::bad_input);
  EXPECT_NE(to_string(refused.error()).find("no_such_key"), std::string::npos);
  for (const char* text : {"no_such_key: 1\n", "no_such_key:\n  inner: 1\n"}) {
    const auto path = folder.write("unknown.yaml", fmt::format("job: {}\n{}", job.name, text));
    const auto unread = read_scenario(*task, path);
    ASSERT_FALSE(unread) << text;
    EXPECT_EQ(unread.error().code, FaultCode::bad_input);
    for (const char* word : {"no_such_key", "unknown.yaml:2"}) {
      EXPECT_NE(to_string(unread.error()).find(word), std::string::npos) << to_string(unread.error());
    }
  }
}

/// A file that an option names and that is not there is named by the refusal. Of `unread` options the
/// scenario makes no use.
inline void refuses_missing_files(const Job& job, const std::string& scenario,
                                  const std::set<std::string>& unread = {}) {
  const auto usual = job.blank();
  for (const auto& [key, option] : keyed_options(*usual)) {
    if (!option.names_file || unread.contains(key)) continue;
    const auto run = run_job({job}, scenario, {{key, "missing/file.dat"}});
    ASSERT_FALSE(run) << key << " is not read";
    EXPECT_EQ(run.error().code, FaultCode::bad_input) << key;
    EXPECT_NE(to_string(run.error()).find("missing/file.dat"), std::string::npos) << to_string(run.error());
  }
}

/// The values of a task, written as a scenario and read again, and each as text, are the same.
inline void options_round_trip(const Job& job, const std::string& scenario) {
  const Folder folder;
  for (const bool read : {false, true}) {
    const auto task = job.blank();
    if (read) {
      ASSERT_TRUE(read_scenario(*task, scenario));
    }
    const auto settings = settings_of(task->options());
    const auto path = folder.write("again.yaml", scenario_text(task->options()));
    const auto again = job.blank();
    const auto ok = read_scenario(*again, path);
    ASSERT_TRUE(ok) << to_string(ok.error());
    EXPECT_EQ(settings_of(again->options()), settings);
    const auto assigned = job.blank();
    for (const auto& [key, option] : keyed_options(*task)) {
      const auto set = change(*assigned, {{key, value_text(option)}});
      EXPECT_TRUE(set) << to_string(set.error());
    }
    EXPECT_EQ(settings_of(assigned->options()), settings);
  }
}

/// All of it.
inline void job_contract(const Job& job, const std::string& scenario,
                         const std::set<std::string>& unread_files = {}) {
  SCOPED_TRACE(std::string(job.name));
  EXPECT_FALSE(job.sentence.empty());
  stops_at_once(job, scenario);
  stops_midway(job, scenario);
  repeats(job, scenario);
  refuses_bad_values(job);
  refuses_unknown_keys(job);
  refuses_missing_files(job, scenario, unread_files);
  options_round_trip(job, scenario);
}

}  // namespace outrider::test
