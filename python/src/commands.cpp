// The commands that missions give to robots.
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <algorithm>
#include <string>
#include <vector>

#include "arrays.hpp"
#include "bindings.hpp"
#include "faults.hpp"
#include "outrider/robot/command.hpp"

namespace outrider::python {

namespace py = pybind11;

namespace {

py::tuple tuple_of(Vec2 point) { return py::make_tuple(point.x, point.y); }

void bind_drives(py::module_& module) {
  py::class_<DriveTwist>(module, "DriveTwist")
      .def(py::init([](double ahead, double left, double turn, double until) {
             return DriveTwist{{ahead, left, turn}, until};
           }),
           py::kw_only(), py::arg("ahead"), py::arg("left") = 0.0, py::arg("turn") = 0.0, py::arg("until"))
      .def_property_readonly("ahead", [](const DriveTwist& command) { return command.twist.ahead_mps; })
      .def_property_readonly("left", [](const DriveTwist& command) { return command.twist.left_mps; })
      .def_property_readonly("turn", [](const DriveTwist& command) { return command.twist.turn_radps; })
      .def_readonly("until", &DriveTwist::until_s);
  py::class_<DriveWheels>(module, "DriveWheels")
      .def(py::init([](const py::handle& speeds, double until) {
             const std::vector<double> given = numbers_of_shape(speeds, {-1}, "speeds");
             if (given.size() > most_wheels) refuse("there are at most four wheels", "speeds");
             DriveWheels command{{}, until};
             std::ranges::copy(given, command.wheels.begin());
             return command;
           }),
           py::kw_only(), py::arg("speeds"), py::arg("until"))
      .def_property_readonly("speeds",
                             [](const DriveWheels& command) {
                               return array_of_shape({py::ssize_t{most_wheels}}, command.wheels.data());
                             })
      .def_readonly("until", &DriveWheels::until_s);
  py::class_<Wait>(module, "Wait")
      .def(py::init([](double until) { return Wait{until}; }), py::kw_only(), py::arg("until"))
      .def_readonly("until", &Wait::until_s);
  py::class_<StepToCell>(module, "StepToCell")
      .def(py::init([](const py::handle& cell, std::size_t robot) {
             return StepToCell{robot, cell_of(cell, "cell")};
           }),
           py::arg("cell"), py::kw_only(), py::arg("robot") = 0)
      .def_readonly("robot", &StepToCell::robot)
      .def_property_readonly(
          "cell", [](const StepToCell& command) { return py::make_tuple(command.cell.x, command.cell.y); });
}

void bind_ways(py::module_& module) {
  py::class_<FollowPiece>(module, "FollowPiece")
      .def_property_readonly("from_point",
                             [](const FollowPiece& command) { return tuple_of(command.piece.from); })
      .def_property_readonly("to_point",
                             [](const FollowPiece& command) { return tuple_of(command.piece.to); })
      .def_property_readonly("turn", [](const FollowPiece& command) { return command.piece.turn_rad; })
      .def_property_readonly("backward", [](const FollowPiece& command) { return command.piece.backward; })
      .def_readonly("pause", &FollowPiece::pause_s);
  py::class_<FireInPassing>(module, "FireInPassing")
      .def_readonly("target", &FireInPassing::target)
      .def_readonly("leg", &FireInPassing::leg)
      .def_readonly("after", &FireInPassing::after_s)
      .def_property_readonly("yaw", [](const FireInPassing& shot) { return shot.shot.yaw_rad; })
      .def_property_readonly("pitch", [](const FireInPassing& shot) { return shot.shot.pitch_rad; })
      .def_property_readonly("speed", [](const FireInPassing& shot) { return shot.shot.speed_mps; });
  py::class_<FollowWaypoints>(module, "FollowWaypoints")
      .def(py::init([](const py::handle& waypoints, bool until_arrival) {
             return FollowWaypoints{points_of(waypoints, "waypoints"), until_arrival};
           }),
           py::arg("waypoints"), py::kw_only(), py::arg("until_arrival") = false)
      .def_property_readonly("waypoints",
                             [](const FollowWaypoints& command) { return array_of(command.waypoints); })
      .def_readonly("until_arrival", &FollowWaypoints::until_arrival)
      .def_readonly("shots", &FollowWaypoints::shots)
      .def_readonly("aim", &FollowWaypoints::aim);
}

void bind_gun(py::module_& module) {
  py::class_<AimGun>(module, "AimGun")
      .def(py::init([](double yaw, double pitch) { return AimGun{yaw, pitch}; }), py::kw_only(),
           py::arg("yaw"), py::arg("pitch"))
      .def_readonly("yaw", &AimGun::yaw_rad)
      .def_readonly("pitch", &AimGun::pitch_rad);
  py::class_<Fire>(module, "Fire")
      .def(py::init([](std::size_t target, double yaw, double pitch, double speed, bool until_landed) {
             return Fire{target, {yaw, pitch, speed}, until_landed};
           }),
           py::kw_only(), py::arg("target"), py::arg("yaw"), py::arg("pitch"), py::arg("speed"),
           py::arg("until_landed") = true)
      .def_readonly("target", &Fire::target)
      .def_property_readonly("yaw", [](const Fire& command) { return command.shot.yaw_rad; })
      .def_property_readonly("pitch", [](const Fire& command) { return command.shot.pitch_rad; })
      .def_property_readonly("speed", [](const Fire& command) { return command.shot.speed_mps; })
      .def_readonly("until_landed", &Fire::until_landed);
  py::class_<Fill>(module, "Fill")
      .def_property_readonly("station", [](const Fill& command) { return command.call.station; })
      .def_property_readonly("store",
                             [](const Fill& command) { return std::string(to_string(command.call.store)); });
}

}  // namespace

void bind_commands(py::module_& module) {
  bind_drives(module);
  bind_gun(module);
  bind_ways(module);
}

}  // namespace outrider::python
