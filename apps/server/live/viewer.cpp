#include "live/viewer.hpp"

namespace outrider::server {

void Viewer::wake() {
  {
    const std::lock_guard lock(waking_);
    awake_ = true;
  }
  changed_.notify_one();
}

void Viewer::close() {
  {
    const std::lock_guard lock(waking_);
    closed_ = true;
  }
  changed_.notify_one();
}

bool Viewer::wait(Clock::time_point latest) {
  std::unique_lock lock(waking_);
  changed_.wait_until(lock, latest, [this] { return awake_ || closed_; });
  awake_ = false;
  return !closed_;
}

bool Viewer::closed() {
  const std::lock_guard lock(waking_);
  return closed_;
}

}  // namespace outrider::server
