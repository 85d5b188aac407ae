// Messages of a robot that shoots at targets, and of the stations that refill it.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "outrider/log/ros_messages.hpp"
#include "outrider/log/scene_messages.hpp"

namespace outrider::outrider_msgs {

/// The section of a solid with the vertical plane of a shot: x is the distance from the muzzle, y the height.
struct ProfilePiece {
  std::string name;
  std::vector<Point2> polygon;

  static constexpr std::string_view type = "outrider_msgs/msg/ProfilePiece";
  template <class List>
  static void describe(List& list) {
    list.field("name", &ProfilePiece::name);
    list.field("polygon", &ProfilePiece::polygon);
  }
};

/// A shot and its flight, logged when the ball leaves the muzzle.
struct Shot {
  std::string target;
  std::uint32_t attempt = 1;        ///< 1, 2, ... for this target
  double flight = 0.0;              ///< time until the first contact
  Point2 robot;                     ///< place of the robot
  double robot_heading = 0.0;       ///< counter-clockwise from +x
  double gun_yaw = 0.0;             ///< in the map, counter-clockwise from +x
  double gun_pitch = 0.0;           ///< up from the horizon
  geometry_msgs::Point muzzle;      ///< centre of the ball as it leaves
  geometry_msgs::Vector3 velocity;  ///< of the ball as it leaves
  Point2 platform_velocity;         ///< horizontal velocity of the robot at that time, included in `velocity`
  std::string contact;              ///< solid that the ball touched first; the name of the target on a hit
  geometry_msgs::Point contact_point;  ///< centre of the ball at the contact
  bool hit = false;
  bool hit_by_reference_rule = false;      ///< the ball came within 0.5 m of the base of the target
  double clearance = 0.0;                  ///< least distance from the ball to a solid before the contact
  std::vector<geometry_msgs::Point> path;  ///< of the ball, at equal times to the contact; empty: a parabola
  std::vector<ProfilePiece> profile;       ///< the side view; the box of the target under its name

  static constexpr std::string_view type = "outrider_msgs/msg/Shot";
  template <class List>
  static void describe(List& list) {
    list.field("target", &Shot::target);
    list.field("attempt", &Shot::attempt);
    list.field("flight", &Shot::flight, "s");
    list.field("robot", &Shot::robot);
    list.field("robot_heading", &Shot::robot_heading, "rad");
    list.field("gun_yaw", &Shot::gun_yaw, "rad");
    list.field("gun_pitch", &Shot::gun_pitch, "rad");
    list.field("muzzle", &Shot::muzzle);
    list.field("velocity", &Shot::velocity, "m/s");
    list.field("platform_velocity", &Shot::platform_velocity, "m/s");
    list.field("contact", &Shot::contact);
    list.field("contact_point", &Shot::contact_point);
    list.field("hit", &Shot::hit);
    list.field("hit_by_reference_rule", &Shot::hit_by_reference_rule);
    list.field("clearance", &Shot::clearance, "m");
    list.field("path", &Shot::path);
    list.field("profile", &Shot::profile);
  }
};

/// A target and what became of it. The newest message of each name holds.
struct Target {
  std::string name;
  std::string status;           ///< outside, waiting, reached, failed or unreachable
  std::string reason;           ///< one sentence
  geometry_msgs::Vector3 size;  ///< length, width, height
  double yaw = 0.0;
  std::uint32_t shots = 0;  ///< so far
  std::string entrance;     ///< through which it came; empty: it was there from the beginning

  static constexpr std::string_view type = "outrider_msgs/msg/Target";
  template <class List>
  static void describe(List& list) {
    list.field("name", &Target::name);
    list.field("status", &Target::status);
    list.field("reason", &Target::reason);
    list.field("size", &Target::size, "m");
    list.field("yaw", &Target::yaw, "rad");
    list.field("shots", &Target::shots);
    list.field("entrance", &Target::entrance);
  }
};

/// The position of a target. Between two messages of its name the target moves along a straight line.
struct TargetPosition {
  std::string name;
  geometry_msgs::Point centre;
  Point2 believed;  ///< where the robot takes it to be

  static constexpr std::string_view type = "outrider_msgs/msg/TargetPosition";
  template <class List>
  static void describe(List& list) {
    list.field("name", &TargetPosition::name);
    list.field("centre", &TargetPosition::centre);
    list.field("believed", &TargetPosition::believed);
  }
};

/// From where a target can be hit. The cells of the grid have the share of the permitted error, in percent,
/// that a shot from there forgives: 1 to 100, 0 if no shot hits from there, -1 if the robot cannot get there.
struct FiringRegion {
  std::string target;
  nav_msgs::OccupancyGrid grid;

  static constexpr std::string_view type = "outrider_msgs/msg/FiringRegion";
  template <class List>
  static void describe(List& list) {
    list.field("target", &FiringRegion::target);
    list.field("grid", &FiringRegion::grid);
  }
};

/// A stop of a tour, and who is shot at from there.
struct TourStop {
  Point2 position;
  std::vector<std::string> targets;

  static constexpr std::string_view type = "outrider_msgs/msg/TourStop";
  template <class List>
  static void describe(List& list) {
    list.field("position", &TourStop::position);
    list.field("targets", &TourStop::targets);
  }
};

/// A tour that is planned. The newest message holds: while the robot plans, tours become faster; then the
/// plan.
struct Tour {
  std::vector<TourStop> stops;
  std::vector<Point2> way;   ///< from the start through all stops
  double cost = 0.0;         ///< time that it takes
  double lower_bound = 0.0;  ///< no tour over the stops looked at takes less, as far as that is proven

  static constexpr std::string_view type = "outrider_msgs/msg/Tour";
  template <class List>
  static void describe(List& list) {
    list.field("stops", &Tour::stops);
    list.field("way", &Tour::way);
    list.field("cost", &Tour::cost, "s");
    list.field("lower_bound", &Tour::lower_bound, "s");
  }
};

/// A station that refills the tank or charges the battery.
struct Station {
  std::string name;
  Point2 position;
  bool gives_water = false;
  bool gives_charge = false;

  static constexpr std::string_view type = "outrider_msgs/msg/Station";
  template <class List>
  static void describe(List& list) {
    list.field("name", &Station::name);
    list.field("position", &Station::position);
    list.field("gives_water", &Station::gives_water);
    list.field("gives_charge", &Station::gives_charge);
  }
};

/// The stations, and what tank and battery hold when they are full; infinite if unlimited.
struct Supplies {
  double tank = 0.0;  ///< shots
  double battery = 0.0;
  std::vector<Station> stations;

  static constexpr std::string_view type = "outrider_msgs/msg/Supplies";
  template <class List>
  static void describe(List& list) {
    list.field("tank", &Supplies::tank, "shots");
    list.field("battery", &Supplies::battery, "J");
    list.field("stations", &Supplies::stations);
  }
};

/// The levels of tank and battery. They are linear between two messages.
struct StoreLevels {
  double water = 0.0;
  double charge = 0.0;

  static constexpr std::string_view type = "outrider_msgs/msg/StoreLevels";
  template <class List>
  static void describe(List& list) {
    list.field("water", &StoreLevels::water, "shots");
    list.field("charge", &StoreLevels::charge, "J");
  }
};

}  // namespace outrider::outrider_msgs
