// The log of what a guard mission does: what becomes of the targets, and where they are. Poses, joints and
// events are logged by whoever knows them.
#pragma once

#include <cstddef>
#include <vector>

#include "outrider/jobs/guard/run/prepare.hpp"
#include "outrider/log/log.hpp"
#include "outrider/log/log_queue.hpp"
#include "outrider/log/messages/gun_messages.hpp"

namespace outrider {

/// Logs what becomes of targets. Thread rule: one at a time.
class TargetLog {
 public:
  /// Logs the targets as they are at first: one for each of the intruders that come, or all if that is null.
  /// `walks` is the true motion of walkers; null if targets stand still. What is known before its time, such
  /// as when intruders come in, is put into the queue. The references must outlive this object.
  TargetLog(Log& log, LogQueue& queue, const std::vector<Target>& targets,
            const std::vector<Intruder>* intruders = nullptr, const std::vector<Walk>* walks = nullptr);
  /// Logs what has changed. Call it after each step of the mission.
  void note(const GuardMission& mission, double time_s);
  /// Logs where walkers are in the end.
  void finish(const GuardMission& mission, double time_s);

 private:
  void begin(const Target& target, const Intruder* comes);
  void place(double time_s, std::size_t who, Vec2 at, Vec2 believed);
  void note_walker(const MovingTargets& moving, std::size_t who);
  void note_record(const TargetRecord& record, std::size_t who, double time_s);
  /// Logs where a walker was when it was hit, or in the end.
  void place_last(double time_s, std::size_t who);

  Log& log_;
  LogQueue& queue_;
  const std::vector<Walk>* walks_;
  std::vector<outrider_msgs::Target> told_;  // by target: its newest message
  std::vector<double> heights_m_;            // by target: of its centre
  std::vector<std::size_t> seen_;            // by walker: number of observations that are logged
  double noted_s_ = 0.0;                     // time of the last note
};

/// Logs what was prepared for targets that stand still: the yard, from where they can be hit, and the tour.
void log_prepared(Log& log, const PreparedGuard& guard);

}  // namespace outrider
