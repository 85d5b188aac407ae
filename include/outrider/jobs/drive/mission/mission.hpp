// DriveMission executes a drive: a pure step from the observations of a robot on wheels to the wheel speeds
// that it commands.
//
// Closed loop: in each period dead reckoning advances the belief to the time of the newest image. The tags of
// the image correct the belief (estimate/localise.hpp) unless the image was used before, or is older than the
// latency of the camera and half a period. An image that comes late corrects the belief of its own time. Dead
// reckoning then advances the belief to the present. The follower computes the next command for the pose at
// which the command takes effect. A stop counts as reached if the robot stands there and the tags confirm it
// (stop_check.hpp). If they do not within `most_settle_s`, the stop is unconfirmed and the robot goes on.
//
// A robot that sees tags at impossible places in several images in a row stands still, finds itself by these
// tags (relocaliser.hpp) and goes on. Until a second tag agrees, stops are unconfirmed. A tag that other tags
// contradict then confirms no stop any more. If the first tags in sight contradict the start, which is exact,
// their map or their size is wrong, and no stop is confirmed.
//
// Open loop: the mission executes the motions of control/timed_drive.hpp one after another and ignores tags.
//
// The mission fails if the robot is lost or a waypoint takes longer than the patience. It is lost if the
// covariance of the belief exceeds the limits, if the tags in sight contradict the belief and do not agree on
// another pose, or if obstacles stand between the robot and the next waypoint after it has found itself. The
// first and the last command are to rest, for links that lose commands.
#pragma once

#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "outrider/control/timed_drive.hpp"
#include "outrider/jobs/drive/localisation/reckoning_history.hpp"
#include "outrider/jobs/drive/localisation/relocaliser.hpp"
#include "outrider/jobs/drive/localisation/tag_votes.hpp"
#include "outrider/jobs/drive/mission/stop_check.hpp"
#include "outrider/jobs/drive/task.hpp"
#include "outrider/robot/mission.hpp"
#include "outrider/world/collision_map.hpp"

namespace outrider {

/// A stop at which the robot stood.
struct DriveArrival {
  std::size_t waypoint = 0;  ///< its index
  double time_s = 0.0;
  PoseBelief belief;  ///< at that time
  std::string doubt;  ///< why the stop is unconfirmed; empty: it is reached
};

/// A time at which the robot found itself by its tags alone.
struct Relocalisation {
  double time_s = 0.0;
  PoseBelief belief;
  std::set<int> tags;  ///< ids of the tags that said so
};

/// The tags that alone told where the robot is when its belief could not contradict them.
struct TagSupport {
  double time_s = 0.0;
  std::set<int> tags;         ///< their ids, and of those that agreed later
  bool corroborated = false;  ///< two different tags agree
};

/// A robot that turns in place at a stop, to see a second tag.
struct LookRound {
  std::vector<double> left_rad;    ///< headings that it has not tried yet
  double heading_rad = 0.0;        ///< the one that it tries
  double began_s = 0.0;            ///< when it began to turn there
  std::optional<double> stands_s;  ///< since when it stands there
  std::size_t votes = 0;           ///< tags that it had seen at the stop before
  bool returns = false;            ///< it turns back to the heading of the stop
};

/// How a robot keeps clear of obstacles on the way to a waypoint.
struct KeepClear {
  std::size_t waypoint = std::numeric_limits<std::size_t>::max();  ///< the next one
  Vec2 from;                                                       ///< where the leg to it begins
  double kept_m = 0.0;                                             ///< beyond the radius
  double held_s = 0.0;  ///< for which commands were held back on that leg
};

/// How often a tag agreed with the other tags and the belief.
struct TagRecord {
  std::int64_t used = 0;
  std::int64_t refused = 0;  ///< in images that other tags explain
};

/// How a mission ended.
enum class DriveEnd {
  none,
  done,         ///< every stop is reached
  unconfirmed,  ///< the robot believes that it stood at every stop, but not all are confirmed
  doubtful,     ///< every stop is reached, but a tag contradicted the others
  lost,
  stuck,
};

/// The state of the execution.
struct DriveMission {
  /// Returns the next DriveWheels, or nothing if the mission is over: see `end`. The task must have a
  /// waypoint, and the last one must be a stop.
  std::optional<Command> step(const Observation& seen);

  DriveTask task;
  Reckoning reckoning;
  ReckoningHistory history;  ///< kept if images come late
  Follower follower;
  std::vector<TimedMotion> motions;  ///< of the open loop
  std::size_t motion = 0;            ///< index of the current motion
  double since_s = 0.0;              ///< start of the path to the current waypoint, or of the current motion
  std::optional<StopCheck> stop;     ///< set while the robot stands at a stop
  std::optional<LookRound> look_round;  ///< set while the robot looks round at a stop
  TagVotes votes;                       ///< of the tags seen at this stop
  bool wide = false;  ///< since the last stop, tags corrected a belief that could not contradict them
  std::map<std::size_t, int> rounds_at;                       ///< how often it looked round, by waypoint
  double image_s = -std::numeric_limits<double>::infinity();  ///< time of the newest image
  double tag_s = 0.0;                                         ///< time of the last correction by a tag
  std::int64_t images = 0;                                    ///< number of images recent enough to use
  std::int64_t used = 0;                                      ///< images with a tag that corrected the belief
  std::int64_t refused = 0;          ///< number of last images in a row with impossible tags
  double refused_s = 0.0;            ///< time of the last of them
  Relocaliser relocaliser;           ///< of these images
  double corner_variance_px2 = 0.0;  ///< of a detected corner along each axis, estimated from recent tags
  std::vector<Relocalisation> relocalisations;
  std::optional<TagSupport> support;  ///< on what the belief rests; nothing: on the start
  bool start_contradicted = false;  ///< the first tags in sight did not agree with the start, which is exact
  std::map<int, TagRecord> tag_records;  ///< by id
  /// Ids of tags that said alone where the robot is, and that other tags contradicted later. They confirm
  /// nothing.
  std::set<int> suspects;
  std::vector<DriveArrival> arrivals;
  std::shared_ptr<const CollisionMap> ground;  ///< the obstacles at the height of the camera
  KeepClear keeps_clear;
  bool initial_stop_sent = false;
  DriveEnd end = DriveEnd::none;
  std::string reason;  ///< why the mission failed
};

/// Starts a mission.
DriveMission begin(DriveTask task);

}  // namespace outrider
