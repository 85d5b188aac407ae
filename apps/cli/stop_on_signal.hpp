// Ctrl-C and SIGTERM as a stop token: the run ends soon, and what it has done is written.
#pragma once

#include <stop_token>
#include <thread>

namespace outrider::cli {

/// While it lives, SIGINT and SIGTERM raise the token; a second one ends the process as if nobody listened.
/// Made before other threads are started, so that they leave these signals to it.
class StopOnSignal {
 public:
  StopOnSignal();
  ~StopOnSignal();
  StopOnSignal(const StopOnSignal&) = delete;
  StopOnSignal& operator=(const StopOnSignal&) = delete;

  [[nodiscard]] std::stop_token token() const { return source_.get_token(); }

 private:
  void wait();

  std::stop_source source_;
  std::thread waiter_;
};

}  // namespace outrider::cli
