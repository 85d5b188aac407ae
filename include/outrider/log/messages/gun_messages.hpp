// Messages of a robot that shoots at targets, and of the stations that refill it.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "outrider/log/encoding/message_fields.hpp"
#include "outrider/log/messages/ros_messages.hpp"
#include "outrider/log/messages/scene_messages.hpp"

namespace outrider::outrider_msgs {

/// The section of a solid with the vertical plane of a shot: x is the distance from the muzzle, y the height.
struct ProfilePiece {
  std::string name;
  std::vector<Point2> polygon;

  OUTRIDER_MESSAGE(ProfilePiece, "outrider_msgs/msg/ProfilePiece", name, polygon)
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

  OUTRIDER_MESSAGE(Shot, "outrider_msgs/msg/Shot", target, attempt, (flight, "s"), robot,
                   (robot_heading, "rad"), (gun_yaw, "rad"), (gun_pitch, "rad"), muzzle, (velocity, "m/s"),
                   (platform_velocity, "m/s"), contact, contact_point, hit, hit_by_reference_rule,
                   (clearance, "m"), path, profile)
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

  OUTRIDER_MESSAGE(Target, "outrider_msgs/msg/Target", name, status, reason, (size, "m"), (yaw, "rad"), shots,
                   entrance)
};

/// The position of a target. Between two messages of its name the target moves along a straight line.
struct TargetPosition {
  std::string name;
  geometry_msgs::Point centre;
  Point2 believed;  ///< where the robot takes it to be

  OUTRIDER_MESSAGE(TargetPosition, "outrider_msgs/msg/TargetPosition", name, centre, believed)
};

/// From where a target can be hit. The cells of the grid have the share of the permitted error, in percent,
/// that a shot from there forgives: 1 to 100, 0 if no shot hits from there, -1 if the robot cannot get there.
struct FiringRegion {
  std::string target;
  nav_msgs::OccupancyGrid grid;

  OUTRIDER_MESSAGE(FiringRegion, "outrider_msgs/msg/FiringRegion", target, grid)
};

/// A stop of a tour, and who is shot at from there.
struct TourStop {
  Point2 position;
  std::vector<std::string> targets;

  OUTRIDER_MESSAGE(TourStop, "outrider_msgs/msg/TourStop", position, targets)
};

/// A tour that is planned. The newest message holds: while the robot plans, tours become faster; then the
/// plan.
struct Tour {
  std::vector<TourStop> stops;
  std::vector<Point2> way;   ///< from the start through all stops
  double cost = 0.0;         ///< time that it takes
  double lower_bound = 0.0;  ///< no tour over the stops looked at takes less, as far as that is proven

  OUTRIDER_MESSAGE(Tour, "outrider_msgs/msg/Tour", stops, way, (cost, "s"), (lower_bound, "s"))
};

/// A station that refills the tank or charges the battery.
struct Station {
  std::string name;
  Point2 position;
  bool gives_water = false;
  bool gives_charge = false;

  OUTRIDER_MESSAGE(Station, "outrider_msgs/msg/Station", name, position, gives_water, gives_charge)
};

/// The stations, and what tank and battery hold when they are full; infinite if unlimited.
struct Supplies {
  double tank = 0.0;  ///< shots
  double battery = 0.0;
  std::vector<Station> stations;

  OUTRIDER_MESSAGE(Supplies, "outrider_msgs/msg/Supplies", (tank, "shots"), (battery, "J"), stations)
};

/// The levels of tank and battery. They are linear between two messages.
struct StoreLevels {
  double water = 0.0;
  double charge = 0.0;

  OUTRIDER_MESSAGE(StoreLevels, "outrider_msgs/msg/StoreLevels", (water, "shots"), (charge, "J"))
};

}  // namespace outrider::outrider_msgs
