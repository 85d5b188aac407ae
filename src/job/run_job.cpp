#include "outrider/job/run_job.hpp"

#include <fmt/format.h>

#include <filesystem>

#include "outrider/io/files/files.hpp"
#include "outrider/io/files/text.hpp"
#include "outrider/io/scenario/scenario.hpp"

namespace outrider {
namespace {

/// Makes paths that are relative to the file of a scenario relative to the folder of the process.
void resolve_files(JobTask& task, const std::set<std::string>& keys, const std::string& scenario_path) {
  const auto folder = std::filesystem::path(scenario_path).parent_path();
  for (const OptionGroup& group : task.options()) {
    for (const Option& option : group.options) {
      if (!option.names_file || !keys.contains(key_of(group, option))) continue;
      std::string& path = *std::get<std::string*>(option.value);
      if (!path.empty()) path = (folder / path).lexically_normal().string();
    }
  }
}

}  // namespace

std::vector<OptionGroup> JobTask::options() {
  std::vector<OptionGroup> groups = describe();
  if (groups.empty() || !groups.front().name.empty()) groups.insert(groups.begin(), {"", "the task", {}});
  auto& top = groups.front().options;
  top.insert(top.begin(), {"job", "", 0, 0, "what the robot does; " + job, &job});
  return groups;
}

std::string key_of(const OptionGroup& group, const Option& option) {
  return group.name.empty() ? option.name : group.name + "." + option.name;
}

std::vector<std::pair<std::string, std::string>> settings_of(const std::vector<OptionGroup>& groups) {
  std::vector<std::pair<std::string, std::string>> settings;
  for (const OptionGroup& group : groups) {
    for (const Option& option : group.options) {
      settings.emplace_back(key_of(group, option),
                            value_text(option) + (option.unit.empty() ? "" : " " + option.unit));
    }
  }
  return settings;
}

Outcome<Job> find_job(const std::vector<Job>& jobs, std::string_view name, std::string where) {
  return find_row(jobs, "job", name, std::move(where));
}

Outcome<Job> job_of_scenario(const std::vector<Job>& jobs, const std::string& path) {
  auto text = read_file(path);
  return text ? job_of_scenario_text(jobs, *text, path) : pass_on(text);
}

Outcome<Job> job_of_scenario_text(const std::vector<Job>& jobs, const std::string& text,
                                  const std::string& name) {
  auto job = scenario_job_from_text(text, name);
  if (!job) return pass_on(job);
  if (job->empty()) {
    return bad_input("the key 'job' is missing; give one of 'outrider list', such as job: guard", name);
  }
  return find_job(jobs, *job, name + ": job");
}

Status read_scenario(JobTask& task, const std::string& path, const std::string& as_if) {
  const std::string job = task.job;
  if (auto ok = load_scenario(path, task.options()); !ok) return ok;
  if (task.job != job) {
    return bad_input(fmt::format("'{}' is not a job of this scenario; the job is {}", excerpt(task.job), job),
                     "job");
  }
  const auto keys = scenario_keys(path);
  if (!keys) return pass_on(keys);
  const std::set<std::string> named(keys->begin(), keys->end());
  resolve_files(task, named, as_if.empty() ? path : as_if);
  task.given.insert(named.begin(), named.end());
  return {};
}

Status change(JobTask& task, const Changes& changes) {
  const auto groups = task.options();
  for (const auto& [key, value] : changes) {
    std::vector<std::string> known;
    const Option* found = nullptr;
    for (const OptionGroup& group : groups) {
      for (const Option& option : group.options) {
        known.push_back(key_of(group, option));
        if (known.back() == key) found = &option;
      }
    }
    if (found == nullptr) return no_such_row("option", key, known, excerpt(key));
    if (auto ok = assign(*found, value); !ok) {
      ok.error().where = key;
      return ok;
    }
    task.given.insert(key);
  }
  return {};
}

Outcome<Run> run_task(const Job& job, JobTask& task, const RunWatch& watch) {
  if (task.job != job.name) {
    return bad_input(
        fmt::format("'{}' is not a job of this scenario; the job is {}", excerpt(task.job), job.name), "job");
  }
  Run run;
  run.report.job = job.name;
  for (LogSink* sink : watch.sinks) run.log.add_sink(*sink);
  const auto cancelled = [&](const std::string& sentence) {
    run.report.status = "cancelled";
    run.report.reason = sentence;
    return std::move(run);
  };
  if (watch.stopped()) return cancelled("it was cancelled before it began");
  auto warnings = task.load();
  if (!warnings) return pass_on(warnings);
  const auto done = task.run(run, watch);
  for (LogSink* sink : watch.sinks) run.log.remove_sink(*sink);
  if (!done && done.error().code == FaultCode::cancelled) return cancelled(done.error().sentence);
  if (!done) return pass_on(done);
  Report& report = run.report;
  report.job = job.name;
  report.warnings.insert(report.warnings.begin(), warnings->begin(), warnings->end());
  if (report.settings.empty()) report.settings = settings_of(task.options());
  return run;
}

Outcome<Run> run_job(const std::vector<Job>& jobs, const std::string& scenario_path, const Changes& changes,
                     const RunWatch& watch) {
  const auto job = job_of_scenario(jobs, scenario_path);
  if (!job) return pass_on(job);
  const auto task = job->blank();
  if (auto ok = read_scenario(*task, scenario_path); !ok) return pass_on(ok);
  if (auto ok = change(*task, changes); !ok) return pass_on(ok);
  return run_task(*job, *task, watch);
}

}  // namespace outrider
