// ExploreLog: logs what the mission of an exploration does and believes, while it goes on: the map and its
// updates, poses and beliefs, decisions with goal and path, events, and what is left over. The measurements
// of the robot and the solids of its world are logged by the code that knows them.
#pragma once

#include <cstddef>
#include <cstdint>

#include "outrider/job/map_log.hpp"
#include "outrider/jobs/explore/mission/mission.hpp"
#include "outrider/log/log.hpp"

namespace outrider {

/// Logs an exploration. Thread rule: one at a time.
class ExploreLog {
 public:
  /// The log must outlive this object. `start` is where home is.
  ExploreLog(Log& log, const Pose2& start) : log_(log), start_(start) {}

  /// Logs the map, at most once a second. Call it after each scan that the mission perceived.
  void note_map(const ExploreMission& mission);
  /// Logs the rest. Call it after each step of the mission. `robot` is where the robot is.
  void note(const ExploreMission& mission, const Pose2& robot);
  /// Logs the end: the whole map, and what is left over.
  void finish(const ExploreMission& mission);

 private:
  void note_decision(const ExploreMission& mission);

  Log& log_;
  Pose2 start_;
  MapLog map_;
  std::size_t events_ = 0;
  std::size_t goal_changes_ = 0;
  bool went_home_ = false;
  std::int64_t loops_ = 0;
  double next_track_s_ = 0.0;
  double next_belief_s_ = 0.0;
};

}  // namespace outrider
