#include "runs/runs.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "runs/run.hpp"
#include "runs/run_messages.hpp"

namespace outrider::server {
namespace {

constexpr std::size_t most_messages = 50'000;
constexpr std::size_t longest_scenario = std::size_t{1} << 20U;

/// Returns the start time of the server, which becomes part of its run ids.
std::string moment() {
  const auto since = std::chrono::system_clock::now().time_since_epoch();
  return fmt::format("{:x}", std::chrono::duration_cast<std::chrono::milliseconds>(since).count());
}

std::int64_t unix_time_s() {
  const auto since = std::chrono::system_clock::now().time_since_epoch();
  return std::chrono::duration_cast<std::chrono::seconds>(since).count();
}

}  // namespace

Outcome<RunRequest> run_request(const Json& request) {
  Fields fields(request, "");
  RunRequest run;
  const bool text = fields.has("text");
  if (text == fields.has("scenario")) return bad_input("give one of scenario and text", "scenario");
  if (text) run.text = fields.text("text");
  if (text) run.folder = fields.text("folder", "");
  if (!text) run.scenario = fields.text("scenario");
  if (fields.has("seed")) run.seed = fields.integer("seed", 0, 1'000'000'000'000'000);
  if (auto ok = fields.end(); !ok) return pass_on(ok);
  if (text && run.text->size() > longest_scenario) return bad_input("a scenario has at most 1 MiB", "text");
  return run;
}

Runs::Runs(const Folder& folder, RunSettings settings, ReadFiles read)
    : folder_(folder),
      settings_(std::move(settings)),
      read_(std::move(read)),
      live_logs_(settings_.live_logs_bytes),
      prefix_(moment()) {
  for (KeptRun& kept : RunsFolder::find(folder_, read_)) {
    runs_.push_back(restored(std::move(kept)));
    forget_old();
  }
  for (std::size_t i = 0; i < settings_.at_once; ++i) {
    workers_.emplace_back([this](const std::stop_token& stop) { work(stop); });
  }
}

Runs::~Runs() {
  cancel_all();
  for (std::jthread& worker : workers_) worker.request_stop();
  workers_.clear();
}

void Runs::on_change(std::function<void()> call) {
  const std::lock_guard lock(mutex_);
  on_change_ = std::move(call);
}

void Runs::call_on_change() {
  std::function<void()> call;
  {
    const std::lock_guard lock(mutex_);
    call = on_change_;
  }
  if (call) call();
}

Runs::RunPtr Runs::find(const std::string& id) {
  const auto found =
      std::find_if(runs_.begin(), runs_.end(), [&](const RunPtr& run) { return run->id == id; });
  return found == runs_.end() ? nullptr : *found;
}

void Runs::forget_old() {
  const auto ended = [](const RunPtr& run) { return run->ended(); };
  for (auto kept = std::count_if(runs_.begin(), runs_.end(), ended);
       kept > static_cast<std::ptrdiff_t>(settings_.kept); --kept) {
    const auto oldest = std::find_if(runs_.begin(), runs_.end(), ended);
    if ((*oldest)->home) (*oldest)->home->remove((*oldest)->id);
    runs_.erase(oldest);
  }
}

/// Sets the text of the scenario, its name, and its job; returns the refusal if there is one.
std::optional<Response> Runs::take_scenario(Run& run, const RunRequest& request,
                                            const std::stop_token& stop) const {
  if (request.text) {
    const bool good = request.folder.empty() || checked_path(request.folder);
    if (!good || !folder_.gate().folder(request.folder))
      return not_found("there is no such folder", "folder");
    run.scenario = request.folder.empty() ? "unsaved" : request.folder + "/unsaved";
    run.text = *request.text;
    run.unsaved = true;
  } else {
    auto text = folder_.text(request.scenario, longest_scenario);
    if (!text) return not_found("there is no such scenario", "scenario");
    run.scenario = request.scenario;
    run.text = std::move(*text);
  }
  const auto head = read_(folder_, {{"head", run.text}, {"name", run.scenario}}, stop);
  if (!head) return error_response(plain_fault(head.error(), run.unsaved ? run.scenario : ""));
  run.job = head->at("job").get<std::string>();
  if (!run.seed && !head->at("seed").is_null()) run.seed = head->at("seed").get<std::int64_t>();
  return std::nullopt;
}

Response Runs::start(const RunRequest& request, const std::stop_token& stop) {
  auto run = std::make_shared<Run>();
  run->seed = request.seed;
  {
    const std::lock_guard lock(mutex_);
    if (queue_.size() >= settings_.waiting) {
      return error_response(429, "too_many",
                            fmt::format("{} missions wait already; cancel one, or wait", queue_.size()));
    }
    if (!home_) {
      auto home = RunsFolder::open(folder_.gate());
      if (!home) return error_response(500, "internal", home.error().sentence);
      home_ = std::make_unique<RunsFolder>(std::move(*home));
      notice_ = home_->notice();
    }
    run->id = fmt::format("{}-{}", prefix_, ++number_);
    run->home = home_->gate();
  }
  if (auto refused = take_scenario(*run, request, stop)) return *refused;
  run->began_s = unix_time_s();
  run->asked = std::chrono::steady_clock::now();
  auto out = run->home->make_folder(run->id);
  if (!out) return error_response(out.error());
  run->out = std::move(*out);
  if (auto lock = RunsFolder::lock(*run->out)) run->lock = std::move(*lock);
  keep(run, run->state);
  {
    const std::lock_guard lock(mutex_);
    runs_.push_back(run);
    forget_old();
  }
  report(run, {{"type", "state"}, {"state", "queued"}});
  const std::lock_guard lock(mutex_);
  queue_.push_back(run);  // comes last, or "running" could precede "queued"
  queued_.notify_one();
  return json_response(run->json(), 202);
}

/// Returns a run of an earlier server. Clients that watch it are told how it ended.
Runs::RunPtr Runs::restored(KeptRun kept) const {
  auto run = std::make_shared<Run>();
  run->id = std::move(kept.id);
  run->scenario = std::move(kept.scenario);
  run->job = std::move(kept.job);
  run->seed = kept.seed;
  run->state = std::move(kept.state);
  run->fault = {FaultCode::bad_input, std::move(kept.error), std::move(kept.where)};
  run->began_s = kept.began_s;
  run->took_s = kept.took_s;
  run->summary = std::move(kept.summary);
  const auto home = RunsFolder::below(folder_.gate());
  const auto out = home ? home->folder(run->id) : home;
  if (home) run->home = *home;
  if (out) run->out = *out;
  run->has_log = run->live_log_gone = file_of(run, "run.mcap") != nullptr;
  run->has_result = file_of(run, "run.json") != nullptr;
  Json message = {{"seq", 1}, {"type", "end"}, {"run", run->id}};
  message.update(run->json());
  message["seq"] = 1;
  run->messages.push_back(std::make_shared<const std::string>(text_of(message)));
  return run;
}

/// Writes what is known of a run to its folder. If that fails, the list of runs says so.
void Runs::keep(const RunPtr& run, const std::string& state) {
  KeptRun kept;
  {
    const std::lock_guard lock(mutex_);
    kept = run->kept(state);
  }
  const Status written = write_state(*run->out, kept);
  if (written) return;
  const std::lock_guard lock(mutex_);
  if (notice_.empty()) {
    notice_ = fmt::format("run {} cannot be kept ({})", run->id, written.error().sentence);
  }
}

Response Runs::state(const std::string& id) {
  const std::lock_guard lock(mutex_);
  const RunPtr run = find(id);
  return run ? json_response(run->json()) : no_such_run(id);
}

Json Runs::list() {
  const std::lock_guard lock(mutex_);
  Json list = Json::array();
  for (auto run = runs_.rbegin(); run != runs_.rend(); ++run) list.push_back((*run)->json());
  return {{"runs", std::move(list)}, {"notice", notice_}};
}

Response Runs::cancel(const std::string& id) {
  RunPtr run;
  bool waited = false;
  {
    const std::lock_guard lock(mutex_);
    run = find(id);
    if (!run) return no_such_run(id);
    run->stop.request_stop();
    waited = std::erase(queue_, run) > 0;
  }
  if (waited) end(run, "cancelled", {FaultCode::cancelled, "the mission was cancelled before it began", {}});
  return state(id);
}

void Runs::cancel_all() {
  std::vector<std::string> ids;
  {
    const std::lock_guard lock(mutex_);
    for (const RunPtr& run : runs_) ids.push_back(run->id);
  }
  for (const std::string& id : ids) (void)cancel(id);
}

void Runs::report(const RunPtr& run, Json message) {
  const std::string type = message["type"];
  message["run"] = run->id;
  const std::string body = text_of(message);  // {"type":...
  {
    const std::lock_guard lock(mutex_);
    const bool last = type == "end";
    if (type == "state") run->state = message["state"].get<std::string>();
    if (type == "state" || last) ++states_;
    if (run->messages.size() >= most_messages && !last) return;
    auto text = std::make_shared<const std::string>(
        fmt::format("{{\"seq\":{},{}", run->messages.size() + 1, std::string_view(body).substr(1)));
    if (type == "progress") {
      if (run->newest_progress) run->messages[*run->newest_progress] = nullptr;
      run->newest_progress = run->messages.size();
    }
    run->messages.push_back(std::move(text));
  }
  call_on_change();
}

void Runs::work(const std::stop_token& stop) {
  for (;;) {
    RunPtr run;
    {
      std::unique_lock lock(mutex_);
      if (!queued_.wait(lock, stop, [this] { return !queue_.empty(); })) return;
      run = queue_.front();
      queue_.pop_front();
    }
    // An exception in one mission must not end the others.
    try {
      carry_out(run);
    } catch (const std::exception& error) {
      give_up(run, error.what());
    } catch (...) {
      give_up(run, "an error without a name");
    }
  }
}

void Runs::carry_out(const RunPtr& run) {
  auto log = std::make_shared<GrowingLog>(*run->out, "live.mcap", settings_.live_log_bytes, live_logs_);
  {
    const std::lock_guard lock(mutex_);
    run->live_log = std::move(log);
  }
  report(run, {{"type", "state"}, {"state", "running"}});
  // The mission works in the folder, so its result equals that of `outrider run` there.
  ChildProgram program{
      .words = {settings_.tool, "run", run->scenario, "--json", "--out", std::string(child_out), "--stdin"},
      .folder = folder_.gate(),
      .input = run->text,
      .limit = settings_.limit * std::max(1U, std::thread::hardware_concurrency()),
      .memory_bytes = settings_.memory_bytes,
      .out = run->out};
  if (run->seed) program.words.insert(program.words.end(), {"--seed", std::to_string(*run->seed)});
  const ChildListener listener = {[&](std::string_view line) { receive(run, line); },
                                  [&](std::string_view bytes) { receive_log(run, bytes); }};
  conclude(run, run_child(program, run->stop.get_token(), listener));
}

/// Handles a line from the mission, which tells its progress.
void Runs::receive(const RunPtr& run, std::string_view line) {
  auto progress = progress_of(Json::parse(line, nullptr, false));
  if (!progress) return;  // the tool writes no such line
  {
    const std::lock_guard lock(mutex_);
    run->progress = *progress;
  }
  progress->emplace("type", "progress");
  report(run, std::move(*progress));
}

void Runs::conclude(const RunPtr& run, const ChildResult& child) {
  Conclusion conclusion = conclusion_of(child);
  conclusion.fault = plain_fault(std::move(conclusion.fault), run->unsaved ? run->scenario : "");
  if (conclusion.summary.contains("files")) conclusion.summary.erase("files");  // paths on the server
  const bool killed = !run->out->status("run.mcap") && run->live_log->bytes() > 0;
  if (killed) (void)run->out->rename("live.mcap", "run.mcap");
  const bool has_log = file_of(run, "run.mcap") != nullptr;
  const bool has_result = file_of(run, "run.json") != nullptr;
  {
    const std::lock_guard lock(mutex_);
    run->summary = std::move(conclusion.summary);
    run->has_log = has_log;
    run->has_result = has_result;
  }
  end(run, conclusion.state, std::move(conclusion.fault));
}

void Runs::give_up(const RunPtr& run, const char* reason) noexcept {
  try {
    end(run, "failed",
        {FaultCode::bad_input, fmt::format("the server lost this mission ({}); start it again", reason), {}});
  } catch (...) {  // no memory even for the message
    const std::lock_guard lock(mutex_);
    run->state = "failed";
    ++states_;
  }
}

void Runs::end(const RunPtr& run, const std::string& state, Fault fault) {
  Json message;
  {
    const std::lock_guard lock(mutex_);
    if (run->live_log) run->live_log->end();
    run->text.clear();
    run->fault = std::move(fault);
    run->took_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - run->asked).count();
  }
  keep(run, state);
  {
    const std::lock_guard lock(mutex_);
    run->state = state;
    run->lock = {};
    message = run->json();
  }
  message.erase("seq");
  message["type"] = "end";
  report(run, std::move(message));
}

}  // namespace outrider::server
