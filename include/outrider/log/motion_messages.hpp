// Messages of drives, of exploration, of coverage and of pursuit.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "outrider/log/ros_messages.hpp"
#include "outrider/log/scene_messages.hpp"

namespace outrider::outrider_msgs {

/// A tag on a wall.
struct Tag {
  std::int32_t id = 0;
  geometry_msgs::Point position;  ///< of its centre; z is NaN if the height is not known
  double facing = 0.0;            ///< heading of the normal that points out of the wall
  double size = 0.0;              ///< side of the square

  static constexpr std::string_view type = "outrider_msgs/msg/Tag";
  template <class List>
  static void describe(List& list) {
    list.field("id", &Tag::id);
    list.field("position", &Tag::position);
    list.field("facing", &Tag::facing, "rad");
    list.field("size", &Tag::size, "m");
  }
};

struct Tags {
  std::vector<Tag> tags;

  static constexpr std::string_view type = "outrider_msgs/msg/Tags";
  template <class List>
  static void describe(List& list) {
    list.field("tags", &Tags::tags);
  }
};

/// A waypoint of a drive, and how accurately the robot reached it.
struct Waypoint {
  Point2 position;
  double heading = 0.0;
  bool stop = true;      ///< the robot stops there; false: it passes by
  double reached = 0.0;  ///< when; NaN: not yet, or passed by
  Point2 error;          ///< of the true position at that time
  double heading_error = 0.0;

  static constexpr std::string_view type = "outrider_msgs/msg/Waypoint";
  template <class List>
  static void describe(List& list) {
    list.field("position", &Waypoint::position);
    list.field("heading", &Waypoint::heading, "rad");
    list.field("stop", &Waypoint::stop);
    list.field("reached", &Waypoint::reached, "s");
    list.field("error", &Waypoint::error);
    list.field("heading_error", &Waypoint::heading_error, "rad");
  }
};

/// All waypoints of a drive. The newest message holds.
struct Waypoints {
  bool closed_loop = true;  ///< the robot corrects its errors by what it observes
  std::vector<Waypoint> waypoints;

  static constexpr std::string_view type = "outrider_msgs/msg/Waypoints";
  template <class List>
  static void describe(List& list) {
    list.field("closed_loop", &Waypoints::closed_loop);
    list.field("waypoints", &Waypoints::waypoints);
  }
};

/// A place that a decision compared.
struct Candidate {
  Point2 position;
  double cost = 0.0;   ///< time to turn and drive there
  double gain = 0.0;   ///< unknown area that is expected to be seen from there
  double value = 0.0;  ///< what the strategy compares; NaN: another place counts for this one, too
  bool chosen = false;

  static constexpr std::string_view type = "outrider_msgs/msg/Candidate";
  template <class List>
  static void describe(List& list) {
    list.field("position", &Candidate::position);
    list.field("cost", &Candidate::cost, "s");
    list.field("gain", &Candidate::gain, "m2");
    list.field("value", &Candidate::value);
    list.field("chosen", &Candidate::chosen);
  }
};

/// The choice of a next goal. The goal and the path to it are on /goal_pose and /plan.
struct Decision {
  std::string kind;                   ///< frontier, home, ...
  std::uint32_t frontiers = 0;        ///< open at this time
  std::string value_of;               ///< what the values are, such as "s of the round"
  bool most_is_best = false;          ///< the largest value is the best, not the least
  std::vector<Candidate> candidates;  ///< the best of them, at most 16, the best first; none on the way home

  static constexpr std::string_view type = "outrider_msgs/msg/Decision";
  template <class List>
  static void describe(List& list) {
    list.field("kind", &Decision::kind);
    list.field("frontiers", &Decision::frontiers);
    list.field("value_of", &Decision::value_of);
    list.field("most_is_best", &Decision::most_is_best);
    list.field("candidates", &Decision::candidates);
  }
};

/// A frontier that was not explored, and why.
struct Refusal {
  Point2 position;
  std::string reason;  ///< one sentence

  static constexpr std::string_view type = "outrider_msgs/msg/Refusal";
  template <class List>
  static void describe(List& list) {
    list.field("position", &Refusal::position);
    list.field("reason", &Refusal::reason);
  }
};

/// The area to cover, and what was left out. The newest message holds.
struct CoverageArea {
  std::vector<Outline> area;     ///< to cover
  std::vector<Outline> reach;    ///< the part of it that the robot can cover
  std::vector<Outline> missed;   ///< the part of the reach that was not covered
  std::vector<Outline> overlap;  ///< the part of the reach that was covered more than once
  std::vector<Point2> planned;   ///< track

  static constexpr std::string_view type = "outrider_msgs/msg/CoverageArea";
  template <class List>
  static void describe(List& list) {
    list.field("area", &CoverageArea::area);
    list.field("reach", &CoverageArea::reach);
    list.field("missed", &CoverageArea::missed);
    list.field("overlap", &CoverageArea::overlap);
    list.field("planned", &CoverageArea::planned);
  }
};

/// The areas that the robot has covered so far on its path over an area. They are about linear between two
/// messages.
struct Coverage {
  double covered = 0.0;  ///< at least once
  double overlap = 0.0;  ///< more than once

  static constexpr std::string_view type = "outrider_msgs/msg/Coverage";
  template <class List>
  static void describe(List& list) {
    list.field("covered", &Coverage::covered, "m2");
    list.field("overlap", &Coverage::overlap, "m2");
  }
};

/// The section of a path over an area that begins now. It goes on until the next one, or until the end.
struct CoveragePass {
  std::string role;  ///< lap, lane or move

  static constexpr std::string_view type = "outrider_msgs/msg/CoveragePass";
  template <class List>
  static void describe(List& list) {
    list.field("role", &CoveragePass::role);
  }
};

/// The cost of each cell, row by row from the lowest corner. A large map is logged coarser.
struct CostGrid {
  Point2 origin;          ///< lowest corner
  double resolution = 1;  ///< side of a cell
  std::uint32_t width = 0;
  std::uint32_t height = 0;
  std::vector<double> costs;  ///< -1: wall

  static constexpr std::string_view type = "outrider_msgs/msg/CostGrid";
  template <class List>
  static void describe(List& list) {
    list.field("origin", &CostGrid::origin);
    list.field("resolution", &CostGrid::resolution, "m");
    list.field("width", &CostGrid::width, "cells");
    list.field("height", &CostGrid::height, "cells");
    list.field("costs", &CostGrid::costs);
  }
};

/// The cost that all robots have paid together.
struct PaidCost {
  double paid = 0.0;

  static constexpr std::string_view type = "outrider_msgs/msg/PaidCost";
  template <class List>
  static void describe(List& list) {
    list.field("paid", &PaidCost::paid);
  }
};

/// The known costs and bounds of a pursuit. Costs are those of the whole mission.
struct CostBound {
  double expansions = 0.0;   ///< of all planning until now
  double cost = 0.0;         ///< of the best known catch; NaN: none
  double lower_bound = 0.0;  ///< proven lower bound of the cost; 0: none

  static constexpr std::string_view type = "outrider_msgs/msg/CostBound";
  template <class List>
  static void describe(List& list) {
    list.field("expansions", &CostBound::expansions);
    list.field("cost", &CostBound::cost);
    list.field("lower_bound", &CostBound::lower_bound);
  }
};

}  // namespace outrider::outrider_msgs
