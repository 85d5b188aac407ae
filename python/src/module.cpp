// The module outrider._outrider, of which the package outrider is made.
#include "bindings.hpp"
#include "faults.hpp"

PYBIND11_MODULE(_outrider, module) {
  pybind11::options options;
  options.disable_function_signatures();
  module.attr("__version__") = OUTRIDER_VERSION;
  outrider::python::bind_faults();
  outrider::python::bind_catalogues(module);
  outrider::python::bind_cover(module);
  outrider::python::bind_log(module);
  outrider::python::bind_occupancy(module);
  outrider::python::bind_path(module);
  outrider::python::bind_pose_graph(module);
  outrider::python::bind_pursuit(module);
  outrider::python::bind_run(module);
  outrider::python::bind_slam(module);
  outrider::python::bind_commands(module);
  outrider::python::bind_observations(module);
  outrider::python::bind_missions(module);
  outrider::python::bind_guard(module);
  outrider::python::bind_robot(module);
  outrider::python::bind_world(module);
  outrider::python::bind_docstrings(module);
}
