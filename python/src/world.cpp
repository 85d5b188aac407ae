// Worlds of solids.
#include <fmt/format.h>
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <array>
#include <memory>
#include <string>
#include <utility>

#include "arrays.hpp"
#include "bindings.hpp"
#include "faults.hpp"
#include "options.hpp"
#include "outrider/io/map/world_file.hpp"
#include "outrider/path/from_world.hpp"
#include "outrider/world/collision_map.hpp"
#include "polygons.hpp"

namespace outrider::python {

namespace py = pybind11;

namespace {

World load(const py::handle& path) {
  LoadedWorld loaded = value_of(load_world(path_text(path)));
  for (const std::string& warning : loaded.warnings) {
    if (PyErr_WarnEx(PyExc_RuntimeWarning, warning.c_str(), 1) != 0) throw py::error_already_set();
  }
  return std::move(loaded.world);
}

py::array_t<double> bounds_array(const Box2& box) {
  const std::array<double, 4> numbers = {box.low.x, box.low.y, box.high.x, box.high.y};
  return array_of_shape({2, 2}, numbers.data());
}

/// For each solid: its name, kind and box as arrays.
py::dict solids_of(const World& world) {
  py::list names, kinds;
  std::vector<double> boxes;
  for (const Solid& solid : world.solids) {
    names.append(solid.name);
    kinds.append(std::string(kind(solid.shape)));
    const Box3 box = bounds(solid);
    boxes.insert(boxes.end(), {box.low.x, box.low.y, box.low.z, box.high.x, box.high.y, box.high.z});
  }
  py::dict result;
  result["name"] = names;
  result["kind"] = kinds;
  result["bounds"] = array_of_shape({static_cast<py::ssize_t>(world.solids.size()), 2, 3}, boxes.data());
  return result;
}

/// The outlines of what stands in the way of a robot of that height.
py::list outlines_of(const World& world, double height_m) {
  const CollisionMap ground = CollisionMap::of(world, height_m);
  py::list result;
  for (const RoundedPolygon& obstacle : ground.obstacles()) {
    py::dict one;
    one["corners"] = array_of(obstacle.core);
    one["radius"] = obstacle.radius_m;
    result.append(one);
  }
  return result;
}

py::array_t<double> clearances(const World& world, const py::handle& points, double height_m, double most_m) {
  const std::vector<Vec2> places = points_of(points, "points");
  const CollisionMap ground = CollisionMap::of(world, height_m);
  py::array_t<double> result(static_cast<py::ssize_t>(places.size()));
  double* at = result.mutable_data();
  const py::gil_scoped_release others_may_run;
  for (const Vec2 place : places) *at++ = ground.clearance(place, most_m);
  return result;
}

std::shared_ptr<GridMap> grid_of(const World& world, double radius_m, double resolution_m, double height_m) {
  GridOptions options;
  options.resolution_m = resolution_m;
  return std::make_shared<GridMap>(
      value_of(grid_from_world(CollisionMap::of(world, height_m), radius_m, GridModel::cells, options)));
}

}  // namespace

void bind_world(py::module_& module) {
  py::class_<World>(module, "World")
      .def_static("load", &load, py::arg("path"))
      .def_readonly("name", &World::name)
      .def_property_readonly("bounds", [](const World& world) { return bounds_array(world.bounds); })
      .def_property_readonly("solids", &solids_of)
      .def("outlines", &outlines_of, py::kw_only(), py::arg("height") = 0.2)
      .def("clearances", &clearances, py::arg("points"), py::kw_only(), py::arg("height") = 0.2,
           py::arg("most") = 10.0)
      .def("polygons", &polygons_of, py::arg("radius"), py::kw_only(), py::arg("height") = 0.2)
      .def("grid", &grid_of, py::arg("radius"), py::kw_only(), py::arg("resolution") = 0.1,
           py::arg("height") = 0.2);
}

}  // namespace outrider::python
