// Messages of mapping: landmarks and loop closures.
#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

#include "outrider/log/encoding/message_fields.hpp"
#include "outrider/log/messages/scene_messages.hpp"

namespace outrider::outrider_msgs {

/// A landmark of the map with its present estimate.
struct Landmark {
  std::int64_t id = 0;
  double first_seen = 0.0;  ///< when it was added to the map
  Point2 position;
  double sigma_x = 0.0;
  double sigma_y = 0.0;
  double correlation = 0.0;  ///< of x and y
  std::uint32_t sightings = 0;
  Point2 truth;  ///< true position in the frame of the map; NaN: not known

  OUTRIDER_MESSAGE(Landmark, "outrider_msgs/msg/Landmark", id, (first_seen, "s"), position, (sigma_x, "m"),
                   (sigma_y, "m"), correlation, sightings, truth)
};

/// The whole map of landmarks. The newest message holds.
struct Landmarks {
  std::vector<Landmark> landmarks;

  OUTRIDER_MESSAGE(Landmarks, "outrider_msgs/msg/Landmarks", landmarks)
};

/// The landmarks that were seen at this time, in the frame of the robot.
struct Sightings {
  std::vector<Point2> points;

  OUTRIDER_MESSAGE(Sightings, "outrider_msgs/msg/Sightings", points)
};

/// Two poses that were joined because a place was recognised, at their present estimates.
struct Loop {
  double closed = 0.0;  ///< when
  Point2 from;
  Point2 to;

  OUTRIDER_MESSAGE(Loop, "outrider_msgs/msg/Loop", (closed, "s"), from, to)
};

/// All loops. The newest message holds.
struct Loops {
  std::vector<Loop> loops;

  OUTRIDER_MESSAGE(Loops, "outrider_msgs/msg/Loops", loops)
};

}  // namespace outrider::outrider_msgs
