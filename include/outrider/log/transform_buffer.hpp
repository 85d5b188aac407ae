// TransformBuffer: the poses of frames in each other over time, from the messages of /tf and /tf_static.
//
//   TransformBuffer frames;
//   frames.add(message, Transforms::moving);
//   const auto base_T_laser = frames.find("base_link", "laser", time_ns);   // nothing: not connected
//
// Frames form a forest: each has at most one parent. A static transform holds at all times. Of a moving one
// the last `window_ns` are kept; between two of its times the position is linear and the rotation spherical
// linear, outside of them the nearest holds. A leading '/' of a name does not count, as in ROS 1.
//
// Memory: at most 10,000 frames, and 10,000 transforms of each moving one. Time: O(depth log window) for a
// look-up. Thread rule: one at a time.
#pragma once

#include <cstdint>
#include <deque>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "outrider/core/outcome.hpp"
#include "outrider/geometry/pose.hpp"
#include "outrider/log/messages/ros_messages.hpp"

namespace outrider {

enum class Transforms { fixed, moving };

/// Returns the rotation of a quaternion, which need not have the length 1; nothing if it is 0 or not finite.
std::optional<Rotation> rotation_of(const geometry_msgs::Quaternion& q);

class TransformBuffer {
 public:
  explicit TransformBuffer(std::int64_t window_ns = 30'000'000'000) : window_ns_(window_ns) {}

  /// Adds the transforms of a message. A frame that has another parent than before belongs to the new one
  /// from now on. Fault: bad_input that names the frames, for a transform that is not finite, or of a frame
  /// in itself; too many frames.
  Status add(const tf2_msgs::TFMessage& message, Transforms kind);

  /// Returns the pose of the frame `child` in the frame `parent`; nothing if they are not connected.
  [[nodiscard]] std::optional<Pose3> find(std::string_view parent, std::string_view child,
                                          std::int64_t time_ns) const;

  /// Returns the time up to which the pose is known, and not the nearest one: the earliest of the newest
  /// times of the moving transforms between the frames; the largest number if none moves; nothing if they are
  /// not connected.
  [[nodiscard]] std::optional<std::int64_t> known_until_ns(std::string_view parent,
                                                           std::string_view child) const;
  /// Returns the time from which on it is known: the latest of their oldest times; the least number if none
  /// moves.
  [[nodiscard]] std::optional<std::int64_t> known_from_ns(std::string_view parent,
                                                          std::string_view child) const;

 private:
  struct Sample {
    std::int64_t time_ns = 0;
    Vec3 position;
    geometry_msgs::Quaternion rotation;  ///< of length 1
  };
  struct Frame {
    std::string parent;
    bool moves = false;
    std::deque<Sample> samples;  ///< in the order of time; one if it does not move

    [[nodiscard]] Pose3 at(std::int64_t time_ns) const;
  };
  /// The frames from two frames up to the first that they share.
  struct Route {
    std::vector<const Frame*> from_parent;
    std::vector<const Frame*> from_child;
  };

  Status add(const geometry_msgs::TransformStamped& transform, Transforms kind);
  [[nodiscard]] std::optional<Route> route(std::string_view parent, std::string_view child) const;

  std::int64_t window_ns_;
  std::map<std::string, Frame, std::less<>> frames_;  ///< by their names: those with a parent
};

}  // namespace outrider
