// Missions, and robots that are objects of Python.
#include "outrider/robot/robot.hpp"

#include <fmt/format.h>
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <cmath>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "arrays.hpp"
#include "bindings.hpp"
#include "faults.hpp"
#include "occupancy.hpp"
#include "options.hpp"
#include "outrider/jobs/cover/mission.hpp"
#include "outrider/jobs/cover/plan.hpp"
#include "outrider/jobs/explore/mission.hpp"
#include "outrider/robot/mission.hpp"
#include "turn.hpp"

namespace outrider::python {

namespace py = pybind11;

namespace {

/// Calls a method of an object of Python, whose failure is raised as RobotFailed with its cause.
template <class Result, class... Arguments>
Result call(const py::object& object, const char* method, Arguments&&... arguments) {
  const std::string name = py::str(py::type::handle_of(object).attr("__name__"));
  const py::object failed = py::module_::import("outrider._faults").attr("RobotFailed");
  const std::string sentence = fmt::format("{}.{}() failed", name, method);
  try {
    const py::object result = object.attr(method)(std::forward<Arguments>(arguments)...);
    try {
      if constexpr (!std::is_void_v<Result>)
        return result.template cast<Result>();
      else
        return;
    } catch (const py::cast_error&) {
      const std::string given = py::str(py::type::handle_of(result).attr("__name__"));
      PyErr_SetString(failed.ptr(),
                      fmt::format("{}.{}() gave {}, which is no {}", name, method, given,
                                  std::string_view(method) == "sense" ? "Observation" : "command")
                          .c_str());
    }
  } catch (py::error_already_set& error) {
    if (!error.matches(PyExc_Exception)) throw;  // such as KeyboardInterrupt
    const std::string cause = py::str(error.value());
    const std::string kind = py::str(error.type().attr("__name__"));
    py::raise_from(error, failed.ptr(), fmt::format("{}: {}: {}", sentence, kind, cause).c_str());
  }
  throw py::error_already_set();
}

class PythonRobot final : public Robot {
 public:
  explicit PythonRobot(py::object robot) : robot_(std::move(robot)) {}
  Observation sense() override { return call<Observation>(robot_, "sense"); }
  void act(const Command& command) override { call<void>(robot_, "act", py::cast(command)); }

 private:
  py::object robot_;
};

struct PythonMission {
  py::object mission;
  std::optional<Command> step(const Observation& seen) {
    return call<std::optional<Command>>(mission, "step", py::cast(seen));
  }
};

int run(const py::object& mission, const py::object& robot, std::optional<int> most_steps) {
  PythonMission steps{mission};
  PythonRobot port(robot);
  int count = 0;
  std::stop_source stop;
  run_mission(steps, port, stop.get_token(), [&](const Observation&, const Command* command) {
    if (command == nullptr) return;
    if (most_steps && count >= *most_steps)
      stop.request_stop();
    else
      ++count;
  });
  return count;
}

Observation make_observation(double time_s, const py::handle& odometry, const std::optional<LaserScan>& scan,
                             bool touching, std::optional<double> touch_rad) {
  if (!std::isfinite(time_s)) {
    throw FaultError{{FaultCode::bad_input, fmt::format("{} is no time; give seconds", time_s), "time"}};
  }
  Observation seen{time_s, pose_of(odometry, "odometry")};
  seen.scan = scan;
  seen.touching = touching;
  seen.touch_rad = touch_rad;
  return seen;
}

/// An exploration that one thread steps at a time.
class Exploration {
 public:
  Exploration(const py::handle& start, const py::kwargs& values) : mission_(begun(start, values)) {}

  std::optional<Command> step(const Observation& seen) {
    const auto turn = turn_.take("mission");
    const py::gil_scoped_release others_may_run;
    return mission_.step(seen);
  }
  template <class Read>
  auto read(Read what) {
    const auto turn = turn_.take("mission");
    return what(mission_);
  }

 private:
  static ExploreMission begun(const py::handle& start, const py::kwargs& values) {
    ExploreTask task;
    task.start = pose_of(start, "start");
    std::vector<Option> options = joined(describe(task.explore), describe(task.rules));
    options = joined(std::move(options), prefixed("robot_", describe(task.robot)));
    options = joined(std::move(options), prefixed("slam_", describe(task.slam)));
    options = joined(std::move(options), prefixed("map_", describe(task.slam.map)));
    set_options(options, values);
    return value_of(begin(task));
  }

