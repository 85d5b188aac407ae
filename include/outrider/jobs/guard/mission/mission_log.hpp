// GuardMissionLog: logs what a prepared guard mission plans and does while it goes on: the yard, from where
// targets can be hit, the tour, and what becomes of the targets. Poses, joints and events are logged by
// whoever knows them. Only for targets that stand still from the start.
#pragma once

#include "outrider/jobs/guard/run/prepare.hpp"
#include "outrider/log/log.hpp"

namespace outrider {

/// Logs a mission. Thread rule: one at a time.
class GuardMissionLog {
 public:
  /// Logs the yard and the plan. Log and mission must outlive this object.
  GuardMissionLog(Log& log, const PreparedGuard& guard);
  ~GuardMissionLog();
  /// Logs what has changed. Call it after each step of the mission.
  void note(const GuardMission& mission, double time_s);

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace outrider
