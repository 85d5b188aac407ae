#include "planning/workspace_pool.hpp"

namespace outrider::server {

WorkspacePool::Place* WorkspacePool::free_place(const void* user) {
  Place* best = nullptr;
  for (Place& place : places_) {
    if (place.taken) continue;
    if (place.user == user) return &place;
    if (best == nullptr || place.last_use < best->last_use) best = &place;
  }
  return best;
}

std::optional<WorkspacePool::Lease> WorkspacePool::take(const void* user,
                                                        std::chrono::milliseconds longest_wait,
                                                        std::size_t most_waiting,
                                                        const std::stop_token& stop) {
  std::unique_lock lock(mutex_);
  Place* place = free_place(user);
  if (place == nullptr && waiting_ < most_waiting) {
    ++waiting_;
    given_back_.wait_for(lock, stop, longest_wait, [&] { return (place = free_place(user)) != nullptr; });
    --waiting_;
  }
  if (place == nullptr) return std::nullopt;
  place->taken = true;
  place->user = user;
  place->last_use = ++uses_;
  return Lease(this, static_cast<std::size_t>(place - places_.data()));
}

void WorkspacePool::give_back(std::size_t place) {
  {
    const std::lock_guard lock(mutex_);
    places_[place].taken = false;
  }
  given_back_.notify_one();
}

}  // namespace outrider::server
