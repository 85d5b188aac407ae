#include "commands/job_command.hpp"

#include <fmt/format.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <map>
#include <memory>
#include <optional>

#include "flags.hpp"
#include "output/live_log.hpp"
#include "output/live_map.hpp"
#include "output/output.hpp"
#include "output/progress.hpp"
#include "output/run_output.hpp"
#include "output/terminal.hpp"
#include "outrider/io/files/confinement.hpp"
#include "outrider/io/scenario/scenario.hpp"
#include "outrider/job/run_job.hpp"
#include "stop_on_signal.hpp"

namespace outrider::cli {
namespace {

/// Holds the arguments that a job command takes besides the options of the job.
struct JobRequest {
  std::string file;  ///< given as a positional argument
  std::string scenario_path;
  bool live = false;
  std::int64_t threads = 0;
  RunOutput output;
};

OptionGroup describe(JobRequest& request) {
  return {
      "",
      "output",
      {{"json", "", 0, 0, "print one JSON object on standard output", &request.output.json},
       {"out", "", 0, 0, "folder for the log, a picture and what else the job makes", &request.output.folder},
       {"html", "", 0, 0, "write a page that plays the run, in the folder", &request.output.html},
       {"live", "", 0, 0, "draw a map that is found on the terminal as it grows", &request.live},
       {"threads", "", 0, 1024, "threads to compute with; 0: all; the answer is the same",
        &request.threads}}};
}

/// Reads the scenario, then the flags, which override it.
Status read_arguments(const Job& job, JobTask& task, JobRequest& request, const Command& words) {
  const bool yaml = request.file.ends_with(".yaml") || request.file.ends_with(".yml");
  if (yaml && request.scenario_path.empty()) {
    const auto named = scenario_job(request.file);
    if (named && *named == job.name) request.scenario_path = std::exchange(request.file, {});
  }
  if (!request.scenario_path.empty()) {
    if (auto ok = read_scenario(task, request.scenario_path); !ok) return ok;
  }
  if (auto ok = apply_flags(words, task.options(), &task.given); !ok) return ok;
  for (const auto& [alias, key] : job.aliases) {
    const std::string flag = "--" + std::string(alias);
    if (!words.given(flag)) continue;
    if (auto ok = change(task, {{std::string(key), words.values(flag).back()}}); !ok) {
      ok.error().where = flag;
      return ok;
    }
  }
  if (request.file.empty()) return {};
  return change(task, {{std::string(job.file_option), request.file}});
}

void add_unwritten(Run& run, const JobRequest& request) {
  if (request.output.folder.empty()) return;
  run.report.warnings.push_back("it was cancelled before it began, so nothing was written to " +
                                request.output.folder);
}

/// Ends the tool without results, for this reason.
void leave(const Job& job, const JobRequest& request, const char* reason) {
  Run run;
  run.report.job = job.name;
  run.report.status = "cancelled";
  run.report.reason = reason;
  if (!request.output.folder.empty())
    run.report.warnings.push_back("nothing was written to " + request.output.folder);
  print_run(job, run, {}, request.output.json);
  std::fflush(stdout);
  std::_Exit(job_not_done);
}

/// Ends the tool at once when it is stopped while a task loads its files: nothing has begun then that is
/// worth keeping, and not all libraries that read files can be interrupted.
class LeavingWhileLoading final : public LogSink {
 public:
  LeavingWhileLoading(const Job& job, const JobRequest& request, const std::stop_token& stop)
      : leave_(std::in_place, stop,
               [&job, &request] { leave(job, request, "it was cancelled while it loaded its files"); }) {}
  /// The task is loaded.
  void stay() { leave_.reset(); }

  void add_channel(const Channel& /*channel*/) override { stay(); }
  void append(std::size_t /*channel*/, std::int64_t /*time_ns*/, std::string_view /*data*/) override {}

