#include "rigid_robot.hpp"

#include <fmt/format.h>

#include "outrider/core/units.hpp"
#include "outrider/sim/wheels.hpp"

namespace outrider {
namespace {

constexpr double chassis_kg = 5.0;
constexpr double wheel_kg = 0.3;
constexpr double water_kgpm3 = 1000.0;

std::string surface(FeltBy felt_by, double friction) {
  return fmt::format(
      "<surface><friction><ode><mu>{0}</mu><mu2>{0}</mu2></ode></friction>"
      "<contact><collide_bitmask>{1}</collide_bitmask></contact></surface>",
      friction, felt_by);
}

std::string inertial(double mass_kg, double across_kgm2, double axial_kgm2, double height_m = 0.0) {
  return fmt::format(
      "<inertial><pose>0 0 {} 0 0 0</pose><mass>{}</mass>"
      "<inertia><ixx>{}</ixx><iyy>{}</iyy><izz>{}</izz></inertia></inertial>",
      height_m, mass_kg, across_kgm2, across_kgm2, axial_kgm2);
}

/// An upright cylinder about the z axis of its frame.
std::string solid_cylinder(double mass_kg, double radius_m, double length_m, double height_m = 0.0) {
  const double r2 = radius_m * radius_m;
  return inertial(mass_kg, mass_kg * (3.0 * r2 + length_m * length_m) / 12.0, 0.5 * mass_kg * r2, height_m);
}

std::string caster(const std::string& name, double ahead_m, double radius_m) {
  return fmt::format(
      "<collision name='{}'><pose>{} 0 {} 0 0 0</pose>"
      "<geometry><sphere><radius>{}</radius></sphere></geometry>{}</collision>",
      name, ahead_m, radius_m, radius_m, surface(felt_by_robot, 0.0));
}

/// Its frame has z along the axle, to the left.
std::string wheel(const std::string& side, double left_m, double radius_m) {
  // Thin, as a robot that turns in place rolls on the inner edges.
  const double width_m = 0.04 * radius_m;
  return fmt::format(
      "<link name='{0}'><pose>0 {1} {2} {3} 0 0</pose>{4}<collision name='tyre'>"
      "<geometry><cylinder><radius>{2}</radius><length>{5}</length></cylinder></geometry>{6}</collision>"
      "</link><joint name='{0}_wheel' type='revolute'><parent>chassis</parent><child>{0}</child>"
      "<axis><xyz>0 0 1</xyz></axis></joint>",
      side, left_m, radius_m, -0.5 * pi, solid_cylinder(wheel_kg, radius_m, width_m), width_m,
      surface(felt_by_robot, 1.0));
}

}  // namespace

std::string robot_sdf(const RobotModel& robot, const Pose2& start, double floor_z_m) {
  const WheelBase base = wheel_base(robot);
  const double radius_m = 0.9 * robot.radius_m;
  const double low_m = 0.5 * base.wheel_radius_m;  // of the chassis above the floor
  const double length_m = robot.height_m - low_m;
  const double caster_m = base.wheel_radius_m / 3.0;
  return fmt::format(
      "<sdf version='1.9'><model name='robot'><pose>{} {} {} 0 0 {}</pose><link name='chassis'>{}"
      "<collision name='body'><pose>0 0 {} 0 0 0</pose>"
      "<geometry><cylinder><radius>{}</radius><length>{}</length></cylinder></geometry>{}</collision>{}{}"
      "</link>{}{}</model></sdf>",
      start.position.x, start.position.y, floor_z_m, start.heading_rad,
      solid_cylinder(chassis_kg, radius_m, length_m, base.wheel_radius_m), low_m + 0.5 * length_m, radius_m,
      length_m, surface(felt_by_robot, 1.0), caster("front", base.half_track_m, caster_m),
      caster("back", -base.half_track_m, caster_m), wheel("left", base.half_track_m, base.wheel_radius_m),
      wheel("right", -base.half_track_m, base.wheel_radius_m));
}

std::string ball_sdf(std::size_t ball, Vec3 centre, double radius_m) {
  const double mass_kg = water_kgpm3 * 4.0 / 3.0 * pi * radius_m * radius_m * radius_m;
  const double inertia_kgm2 = 0.4 * mass_kg * radius_m * radius_m;
  return fmt::format(
      "<sdf version='1.9'><model name='ball_{}'><pose>{} {} {} 0 0 0</pose><link name='ball'>{}"
      "<collision name='ball'><geometry><sphere><radius>{}</radius></sphere></geometry>{}</collision>"
      "</link></model></sdf>",
      ball, centre.x, centre.y, centre.z, inertial(mass_kg, inertia_kgm2, inertia_kgm2), radius_m,
      surface(felt_by_ball(ball), 1.0));
}

}  // namespace outrider
