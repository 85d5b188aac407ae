// Missions that the page started. They wait in a queue, a limited number runs at once, and each has messages
// about its state, and a log, for viewers.
//
// Both only grow, and a viewer keeps its position in each as a number. So a mission never waits for a viewer.
// A viewer that comes late, reconnects or is slow continues from its position. Of the progress messages only
// the newest is kept. The live logs of old runs make room for those of new ones.
//
// Each run has a folder (kept_runs.hpp), so those of earlier servers are there again.
//
// The text of a scenario is read once, when its run is requested, and passed to the mission; later changes to
// the file have no effect. The mission opens other files beneath the folder only (child.hpp). Thread rule:
// any thread may call.
#pragma once

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <deque>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <stop_token>
#include <string>
#include <thread>
#include <vector>

#include "fields.hpp"
#include "files/folder.hpp"
#include "files/reading.hpp"
#include "runs/child.hpp"
#include "runs/growing_log.hpp"

namespace outrider::server {

struct KeptRun;
class RunsFolder;

struct RunSettings {
  std::string tool;                  ///< the program: `TOOL run SCENARIO --json --out FOLDER --stdin`
  std::size_t at_once = 2;           ///< missions that run at once
  std::size_t waiting = 16;          ///< missions in the queue; more are refused
  std::size_t kept = 32;             ///< ended missions; older ones are removed
  std::chrono::seconds limit{1800};  ///< processor time of a mission, for each processor
  std::size_t memory_bytes = std::size_t{4} << 30U;        ///< for one mission
  std::uint64_t live_log_bytes = std::uint64_t{1} << 30U;  ///< that are kept of the live log of a run
  std::size_t live_logs_bytes = std::size_t{2} << 30U;     ///< that are kept of all live logs together
};

struct RunRequest {
  std::string scenario;             ///< path under the folder; empty with `text`
  std::optional<std::string> text;  ///< unsaved scenario from the page
  std::string folder;               ///< base of the paths in `text`, under the folder
  std::optional<std::int64_t> seed;
};

/// Reads a request from {"scenario"} or {"text", "folder"}, and "seed".
Outcome<RunRequest> run_request(const Json& request);

class Runs {
 public:
  /// Finds the runs that earlier servers left; `read` reads their states, and the scenarios to run.
  Runs(const Folder& folder, RunSettings settings, ReadFiles read);
  ~Runs();  ///< cancels all runs, and waits for them
  Runs(const Runs&) = delete;
  Runs& operator=(const Runs&) = delete;

  /// Queues a mission, unless `stop` is raised. Responds with its state and status 202; else 400, 404, or 429
  /// if the queue is full.
  Response start(const RunRequest& request, const std::stop_token& stop);
  /// Responds with the state of one run. list() returns {"runs": all of them, newest first, "notice": why
  /// they are not kept, or empty}.
  Response state(const std::string& id);
  Json list();
  Response cancel(const std::string& id);
  /// Responds with the log that a run left: run.mcap, or what came of it until the mission was killed.
  Response log(const std::string& id);
  /// Responds with run.json of a run.
  Response result(const std::string& id);
  void cancel_all();

  struct Message {
    std::uint64_t seq = 0;
    std::shared_ptr<const std::string> text;  ///< null if there is none yet
    bool last = false;                        ///< the message `end`: the log has all of its bytes
    std::shared_ptr<const GrowingLog> log;    ///< null if the run has not begun, or its live log is gone
    bool log_gone = false;                    ///< the live log made room for others
  };
  /// Returns the first kept message after number `from`, and the live log. Fault: there is no such run.
  Outcome<Message> next(const std::string& id, std::uint64_t from);
  /// Returns the id of the newest run that has begun and whose live log is kept; empty if there is none.
  std::string newest_begun();

  /// Returns a counter that grows with every change of a state, which changes list().
  [[nodiscard]] std::uint64_t state_changes() const { return states_; }
  /// Sets a function to call after every change; no lock is held then.
  void on_change(std::function<void()> call);

 private:
  struct Run;
  using RunPtr = std::shared_ptr<Run>;

  std::optional<Response> take_scenario(Run& run, const RunRequest& request,
                                        const std::stop_token& stop) const;
  RunPtr restored(KeptRun kept) const;
  void keep(const RunPtr& run, const std::string& state);
  void work(const std::stop_token& stop);
  void carry_out(const RunPtr& run);
  void conclude(const RunPtr& run, const ChildResult& child);
  void give_up(const RunPtr& run, const char* reason) noexcept;
  void receive(const RunPtr& run, std::string_view line);
  void receive_log(const RunPtr& run, std::string_view bytes);
  bool forget_oldest_live_log();
  static std::shared_ptr<const OpenFile> file_of(const RunPtr& run, const char* name);
  Response left(const std::string& id, const char* name, const char* type, const char* too_early,
                const char* none);
  void report(const RunPtr& run, Json message);
  void end(const RunPtr& run, const std::string& state, Fault fault);
  RunPtr find(const std::string& id);  // call with the lock held
  void forget_old();                   // call with the lock held
  void call_on_change();

  const Folder& folder_;
  RunSettings settings_;
  ReadFiles read_;
  ByteBudget live_logs_;
  std::string prefix_;  // makes ids differ from those of earlier servers
  std::unique_ptr<RunsFolder> home_;
  std::mutex mutex_;  // guards the members below, and every run
  std::condition_variable_any queued_;
  std::deque<RunPtr> queue_;
  std::vector<RunPtr> runs_;
  std::uint64_t number_ = 0;
  std::string notice_;  // why runs are not kept; empty if they are
  std::atomic<std::uint64_t> states_{0};
  std::function<void()> on_change_;
  std::vector<std::jthread> workers_;
};

}  // namespace outrider::server
