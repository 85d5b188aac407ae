// Ctrl-C, SIGTERM and the end of the allowed processor time as a stop token: the run ends soon, and its
// results so far are written.
#pragma once

#include <stop_token>
#include <thread>

namespace outrider::cli {

/// Requests a stop on SIGINT, SIGTERM or SIGXCPU while the object exists; a second signal ends the process as by
/// default. Construct it before starting other threads, so that they leave these signals to it.
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
