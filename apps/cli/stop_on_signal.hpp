// Ctrl-C, SIGTERM and the end of the allowed processor time as a stop token: the run ends soon, and its
// results so far are written. HardStop ends what does not hear the token, without results.
#pragma once

#include <condition_variable>
#include <functional>
#include <mutex>
#include <stop_token>
#include <thread>

namespace outrider::cli {

/// Requests a stop on SIGINT, SIGTERM or SIGXCPU while the object exists; a second signal ends the process as
/// by default. Construct it before starting other threads, so that they leave these signals to it.
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

/// Ends a computation that does not hear a stop, such as one step of a library that takes minutes.
class HardStop {
 public:
  /// Calls leave() from another thread if the object still exists when the process has worked for 0.7 s, and
  /// 0.4 s have passed, since a stop was requested. leave() must end the process.
  HardStop(std::stop_token stop, std::function<void()> leave);
  ~HardStop();
  HardStop(const HardStop&) = delete;
  HardStop& operator=(const HardStop&) = delete;

 private:
  void watch(const std::stop_token& stop, const std::function<void()>& leave);

  std::mutex mutex_;
  std::condition_variable_any changed_;
  bool over_ = false;
  std::thread watcher_;
};

}  // namespace outrider::cli
