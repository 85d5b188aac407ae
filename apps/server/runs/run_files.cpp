// The parts of a run that viewers get: its messages and its live log while it runs, its files afterwards.
#include <fmt/format.h>

#include <algorithm>

#include "runs/run.hpp"

namespace outrider::server {
/// Opens a file that the mission left; null if there is none that can be served.
std::shared_ptr<const OpenFile> Runs::file_of(const RunPtr& run, const char* name) {
  return run->out ? OpenFile::in(*run->out, name) : nullptr;
}

Response Runs::log(const std::string& id) {
  return left(id, "run.mcap", "application/octet-stream",
              "the log can be fetched when the run has ended; until then it is sent live",
              "this run left no log");
}

Response Runs::result(const std::string& id) {
  return left(id, "run.json", "application/json", "the result comes when the run has ended",
              "this run left no result");
}

/// Responds with a file that a run left.
Response Runs::left(const std::string& id, const char* name, const char* type, const char* too_early,
                    const char* none) {
  RunPtr run;
  {
    const std::lock_guard lock(mutex_);
    run = find(id);
    if (!run) return no_such_run(id);
    if (!run->ended()) return not_found(too_early, id);
  }
  auto opened = file_of(run, name);
  if (!opened) return not_found(none, id.substr(0, 64));
  return {200, type, {}, {}, std::move(opened)};
}

Outcome<Runs::Message> Runs::next(const std::string& id, std::uint64_t from) {
  const std::lock_guard lock(mutex_);
  const RunPtr run = find(id);
  if (!run) return bad_input("there is no such run; the server keeps the newest 32", "run");
  Message message{from, nullptr, false, run->live_log, run->live_log_gone};
  for (std::uint64_t i = from; i < run->messages.size() && !message.text; ++i) {
    message.text = run->messages[i];
    if (message.text) message.seq = i + 1;
    message.last = message.text && run->ended() && i + 1 == run->messages.size();
  }
  return message;
}

std::string Runs::newest_begun() {
  const std::lock_guard lock(mutex_);
  const auto begun = [](const RunPtr& run) { return run->live_log != nullptr; };
  const auto newest = std::find_if(runs_.rbegin(), runs_.rend(), begun);
  return newest == runs_.rend() ? std::string() : (*newest)->id;
}

/// Handles a part of the log of the mission. Only this thread changes the live log of the run while it runs.
void Runs::receive_log(const RunPtr& run, std::string_view bytes) {
  bool kept = run->live_log->append(bytes);
  while (!kept && forget_oldest_live_log()) kept = run->live_log->append(bytes);
  if (!kept) {
    run->live_log->stop(
        fmt::format("the live log ends here, because the missions that run have the {} MiB that the server "
                    "keeps of all logs; the "
                    "mission goes on, and its log can be fetched when it has ended",
                    settings_.live_logs_bytes >> 20U));
  }
  call_on_change();
}

/// Lets go the live log of the run that ended first of those that have one. Returns false if there is none.
bool Runs::forget_oldest_live_log() {
  std::shared_ptr<GrowingLog> forgotten;  // its file is removed without the lock
  const std::lock_guard lock(mutex_);
  const auto oldest = std::find_if(runs_.begin(), runs_.end(),
                                   [](const RunPtr& run) { return run->ended() && run->live_log; });
  if (oldest == runs_.end()) return false;
  forgotten = std::exchange((*oldest)->live_log, nullptr);
  (*oldest)->live_log_gone = true;
  return true;
}

}  // namespace outrider::server
