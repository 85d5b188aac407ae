// The memory that planners keep between questions, shared by all clients.
//
// The data that a planner builds for a map can be large, so there are only as many workspaces as plans that
// run at once, regardless of the number of viewers. A returning client gets the workspace that it used last,
// if that is free.
#pragma once

#include <chrono>
#include <condition_variable>
#include <mutex>
#include <optional>
#include <stop_token>
#include <utility>
#include <vector>

#include "outrider/search/workspace.hpp"

namespace outrider::server {

/// Lends workspaces. Thread rule: any thread may take one and give it back.
class WorkspacePool {
 public:
  explicit WorkspacePool(std::size_t count) : places_(count) {}

  /// Lends a workspace to one thread; the destructor gives it back.
  class Lease {
   public:
    Lease(Lease&& other) noexcept : pool_(std::exchange(other.pool_, nullptr)), place_(other.place_) {}
    Lease& operator=(Lease&&) = delete;
    ~Lease() {
      if (pool_ != nullptr) pool_->give_back(place_);
    }
    [[nodiscard]] Workspace& workspace() const { return pool_->places_[place_].workspace; }

   private:
    friend class WorkspacePool;
    Lease(WorkspacePool* pool, std::size_t place) : pool_(pool), place_(place) {}
    WorkspacePool* pool_;
    std::size_t place_;
  };

  /// Waits until a workspace is free. Returns nothing if that takes too long, `stop` is raised, or
  /// `most_waiting` others already wait.
  std::optional<Lease> take(const void* user, std::chrono::milliseconds longest_wait,
                            std::size_t most_waiting, const std::stop_token& stop);

 private:
  struct Place {
    Workspace workspace;
    const void* user = nullptr;  ///< last user; compared, never dereferenced
    std::size_t last_use = 0;
    bool taken = false;
  };
  Place* free_place(const void* user);  // call with the lock held
  void give_back(std::size_t place);

  std::mutex mutex_;
  std::condition_variable_any given_back_;
  std::vector<Place> places_;
  std::size_t waiting_ = 0;
  std::size_t uses_ = 0;
};

}  // namespace outrider::server
