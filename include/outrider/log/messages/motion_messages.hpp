// Messages of drives, of exploration, of coverage and of pursuit.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "outrider/log/encoding/message_fields.hpp"
#include "outrider/log/messages/ros_messages.hpp"
#include "outrider/log/messages/scene_messages.hpp"

namespace outrider::outrider_msgs {

/// A tag on a wall.
struct Tag {
  std::int32_t id = 0;
  geometry_msgs::Point position;  ///< of its centre; z is NaN if the height is not known
  double facing = 0.0;            ///< heading of the normal that points out of the wall
  double size = 0.0;              ///< side of the square

  OUTRIDER_MESSAGE(Tag, "outrider_msgs/msg/Tag", id, position, (facing, "rad"), (size, "m"))
};

struct Tags {
  std::vector<Tag> tags;

  OUTRIDER_MESSAGE(Tags, "outrider_msgs/msg/Tags", tags)
};

/// A waypoint of a drive, and how accurately the robot reached it.
struct Waypoint {
  Point2 position;
  double heading = 0.0;
  bool stop = true;      ///< the robot stops there; false: it passes by
  double reached = 0.0;  ///< when; NaN: not yet, or passed by
  Point2 error;          ///< of the true position at that time
  double heading_error = 0.0;

  OUTRIDER_MESSAGE(Waypoint, "outrider_msgs/msg/Waypoint", position, (heading, "rad"), stop, (reached, "s"),
                   error, (heading_error, "rad"))
};

/// All waypoints of a drive. The newest message holds.
struct Waypoints {
  bool closed_loop = true;  ///< the robot corrects its errors by what it observes
  std::vector<Waypoint> waypoints;

  OUTRIDER_MESSAGE(Waypoints, "outrider_msgs/msg/Waypoints", closed_loop, waypoints)
};

/// A place that a decision compared.
struct Candidate {
  Point2 position;
  double cost = 0.0;   ///< time to turn and drive there
  double gain = 0.0;   ///< unknown area that is expected to be seen from there
  double value = 0.0;  ///< what the strategy compares; NaN: another place counts for this one, too
  bool chosen = false;

  OUTRIDER_MESSAGE(Candidate, "outrider_msgs/msg/Candidate", position, (cost, "s"), (gain, "m2"), value,
                   chosen)
};

/// The choice of a next goal. The goal and the path to it are on /goal_pose and /plan.
struct Decision {
  std::string kind;                   ///< frontier, home, ...
  std::uint32_t frontiers = 0;        ///< open at this time
  std::string value_of;               ///< what the values are, such as "s of the round"
  bool most_is_best = false;          ///< the largest value is the best, not the least
  std::vector<Candidate> candidates;  ///< the best of them, at most 16, the best first; none on the way home

  OUTRIDER_MESSAGE(Decision, "outrider_msgs/msg/Decision", kind, frontiers, value_of, most_is_best,
                   candidates)
};

/// A frontier that was not explored, and why.
struct Refusal {
  Point2 position;
  std::string reason;  ///< one sentence

  OUTRIDER_MESSAGE(Refusal, "outrider_msgs/msg/Refusal", position, reason)
};

/// The area to cover, and what was left out. The newest message holds.
struct CoverageArea {
  std::vector<Outline> area;     ///< to cover
  std::vector<Outline> reach;    ///< the part of it that the robot can cover
  std::vector<Outline> missed;   ///< the part of the reach that was not covered
  std::vector<Outline> overlap;  ///< the part of the reach that was covered more than once
  std::vector<Point2> planned;   ///< track

  OUTRIDER_MESSAGE(CoverageArea, "outrider_msgs/msg/CoverageArea", area, reach, missed, overlap, planned)
};

/// The areas that the robot has covered so far on its path over an area. They are about linear between two
/// messages.
struct Coverage {
  double covered = 0.0;  ///< at least once
  double overlap = 0.0;  ///< more than once

  OUTRIDER_MESSAGE(Coverage, "outrider_msgs/msg/Coverage", (covered, "m2"), (overlap, "m2"))
};

/// The section of a path over an area that begins now. It goes on until the next one, or until the end.
struct CoveragePass {
  std::string role;  ///< lap, lane or move

  OUTRIDER_MESSAGE(CoveragePass, "outrider_msgs/msg/CoveragePass", role)
};

/// The cost of each cell, row by row from the lowest corner. A large map is logged coarser.
struct CostGrid {
  Point2 origin;          ///< lowest corner
  double resolution = 1;  ///< side of a cell
  std::uint32_t width = 0;
  std::uint32_t height = 0;
  std::vector<double> costs;  ///< -1: wall

  OUTRIDER_MESSAGE(CostGrid, "outrider_msgs/msg/CostGrid", origin, (resolution, "m"), (width, "cells"),
                   (height, "cells"), costs)
};

/// The cost that all robots have paid together.
struct PaidCost {
  double paid = 0.0;

  OUTRIDER_MESSAGE(PaidCost, "outrider_msgs/msg/PaidCost", paid)
};

/// The known costs and bounds of a pursuit. Costs are those of the whole mission.
struct CostBound {
  double expansions = 0.0;   ///< of all planning until now
  double cost = 0.0;         ///< of the best known catch; NaN: none
  double lower_bound = 0.0;  ///< proven lower bound of the cost; 0: none

  OUTRIDER_MESSAGE(CostBound, "outrider_msgs/msg/CostBound", expansions, cost, lower_bound)
};

}  // namespace outrider::outrider_msgs
