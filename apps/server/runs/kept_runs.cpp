#include "runs/kept_runs.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <span>
#include <tuple>

#include "http/message.hpp"

namespace outrider::server {
namespace {

constexpr std::size_t most_state_bytes = std::size_t{1} << 20U;  // of memory, see memory_of_json()
constexpr std::size_t most_names = 10'000;
constexpr std::size_t most_found = 200;
constexpr std::size_t most_together = 16;  // states of a question
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

/// Opens the folder of runs, and makes it if there is none. Fault: it cannot be written.
Outcome<OpenFolder> writable_folder(const OpenFolder& served) {
  auto above = served.make_folder(".outrider");
  auto runs = above ? above->make_folder("runs") : above;
  const Status trial = runs ? runs->write({{".trial", ""}}) : Status();
  if (runs && trial) {
    runs->remove(".trial");
    return runs;
  }
  return fault(
      FaultCode::cannot_write,
      fmt::format("runs are kept only until the server ends, since {} cannot be written ({})",
                  above ? ".outrider/runs" : ".outrider", (runs ? trial.error() : runs.error()).sentence));
}

/// The server died: what came of the log until then is the log.
void cut_short(const OpenFolder& folder, KeptRun& run) {
  run.state = "cut_short";
  run.error = "the server ended before the mission did; it is shown as far as it came";
  if (!folder.status("run.mcap")) (void)folder.rename("live.mcap", "run.mcap");
  (void)write_state(folder, run);  // else the next server does it
}

/// Appends those of the runs that no server carries out now.
void find_some(std::span<const std::string> ids, const OpenFolder& runs, const Folder& served,
               const ReadFiles& read, std::vector<KeptRun>& found) {
  std::vector<std::pair<OpenFolder, bool>> folders;  // and whether this server has locked it
  std::vector<FileLock> locks;
  Json asked = Json::array();
  for (const std::string& id : ids) {
    const auto folder = runs.folder(id);
    auto lock = folder ? RunsFolder::lock(*folder) : Outcome<FileLock>(FileLock());
    if (lock && !lock->held()) continue;
    folders.emplace_back(*folder, lock.has_value());
    if (lock) locks.push_back(std::move(*lock));
    asked.push_back(id);
  }
  const auto answer = read(served, {{"states", std::move(asked)}}, {});
  for (std::size_t i = 0; answer && i < folders.size(); ++i) {
    auto run = kept_run_from_json(answer->at("states").at(i));
    if (!run) continue;
    const bool has_ended = run->state != "queued" && run->state != "running";
    if (!has_ended && !folders[i].second) continue;  // nothing tells whether another server carries it out
    if (!has_ended) cut_short(folders[i].first, *run);
    found.push_back(std::move(*run));
  }
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

Json kept_state(const std::string& id, const Folder& served) {
  const auto file = OpenFile::in(served.gate(), fmt::format(".outrider/runs/{}/state.json", id));
  if (!file || file->bytes() > most_state_bytes) return {};
  const std::string text = file->part(0, file->bytes());
  if (memory_of_json(text) > most_state_bytes) return {};
  const auto state = parse_json(text, "state.json");
  const auto run = state ? kept_run_from_json(*state) : Outcome<KeptRun>(pass_on(state));
  return run && run->id == id ? *state : Json();
}

Outcome<RunsFolder> RunsFolder::open(const OpenFolder& served) {
  auto kept = writable_folder(served);
  if (kept) return RunsFolder(std::move(*kept), "");
  auto temporary = TemporaryFolder::make();
  if (!temporary) return pass_on(temporary);
  auto gate = OpenFolder::open(temporary->path().string());
  if (!gate) return pass_on(gate);
  RunsFolder folder(std::move(*gate), kept.error().sentence);
  folder.temporary_ = std::move(*temporary);
  return folder;
}

std::vector<KeptRun> RunsFolder::find(const Folder& served, const ReadFiles& read) {
  std::vector<KeptRun> found;
  const auto runs = below(served.gate());
  if (!runs) return found;
  std::vector<std::string> ids = runs->names(most_names);  // an id begins with the time
  std::erase_if(ids, [](const std::string& name) { return !is_id(name); });
  std::span<const std::string> rest = ids;
  rest = rest.last(std::min(most_found, rest.size()));
  for (; !rest.empty(); rest = rest.subspan(std::min(most_together, rest.size()))) {
    find_some(rest.first(std::min(most_together, rest.size())), *runs, served, read, found);
  }
  std::ranges::sort(found, {},
                    [](const KeptRun& run) { return std::tuple(run.began_s, run.id.size(), run.id); });
  return found;
}

Status write_state(const OpenFolder& folder, const KeptRun& run) {
  Json state = state_json(run);
  std::string text = text_of(state);
  if (memory_of_json(text) >= most_state_bytes) {  // run.json has it
    state["summary"] = Json();
    text = text_of(state);
  }
  return folder.write({{"state.json", text + "\n"}});
}

}  // namespace outrider::server
