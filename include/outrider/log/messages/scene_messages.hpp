// Messages that describe a run and what stands still in it. They are logged once, at time 0. Positions are in
// the frame "map", in metres; an unknown number is NaN.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "outrider/log/encoding/message_fields.hpp"

namespace outrider::outrider_msgs {

struct Point2 {
  double x = 0.0;
  double y = 0.0;

  OUTRIDER_MESSAGE(Point2, "outrider_msgs/msg/Point2", (x, "m"), (y, "m"))
};

/// A closed line: counter-clockwise around an area, clockwise around a hole in one.
struct Outline {
  std::vector<Point2> points;

  OUTRIDER_MESSAGE(Outline, "outrider_msgs/msg/Outline", points)
};

/// Named outlines, such as the walls that a laser can hit.
struct Outlines {
  std::vector<Outline> outlines;

  OUTRIDER_MESSAGE(Outlines, "outrider_msgs/msg/Outlines", outlines)
};

/// A convex polygon that is grown by a radius on all sides. One point and a radius make a disk.
struct RoundedPolygon {
  std::vector<Point2> points;
  double radius = 0.0;

  OUTRIDER_MESSAGE(RoundedPolygon, "outrider_msgs/msg/RoundedPolygon", points, (radius, "m"))
};

/// The job that is run, its world and its robot.
struct RunInfo {
  std::string job;
  std::string sim;         ///< "physics" if rigid bodies are simulated
  std::string engine;      ///< of mapping: "laser", "pose_graph", ...; else empty
  bool seeded = false;     ///< numbers are drawn at random, with `seed`
  std::uint64_t seed = 0;  ///< 0 if the run is not seeded
  std::string world;
  Point2 low;  ///< corners of the box that shows everything
  Point2 high;
  double gravity = 9.8;
  double robot_radius = 0.0;
  double gun_length = 0.0;  ///< from the yaw axis to the tip; 0: no gun
  double ball_radius = 0.0;
  double margin = 0.0;            ///< clearance that planned flights keep
  double coverage_width = 0.0;    ///< width of the strip that the robot covers; 0: none
  double coverage_length = 0.0;   ///< of a bar that covers, along the heading; 0: a disk covers
  double coverage_forward = 0.0;  ///< of the middle of the bar, ahead of the robot

  OUTRIDER_MESSAGE(RunInfo, "outrider_msgs/msg/RunInfo", job, sim, engine, seeded, seed, world, low, high,
                   (gravity, "m/s2"), (robot_radius, "m"), (gun_length, "m"), (ball_radius, "m"),
                   (margin, "m"), (coverage_width, "m"), (coverage_length, "m"), (coverage_forward, "m"))
};

/// A solid of the world.
struct Solid {
  std::string name;
  std::string kind;  ///< box, cylinder, sphere, half_space or mesh
  std::vector<RoundedPolygon> footprint;
  double low_z = 0.0;
  double high_z = 0.0;
  bool blocks_driving = false;  ///< some part of it is an obstacle for the robot

  OUTRIDER_MESSAGE(Solid, "outrider_msgs/msg/Solid", name, kind, footprint, (low_z, "m"), (high_z, "m"),
                   blocks_driving)
};

struct Solids {
  std::vector<Solid> solids;

  OUTRIDER_MESSAGE(Solids, "outrider_msgs/msg/Solids", solids)
};

/// A contour line. A closed one repeats its first point at the end.
struct Contour {
  double height = 0.0;
  std::vector<Point2> points;

  OUTRIDER_MESSAGE(Contour, "outrider_msgs/msg/Contour", (height, "m"), points)
};

/// Ground that is not level. The heights form a lattice, row by row from the lowest corner; each of its cells
/// is two triangles that share the diagonal from the lowest x and y. A large lattice is logged coarser.
struct Terrain {
  std::vector<Contour> contours;
  std::vector<RoundedPolygon> steep;  ///< too steep for the robot
  Point2 origin;                      ///< position of the first height
  Point2 spacing{1.0, 1.0};
  std::uint32_t columns = 0;
  std::uint32_t rows = 0;
  std::vector<double> heights;

  OUTRIDER_MESSAGE(Terrain, "outrider_msgs/msg/Terrain", contours, steep, origin, spacing, columns, rows,
                   (heights, "m"))
};

}  // namespace outrider::outrider_msgs
