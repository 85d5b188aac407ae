#include "kept_runs.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <tuple>

#include "message.hpp"
#include "outrider/io/files.hpp"

namespace outrider::server {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t largest_state_bytes = std::size_t{1} << 20U;
constexpr std::size_t most_found = 1000;
constexpr std::int64_t latest_s = 100'000'000'000;
constexpr double longest_s = 1e9;

/// Returns true for the ids that a server makes: hexadecimal digits and a number.
bool is_id(const std::string& name) {
  const std::size_t dash = name.find('-');
  const auto only = [](std::string_view text, const char* digits) {
    return !text.empty() && text.find_first_not_of(digits) == std::string_view::npos;
  };
  const std::string_view all = name;
  return name.size() <= 40 && dash != std::string::npos && only(all.substr(0, dash), "0123456789abcdef") &&
         only(all.substr(dash + 1), "0123456789");
}

/// Returns true for a folder that is no link.
bool is_folder(const fs::path& path) {
  std::error_code error;
  return fs::symlink_status(path, error).type() == fs::file_type::directory;
}

/// Makes a folder, unless it is there. Returns why there is none; empty if there is.
std::string made(const fs::path& path) {
  std::error_code error;
  fs::create_directory(path, error);
  if (is_folder(path)) return {};
  return error ? error.message() : "it is no folder, or a link to one";
}

std::string why_not_kept(const fs::path& served) {
  for (const fs::path& path : {served / ".outrider", served / ".outrider/runs"}) {
    const std::string why = made(path);
    if (!why.empty()) {
      return fmt::format("runs are kept only until the server ends, since {} cannot be written ({})",
                         path.lexically_relative(served).string(), why);
    }
  }
  const fs::path trial = served / ".outrider/runs/.trial";
  if (const auto ok = write_file(trial.string(), ""); !ok) {
    return fmt::format(
        "runs are kept only until the server ends, since .outrider/runs cannot be written ({})",
        ok.error().sentence);
  }
  std::error_code ignored;
  fs::remove(trial, ignored);
  return {};
}

std::optional<KeptRun> read_state(const fs::path& folder) {
  const fs::path file = folder / "state.json";
  std::error_code error;
  if (fs::symlink_status(file, error).type() != fs::file_type::regular) return std::nullopt;
  const auto text = read_file(file.string(), largest_state_bytes);
  if (!text) return std::nullopt;
  const auto state = parse_json(*text, "state.json");
  if (!state) return std::nullopt;
  auto run = kept_run_from_json(*state);
  if (!run || run->id != folder.filename()) return std::nullopt;
  return std::move(*run);
}

/// The server died: what came of the log until then is the log.
void cut_short(const fs::path& folder, KeptRun& run) {
  run.state = "cut_short";
  run.error = "the server ended before the mission did; it is shown as far as it came";
  std::error_code ignored;
  if (!fs::exists(folder / "run.mcap", ignored))
    fs::rename(folder / "live.mcap", folder / "run.mcap", ignored);
  (void)write_state(folder, run);  // else the next server does it
}

}  // namespace

Json state_json(const KeptRun& run) {
  return {{"id", run.id},
          {"scenario", run.scenario},
          {"job", run.job},
          {"seed", run.seed ? Json(*run.seed) : Json()},
          {"state", run.state},
          {"error", run.error},
          {"where", run.where},
          {"began_s", run.began_s},
          {"took_s", run.took_s ? Json(*run.took_s) : Json()},
          {"summary", run.summary}};
}

Outcome<KeptRun> kept_run_from_json(const Json& state) {
  static const std::string_view states[] = {"queued",  "running",   "done",   "not_done",
                                            "refused", "cancelled", "failed", "cut_short"};
  Fields fields(state, "");
  KeptRun run;
  run.id = fields.text("id");
  run.scenario = fields.text("scenario");
  run.job = fields.text("job");
  run.state = fields.text("state");
  run.error = fields.text("error");
  run.where = fields.text("where");
  run.began_s = fields.integer("began_s", 0, latest_s);
  const auto present = [&](const char* name) { return fields.has(name) && !state[name].is_null(); };
  if (present("seed")) run.seed = fields.integer("seed", 0, 1'000'000'000'000'000);
  if (present("took_s")) run.took_s = fields.number("took_s", 0.0, longest_s);
  if (present("summary")) {
    const Json* summary = fields.object("summary");
    if (summary != nullptr) run.summary = *summary;
  }
  if (auto ok = fields.end(); !ok) return pass_on(ok);
  if (!is_id(run.id)) return bad_input("it is no id of a run", "id");
  if (std::ranges::count(states, run.state) == 0) return bad_input("it is no state of a run", "state");
  return run;
}

Outcome<RunsFolder> RunsFolder::open(const fs::path& served) {
  RunsFolder folder;
  folder.notice_ = why_not_kept(served);
  folder.path_ = served / ".outrider/runs";
  if (folder.notice_.empty()) return folder;
  auto temporary = TemporaryFolder::make();
  if (!temporary) return pass_on(temporary);
  folder.path_ = temporary->path();
  folder.temporary_ = std::move(*temporary);
  return folder;
}

fs::path RunsFolder::place(const fs::path& served, const std::string& id) {
  return served / ".outrider/runs" / id;
}

Outcome<FileLock> RunsFolder::lock(const fs::path& run) { return FileLock::take((run / ".lock").string()); }

std::vector<KeptRun> RunsFolder::find(const fs::path& served) {
  std::vector<KeptRun> found;
  const fs::path runs = served / ".outrider/runs";
  std::error_code error;
  if (!is_folder(runs.parent_path()) || !is_folder(runs)) return found;
  fs::directory_iterator it(runs, error);
  for (const fs::directory_iterator end; !error && it != end && found.size() < most_found;
       it.increment(error)) {
    const fs::path& folder = it->path();
    if (!is_id(folder.filename().string()) || !is_folder(folder)) continue;
    const auto held = lock(folder);
    if (held && !held->held()) continue;
    auto run = read_state(folder);
    if (!run) continue;
    const bool has_ended = run->state != "queued" && run->state != "running";
    if (!has_ended && !held) continue;  // nothing tells whether another server carries it out
    if (!has_ended) cut_short(folder, *run);
    found.push_back(std::move(*run));
  }
  std::ranges::sort(found, {},
                    [](const KeptRun& run) { return std::tuple(run.began_s, run.id.size(), run.id); });
  return found;
}

Status write_state(const fs::path& folder, const KeptRun& run) {
  Json state = state_json(run);
  std::string text = text_of(state);
  if (text.size() >= largest_state_bytes) {  // run.json has it
    state["summary"] = Json();
    text = text_of(state);
  }
  return write_file((folder / "state.json").string(), text + "\n");
}

}  // namespace outrider::server