 private:
  std::optional<std::stop_callback<std::function<void()>>> leave_;
};

/// Runs the task. The sinks are its log file, a program behind OUTRIDER_LIVE, and a map on the terminal.
Outcome<Run> run_watched(const Job& job, JobTask& task, const JobRequest& request, RunLog& file,
                         const std::stop_token& stop) {
  Progress progress;
  LiveLog live;
  std::optional<LiveMap> map;
  RunWatch watch;
  watch.stop = stop;
  LeavingWhileLoading leaving(job, request, stop);
  const HardStop hard(stop, [&] {
    file.abandon();
    leave(job, request, "it was cancelled in the middle of a computation that cannot be interrupted");
  });
  if (!request.output.folder.empty()) watch.sinks = {&leaving, &file};
  if (live.is_watched()) watch.sinks.push_back(&live);
  if (request.live) watch.sinks.push_back(&map.emplace());
  watch.progress = [&](const RunStep& step) {
    leaving.stay();
    progress.show(step);
  };
  if (request.live) progress.end();
  auto run = run_task(job, task, watch);
  leaving.stay();
  if (!run) return run;
  if (live.is_watched()) live.finish(result_text(*run));
  if (map) map->finish(run->log);
  return run;
}

int execute(const Job& job, JobRequest& request, const Command& words, const std::stop_token& stop) {
  const bool json = words.given("--json");
  if (auto ok = apply_flags(words, {describe(request)}); !ok) return print_fault(ok.error(), json);
  if (auto ok = check(request.output, words.given("--out")); !ok) return print_fault(ok.error(), json);
  const auto task = job.blank();
  if (auto ok = read_arguments(job, *task, request, words); !ok) return print_fault(ok.error(), json);
  std::optional<tbb::global_control> limit;
  if (request.threads > 0) {
    limit.emplace(tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(request.threads));
  }
  RunLog log(request.output.folder, scenario_text(task->options()));
  auto run = run_watched(job, *task, request, log, stop);
  if (!run) return print_fault(run.error(), json);
  const auto files = write_run(job, *run, log, request.output);
  if (!files) return print_fault(files.error(), json);
  if (files->empty()) add_unwritten(*run, request);
  print_run(job, *run, *files, json);
  return run->report.status == "done" ? job_done : job_not_done;
}

/// Adds the aliases of a job; one that stands for several options becomes one flag.
void add_aliases(Command& verb, const std::vector<OptionGroup>& groups, const Job& job) {
  std::map<std::string, std::pair<std::string, bool>> flags;  // by name: help, and whether it takes no value
  for (const auto& [alias, key] : job.aliases) {
    for (const OptionGroup& group : groups) {
      for (const Option& option : group.options) {
        if (key_of(group, option) != key) continue;
        auto& [help, is_switch] = flags["--" + std::string(alias)];
        help += (help.empty() ? "as " : " and ") + flag_of(group.name, option.name);
        is_switch = std::holds_alternative<bool*>(option.value);
      }
    }
  }
  for (const auto& [flag, of] : flags) of.second ? verb.flag(flag, of.first) : verb.option(flag, of.first);
}

/// Makes the text on standard input the content of the file, which need not exist.
Status supply_from_stdin(const std::string& path) {
  constexpr std::size_t most_bytes = std::size_t{1} << 20U;
  std::string text(most_bytes + 1, '\0');
  text.resize(std::fread(text.data(), 1, text.size(), stdin));
  if (text.size() > most_bytes) return bad_input("a scenario has at most 1 MiB", "--stdin");
  supply_file(path, std::move(text));
  return {};
}

}  // namespace

void add_jobs(Command& tool, const std::vector<Job>& jobs, const std::stop_token& stop) {
  for (const Job& job : jobs) {
    std::string sentence(job.sentence.substr(0, job.sentence.find_last_not_of('.') + 1));
    sentence[0] = static_cast<char>(std::tolower(static_cast<unsigned char>(sentence[0])));
    Command& verb = tool.add(std::string(job.name), sentence);
    auto request = std::make_shared<JobRequest>();
    const std::shared_ptr<JobTask> usual = job.blank();
    if (!job.file_option.empty()) {
      verb.positional("file", &request->file, std::string(job.file_sentence)).type("FILE");
    }
    verb.option("--scenario", &request->scenario_path, "scenario file to start from; flags win over it")
        .type("FILE");
    auto groups = usual->options();
    std::erase_if(groups.front().options, [](const Option& option) { return option.name == "job"; });
    groups.insert(groups.begin(), describe(*request));
    add_flags(verb, groups);
    add_aliases(verb, groups, job);
    verb.does(
        [job, request, usual, stop](const Command& words) { return execute(job, *request, words, stop); });
    if (!job.example.empty()) verb.footer(fmt::format("\nExample: outrider {}", job.example));
  }
}

bool runs_job(const std::vector<Job>& jobs, const std::vector<std::string>& words) {
  return !words.empty() && (words[0] == "run" || std::ranges::count(jobs, words[0], &Job::name) > 0);
}

void add_run(Command& tool) {
  Command& run = tool.add("run", "do the job in a scenario file; takes the flags of that job, which win");
  run.positional("scenario", std::monostate(), "scenario file; 'outrider schema --as scenario' prints one")
      .required()
      .type("FILE");
  run.flag("--stdin", "the text of the scenario comes from standard input; paths in it start beside FILE");
  JobRequest request;
  std::int64_t seed = 1;
  auto groups = std::vector<OptionGroup>{describe(request)};
  groups.front().options.push_back({"seed", "", 0, 1e15, "seed of every random number", &seed});
  add_flags(run, groups);
  run.does([](const Command&) { return job_done; });  // expand_run() has replaced `run` already
  run.footer("\nExample: outrider run scenarios/yard/yard.yaml --out out --html");
}

Outcome<std::vector<std::string>> expand_run(const std::vector<Job>& jobs, std::vector<std::string> words) {
  if (words.size() < 2 || words[0] != "run") return words;
  const auto stands_alone = [](const std::string& word) {
    return word == "--json" || word == "--html" || word == "--live" || word == "--stdin";
  };
  const auto is_scenario = [](const std::string& word) {
    return !word.starts_with('-') && (word.ends_with(".yaml") || word.ends_with(".yml"));
  };
  auto file = std::find_if_not(words.begin() + 1, words.end(), stands_alone);
  if (file != words.end() && file->starts_with('-')) file = std::find_if(file, words.end(), is_scenario);
  if (file == words.end()) return words;
  const std::string path = *file;
  words.erase(file);
  if (std::erase(words, "--stdin") > 0) {
    if (auto ok = supply_from_stdin(path); !ok) return pass_on(ok);
  }
  const auto job = job_of_scenario(jobs, path);
  if (!job) return pass_on(job);
  words[0] = job->name;
  words.insert(words.begin() + 1, {"--scenario", path});
  return words;
}

}  // namespace outrider::cli
