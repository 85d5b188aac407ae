// What viewers get of a run: its messages and its live log while it runs, the files that it left afterwards.
#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>

#include <algorithm>

#include "run.hpp"

namespace outrider::server {
namespace {

namespace fs = std::filesystem;

/// Opens a file that a mission left; null if there is none that can be served.
std::shared_ptr<const OpenFile> open_file(const fs::path& file) {
  const int descriptor = ::open(file.c_str(), O_RDONLY | O_NONBLOCK | O_NOFOLLOW | O_CLOEXEC);
  struct stat status{};
  if (descriptor < 0) return nullptr;
  const bool known = ::fstat(descriptor, &status) == 0 && S_ISREG(status.st_mode);
  auto opened =
      std::make_shared<const OpenFile>(descriptor, known ? static_cast<std::uintmax_t>(status.st_size) : 0);
  return known ? opened : nullptr;
}

}  // namespace

/// Returns where a file lies that the mission left; nothing if there is none.
std::optional<fs::path> Runs::file_of(const RunPtr& run, const char* name) const {
  fs::path file = run->out / name;
  return open_file(file) ? std::optional(std::move(file)) : std::nullopt;
}

Response Runs::log(const std::string& id) {
  fs::path file;
  {
    const std::lock_guard lock(mutex_);
    const RunPtr run = find(id);
    if (!run) return no_such_run(id);
    if (!run->ended())
      return not_found("the log can be fetched when the run has ended; until then it is sent live", id);
    file = run->out / "run.mcap";
  }
  auto opened = open_file(file);
  if (!opened) return not_found("this run left no log", id.substr(0, 64));
  return {200, "application/octet-stream", {}, {}, std::move(opened)};
}

Response Runs::result(const std::string& id) {
  fs::path file;
  {
    const std::lock_guard lock(mutex_);
    const RunPtr run = find(id);
    if (!run) return no_such_run(id);
    if (!run->ended()) return not_found("the result comes when the run has ended", id);
    file = run->out / "run.json";
  }
  auto opened = open_file(file);
  if (!opened) return not_found("this run left no result", id.substr(0, 64));
  return {200, "application/json", {}, {}, std::move(opened)};
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
