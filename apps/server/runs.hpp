// Missions that the page started: a queue, so many at once, and for each a log of what viewers are told.
//
// A log only grows, and a viewer keeps its place in it as a number. So a mission never waits for anybody; a
// viewer that comes late, comes back or is slow reads on from its place, and of progress and maps that were
// overtaken, which are not kept, it sees the newest only.
//
// The text of a scenario is read once, when its run is asked for, and handed to the mission as it was then:
// what happens to the file afterwards changes nothing. The mission opens other files beneath the folder only
// (child.hpp). Thread rule: any thread may call.
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

#include "child.hpp"
#include "fields.hpp"
#include "folder.hpp"
#include "outrider/job/job.hpp"
#include "temporary_folder.hpp"

namespace outrider::server {

struct RunSettings {
  std::string tool;          ///< the program: `TOOL run SCENARIO --json --out FOLDER --stdin`
  std::size_t at_once = 2;   ///< missions that run at the same time
  std::size_t waiting = 16;  ///< more are refused
  std::size_t kept = 32;     ///< that ended; older ones are forgotten
  std::chrono::seconds limit{1800};
  std::size_t memory_bytes = std::size_t{4} << 30U;  ///< for one mission
};

struct RunRequest {
  std::string scenario;             ///< a path under the folder; empty with `text`
  std::optional<std::string> text;  ///< a scenario as it stands in the page
  std::string folder;               ///< of the paths in `text`, under the folder
  std::optional<std::int64_t> seed;
};

/// From {"scenario"} or {"text", "folder"}, and "seed".
Outcome<RunRequest> run_request(const Json& request);

class Runs {
 public:
  /// `jobs` must outlive it.
  Runs(const Folder& folder, RunSettings settings, const std::vector<Job>& jobs);
  ~Runs();  ///< cancels what is running, and waits for it
  Runs(const Runs&) = delete;
  Runs& operator=(const Runs&) = delete;

  /// Queues a mission: its state with status 202; else 400, 404, or 429 when the queue is full.
  Response start(const RunRequest& request);
  /// The state of one, or all of them, newest first.
  Response state(const std::string& id);
  Json list();
  Response cancel(const std::string& id);
  Response report(const std::string& id);
  void cancel_all();

  struct Message {
    std::uint64_t seq = 0;
    std::shared_ptr<const std::string> text;  ///< null while there is none
  };
  /// The first message after the number `from`; what was overtaken is passed over. Fault: there is
  /// no such run.
  Outcome<Message> next(const std::string& id, std::uint64_t from);

  /// Grows with every change of a state: what list() gives has changed then.
  [[nodiscard]] std::uint64_t state_changes() const { return states_; }
  /// Called, without a lock held, after every change.
  void on_change(std::function<void()> call);

 private:
  struct Run;
  using RunPtr = std::shared_ptr<Run>;

  std::optional<Response> take_scenario(Run& run, const RunRequest& request) const;
  void work(const std::stop_token& stop);
  void carry_out(const RunPtr& run);
  void conclude(const RunPtr& run, const ChildResult& child);
  void give_up(const RunPtr& run, const char* reason) noexcept;
  void receive(const RunPtr& run, std::string_view line);
  void report(const RunPtr& run, Json message);
  void end(const RunPtr& run, const std::string& state, Fault fault);
  RunPtr find(const std::string& id);  // with the lock held
  void forget_old();                   // with the lock held
  void call_on_change();

  const Folder& folder_;
  RunSettings settings_;
  const std::vector<Job>& jobs_;
  std::string prefix_;  // of ids, so that those of an earlier server are not taken for ours
  std::optional<TemporaryFolder> home_;
  std::mutex mutex_;  // guards what follows, and every run
  std::condition_variable_any queued_;
  std::deque<RunPtr> queue_;
  std::vector<RunPtr> runs_;
  std::uint64_t number_ = 0;
  std::atomic<std::uint64_t> states_{0};
  std::function<void()> on_change_;
  std::vector<std::jthread> workers_;
};

}  // namespace outrider::server
