// A line on standard error that says what long work is at, where people watch.
#pragma once

#include <condition_variable>
#include <mutex>
#include <string>
#include <thread>

#include "outrider/job/watch.hpp"
#include "watcher.hpp"

namespace outrider::cli {

/// Shows "[###..] step, 3 s" from the first second on, and leaves nothing behind. Silent where standard
/// error is no terminal. The steps are named before they begin. Thread rule: one thread calls.
///
/// Programs that watch set OUTRIDER_PROGRESS to the number of an open descriptor, and read from it a line of
/// JSON for each step and each hundredth of one: {"step":2,"steps":4,"name":"planning the tour","part":0.25}.
class Progress {
 public:
  explicit Progress(int steps = 1);
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  /// What a run tells of itself.
  void show(const RunStep& step);
  /// The next step begins.
  void next(const std::string& step);
  /// That part of the present step is done, from 0 to 1.
  void part(double done);
  /// Clears the line, for good.
  void end();

 private:
  void watch();
  void report() const;  // with the lock held

  int steps_;
  std::mutex mutex_;  // guards what follows
  std::condition_variable ended_;
  bool over_ = false;
  int done_ = -1;
  double part_ = 0.0;
  std::string step_;
  Watcher program_;
  std::thread watcher_;
};

}  // namespace outrider::cli
