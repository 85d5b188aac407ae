// LogQueue: messages that are known before their time, such as the hit of a ball in flight. They are logged
// in the order of time once their time has come.
#pragma once

#include <algorithm>
#include <functional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "outrider/log/append.hpp"
#include "outrider/log/log.hpp"

namespace outrider {

class LogQueue {
 public:
  /// Takes a message for the topic, which must outlive the queue.
  template <class Message>
  void note(double time_s, std::string_view topic, Message message) {
    waiting_.push_back({time_s, [topic, time_s, held = std::move(message)](Log& log) mutable {
                          log.append(topic, time_s, std::move(held));
                        }});
  }
  /// Takes the true pose of the robot (append.hpp).
  void note_pose(double time_s, const Pose2& pose) {
    waiting_.push_back({time_s, [time_s, pose](Log& log) { log_pose(log, time_s, pose); }});
  }
  /// Takes an event (append.hpp).
  void note_event(double time_s, std::string kind, std::string sentence) {
    waiting_.push_back({time_s, [time_s, kind = std::move(kind), text = std::move(sentence)](Log& log) {
                          log_event(log, time_s, kind, text);
                        }});
  }

  /// Logs all messages up to `time_s`; messages of equal time in the order in which they were noted.
  void flush(Log& log, double time_s) {
    std::ranges::stable_sort(waiting_, {}, &Waiting::time_s);
    const auto later = std::ranges::upper_bound(waiting_, time_s, {}, &Waiting::time_s);
    for (auto one = waiting_.begin(); one != later; ++one) one->append(log);
    waiting_.erase(waiting_.begin(), later);
  }

 private:
  struct Waiting {
    double time_s = 0.0;
    std::function<void(Log&)> append;
  };
  std::vector<Waiting> waiting_;
};

}  // namespace outrider