  ExploreMission mission_;
  Turn turn_;
};

void bind_commands(py::module_& module) {
  py::class_<Observation>(module, "Observation", "What a robot senses.")
      .def(py::init(&make_observation), py::kw_only(), py::arg("time"), py::arg("odometry"),
           py::arg("scan") = py::none(), py::arg("touching") = false, py::arg("touch") = py::none())
      .def_readonly("time", &Observation::time_s)
      .def_property_readonly("odometry", [](const Observation& seen) { return array_of(seen.odometry); })
      .def_readonly("scan", &Observation::scan)
      .def_readonly("touching", &Observation::touching);
  py::class_<DriveTwist>(module, "DriveTwist", "Drive with a constant twist until a time, then sense again.")
      .def(py::init([](double ahead, double left, double turn, double until) {
             return DriveTwist{{ahead, left, turn}, until};
           }),
           py::kw_only(), py::arg("ahead"), py::arg("left") = 0.0, py::arg("turn") = 0.0, py::arg("until"))
      .def_property_readonly("ahead", [](const DriveTwist& command) { return command.twist.ahead_mps; })
      .def_property_readonly("left", [](const DriveTwist& command) { return command.twist.left_mps; })
      .def_property_readonly("turn", [](const DriveTwist& command) { return command.twist.turn_radps; })
      .def_readonly("until", &DriveTwist::until_s);
  py::class_<FollowPiece>(module, "FollowPiece", "Turn towards a leg or an arc, pause, and drive along it.")
      .def_property_readonly("from_point",
                             [](const FollowPiece& command) {
                               return py::make_tuple(command.piece.from.x, command.piece.from.y);
                             })
      .def_property_readonly(
          "to_point",
          [](const FollowPiece& command) { return py::make_tuple(command.piece.to.x, command.piece.to.y); })
      .def_property_readonly("turn", [](const FollowPiece& command) { return command.piece.turn_rad; })
      .def_property_readonly("backward", [](const FollowPiece& command) { return command.piece.backward; })
      .def_readonly("pause", &FollowPiece::pause_s);
  py::class_<Wait>(module, "Wait", "Stand still until a time.")
      .def(py::init([](double until) { return Wait{until}; }), py::kw_only(), py::arg("until"))
      .def_readonly("until", &Wait::until_s);
}

}  // namespace

void bind_robot(py::module_& module) {
  bind_commands(module);
  py::class_<CoverMission>(module, "CoverMission", "Drives the track of a plan, piece by piece.")
      .def(py::init([](const CoverPlan& plan, double pause) { return CoverMission(plan.track, pause); }),
           py::arg("plan"), py::kw_only(), py::arg("pause") = 0.0)
      .def("step", &CoverMission::step, py::arg("observation"));
  py::class_<Exploration>(module, "ExploreMission", "Maps a building that nobody knows, and comes home.")
      .def(py::init<const py::handle&, const py::kwargs&>(), py::arg("start") = py::make_tuple(0.0, 0.0, 0.0))
      .def("step", &Exploration::step, py::arg("observation"))
      .def_property_readonly(
          "pose", [](Exploration& m) { return m.read([](ExploreMission& e) { return array_of(e.pose); }); })
      .def_property_readonly(
          "stop_reason",
          [](Exploration& m) { return m.read([](ExploreMission& e) { return e.stop_reason; }); })
      .def_property_readonly(
          "reason", [](Exploration& m) { return m.read([](ExploreMission& e) { return e.reason; }); })
      .def_property_readonly("home",
                             [](Exploration& m) { return m.read([](ExploreMission& e) { return e.home; }); })
      .def_property_readonly("map", [](Exploration& m) {
        return m.read(
            [](ExploreMission& e) { return std::make_shared<Grid<std::uint8_t>>(explored_map(e)); });
      });
  module.def("run_mission", &run, py::arg("mission"), py::arg("robot"), py::kw_only(),
             py::arg("most_steps") = py::none(),
             "Senses, steps and acts until the mission is over, and returns the number of commands.");
}

}  // namespace outrider::python
