// Messages of mapping: landmarks and loop closures.
#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

#include "outrider/log/scene_messages.hpp"

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

  static constexpr std::string_view type = "outrider_msgs/msg/Landmark";
  template <class List>
  static void describe(List& list) {
    list.field("id", &Landmark::id);
    list.field("first_seen", &Landmark::first_seen, "s");
    list.field("position", &Landmark::position);
    list.field("sigma_x", &Landmark::sigma_x, "m");
    list.field("sigma_y", &Landmark::sigma_y, "m");
    list.field("correlation", &Landmark::correlation);
    list.field("sightings", &Landmark::sightings);
    list.field("truth", &Landmark::truth);
  }
};

/// The whole map of landmarks. The newest message holds.
struct Landmarks {
  std::vector<Landmark> landmarks;

  static constexpr std::string_view type = "outrider_msgs/msg/Landmarks";
  template <class List>
  static void describe(List& list) {
    list.field("landmarks", &Landmarks::landmarks);
  }
};

/// The landmarks that were seen at this time, in the frame of the robot.
struct Sightings {
  std::vector<Point2> points;

  static constexpr std::string_view type = "outrider_msgs/msg/Sightings";
  template <class List>
  static void describe(List& list) {
    list.field("points", &Sightings::points);
  }
};

/// Two poses that were joined because a place was recognised, at their present estimates.
struct Loop {
  double closed = 0.0;  ///< when
  Point2 from;
  Point2 to;

  static constexpr std::string_view type = "outrider_msgs/msg/Loop";
  template <class List>
  static void describe(List& list) {
    list.field("closed", &Loop::closed, "s");
    list.field("from", &Loop::from);
    list.field("to", &Loop::to);
  }
};

/// All loops. The newest message holds.
struct Loops {
  std::vector<Loop> loops;

  static constexpr std::string_view type = "outrider_msgs/msg/Loops";
  template <class List>
  static void describe(List& list) {
    list.field("loops", &Loops::loops);
  }
};

}  // namespace outrider::outrider_msgs
