// The parts of the module.
#pragma once

#include <pybind11/pybind11.h>

namespace outrider::python {

void bind_catalogues(pybind11::module_& module);
void bind_commands(pybind11::module_& module);
void bind_cover(pybind11::module_& module);
/// Call it last.
void bind_docstrings(pybind11::module_& module);
void bind_guard(pybind11::module_& module);
void bind_log(pybind11::module_& module);
void bind_missions(pybind11::module_& module);
void bind_observations(pybind11::module_& module);
void bind_occupancy(pybind11::module_& module);
void bind_path(pybind11::module_& module);
void bind_pose_graph(pybind11::module_& module);
void bind_pursuit(pybind11::module_& module);
void bind_robot(pybind11::module_& module);
void bind_run(pybind11::module_& module);
void bind_slam(pybind11::module_& module);
void bind_world(pybind11::module_& module);

}  // namespace outrider::python
