// Robots, and missions, that are objects of Python.
#include "outrider/robot/robot.hpp"

#include <fmt/format.h>
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "bindings.hpp"
#include "faults.hpp"
#include "outrider/robot/mission.hpp"

namespace outrider::python {

namespace py = pybind11;

namespace {

/// A mission of Outrider tells itself what is wrong.
bool is_of_outrider(const py::object& object) {
  const py::handle type = py::type::handle_of(object);
  return std::string(py::str(type.attr("__module__"))) == "outrider._outrider";
}

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
    if (!error.matches(PyExc_Exception) || is_of_outrider(object))
      throw;  // such as KeyboardInterrupt, NoPath
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

}  // namespace

void bind_robot(py::module_& module) {
  module.def("run_mission", &run, py::arg("mission"), py::arg("robot"), py::kw_only(),
             py::arg("most_steps") = py::none());
}

}  // namespace outrider::python
