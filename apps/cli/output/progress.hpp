// A line on standard error that shows the progress of long work, if standard error is a terminal.
#pragma once

#include <condition_variable>
#include <mutex>
#include <string>
#include <thread>

#include "outrider/job/watch.hpp"
#include "watcher.hpp"

namespace outrider::cli {

/// Shows "[###..] step, 3 s" after the first second, and clears the line at the end. Prints nothing if
/// standard error is not a terminal. Name each step before it begins; before the first the step is "loading".
/// Thread rule: call from one thread only.
///
/// A watching program sets OUTRIDER_PROGRESS to the number of an open descriptor, and reads from it one line
/// of JSON for each step and each hundredth of a step: {"step":2,"steps":4,"name":"planning the
/// tour","part":0.25}.
class Progress {
 public:
  explicit Progress(int steps = 1);
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  /// Shows the step that a run reports.
  void show(const RunStep& step);
  /// Begins the next step.
  void next(const std::string& step);
  /// Sets the finished part of the current step, from 0 to 1.
  void part(double done);
  /// Clears the line and shows nothing further.
  void end();

 private:
  void watch();
  void report() const;  // call with the lock held

  int steps_;
  std::mutex mutex_;  // guards the members below
  std::condition_variable ended_;
  bool over_ = false;
  int done_ = -1;
  double part_ = 0.0;
  std::string step_ = "loading";
  Watcher program_;
  std::thread watcher_;
};

}  // namespace outrider::cli
