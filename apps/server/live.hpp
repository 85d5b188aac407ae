// The live interface: the messages of one WebSocket. docs/server.md describes them.
//
// Each viewer writes on its own thread, so nothing else waits for it. It holds no queue of run messages, only
// a position in the run's log, and only the newest plan request that waits. So a viewer that reads slowly, or
// not at all, costs its own connection and nothing more.
#pragma once

#include <condition_variable>
#include <cstdint>
#include <deque>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <stop_token>
#include <string>
#include <vector>

#include "byte_budget.hpp"
#include "planning.hpp"
#include "runs.hpp"
#include "workspace_pool.hpp"

namespace outrider::server {

/// Holds what all clients share. Thread rule: any thread may use it.
struct Shared {
  explicit Shared(std::size_t plans_at_once) : workspaces(plans_at_once) {}
  PlanningMemory planning;
  WorkspacePool workspaces;
  ByteBudget values{std::size_t{192} << 20U};   ///< for JSON that is being processed
  ByteBudget answers{std::size_t{128} << 20U};  ///< for answers that clients have not read yet
};

class Viewer {
 public:
  Viewer(Runs& runs, Shared& shared, std::string hello);

  /// Takes a message from the client. Returns false if the connection must end, because the message is not a
  /// JSON object or unread answers pile up. Never waits.
  bool receive(const std::string& text);
  /// Writes until close() is called or `send` fails. Call it on its own thread.
  void serve(const std::function<bool(const std::string&)>& send);
  void wake();
  void close();

 private:
  using Message = std::shared_ptr<const Json>;
  struct Work {
    std::deque<std::string> replies;
    Message plan;  ///< the newest plan request; null if there is none
    std::string run;
    std::uint64_t from = 0;
    bool list = false;
  };

  Status obey(const Message& message);
  void want_plan(const Message& message);
  Work next_work();
  bool send_run(const Work& work, const std::function<bool(const std::string&)>& send);
  std::string answer(const Json& message);
  bool send_plan(const Json& message, const std::function<bool(const std::string&)>& send);

  Runs& runs_;
  Shared& shared_;
  std::mutex mutex_;  // guards the members below
  std::condition_variable changed_;
  bool awake_ = true;
  bool closed_ = false;
  std::deque<std::string> replies_;
  Message plan_;
  std::stop_source planning_;
  std::chrono::steady_clock::time_point planning_since_;
  std::string run_;
  std::uint64_t from_ = 0;
  bool wants_list_ = false;
  std::optional<std::uint64_t> list_seen_;
};

/// Manages all viewers. Thread rule: any thread may call.
class Live {
 public:
  Live(Runs& runs, Shared& shared, std::string version);
  ~Live();
  Live(const Live&) = delete;
  Live& operator=(const Live&) = delete;

  std::shared_ptr<Viewer> open();
  /// Closes every viewer, and those that open later.
  void close();

 private:
  struct Register {
    std::mutex mutex;
    std::vector<std::weak_ptr<Viewer>> viewers;
    bool closed = false;
  };
  Runs& runs_;
  Shared& shared_;
  std::string hello_;
  std::shared_ptr<Register> register_;
};

}  // namespace outrider::server
