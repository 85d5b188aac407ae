// All viewers: whoever opened a WebSocket, and what they share.
#pragma once

#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "byte_budget.hpp"
#include "live/viewer.hpp"
#include "planning/planning.hpp"
#include "planning/workspace_pool.hpp"
#include "runs/runs.hpp"

namespace outrider::server {

/// Holds what all clients share. Thread rule: any thread may use it.
struct Shared {
  explicit Shared(std::size_t plans_at_once) : workspaces(plans_at_once) {}
  PlanningMemory planning;
  WorkspacePool workspaces;
  ByteBudget values{std::size_t{192} << 20U};   ///< for JSON that is being processed
  ByteBudget answers{std::size_t{128} << 20U};  ///< for answers that clients have not read yet
  ByteBudget messages{std::size_t{64} << 20U};  ///< for messages of logs that clients have not read yet
};

/// Manages all viewers. Thread rule: any thread may call.
class Live {
 public:
  Live(Runs& runs, Shared& shared, std::string version);
  ~Live();
  Live(const Live&) = delete;
  Live& operator=(const Live&) = delete;

  /// Opens a viewer of the page.
  std::shared_ptr<Viewer> open();
  /// Opens a viewer that speaks the Foxglove protocol. It follows a run, or the newest one if `run` is empty.
  std::shared_ptr<Viewer> open_foxglove(const std::string& run);
  /// Closes every viewer, and those that open later.
  void close();

 private:
  struct Register {
    std::mutex mutex;
    std::vector<std::weak_ptr<Viewer>> viewers;
    bool closed = false;
  };
  std::shared_ptr<Viewer> enter(std::shared_ptr<Viewer> viewer);

  Runs& runs_;
  Shared& shared_;
  std::string version_;
  std::shared_ptr<Register> register_;
};

}  // namespace outrider::server
