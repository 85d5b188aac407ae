// Occupancy grids and their frontiers.
#include "occupancy.hpp"

#include <fmt/format.h>
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <algorithm>
#include <optional>
#include <utility>

#include "arrays.hpp"
#include "bindings.hpp"
#include "faults.hpp"
#include "mapper.hpp"
#include "options.hpp"
#include "outrider/jobs/explore/map/frontier.hpp"
#include "outrider/path/grid/grid_map.hpp"
#include "outrider/world/occupancy.hpp"

namespace outrider::python {

namespace py = pybind11;

namespace {

SharedOccupancy make_grid(const py::array& cells, double resolution_m, const py::handle& origin) {
  auto grid = std::make_shared<Grid<std::uint8_t>>();
  grid->frame.resolution_m = resolution_m;
  grid->frame.origin = point_of(origin, "origin");
  grid->cells = cells_of(cells, grid->frame);
  require(check_frame(grid->frame));
  const auto wrong = std::find_if(grid->cells.begin(), grid->cells.end(),
                                  [](std::uint8_t cell) { return cell > unknown_cell; });
  if (wrong != grid->cells.end()) {
    refuse(fmt::format("{} is no state of a cell; give 0 (free), 1 (occupied) or 2 (unknown)", *wrong),
           "cells");
  }
  return grid;
}

/// A frontier map that one thread uses at a time.
class Frontiers {
 public:
  Frontiers(double radius_m, const py::kwargs& options) : map_(made(radius_m, options)) {}

  void update(const SharedOccupancy& grid) {
    const auto turn = turn_.take("map");
    const py::gil_scoped_release others_may_run;
    map_.update(*grid, {.redrawn = true, .cells = {}});
    mapper_ = 0;
  }
  /// Takes what has changed of the map since the last time; nothing is copied.
  void follow(Laser& mapper) {
    const auto turn = turn_.take("map");
    mapper.with([&](LaserSlam& slam) {
      const bool goes_on = std::exchange(mapper_, mapper.id) == mapper.id;
      const std::uint64_t before = std::exchange(version_, mapper.changes.version());
      map_.update(slam.map().occupancy(), goes_on ? mapper.changes.since(before) : MapUpdate{true, {}});
    });
  }

  [[nodiscard]] py::list frontiers() {
    const auto turn = turn_.take("map");
    py::list result;
    for (const auto& [id, frontier] : map_.frontiers()) {
      std::vector<Vec2> points;
      for (const std::uint32_t cell : frontier.cells) {
        points.push_back(map_.frame().centre(map_.frame().cell(cell)));
      }
      py::dict one;
      one["id"] = id;
      one["points"] = array_of(points);
      one["centroid"] = py::make_tuple(frontier.centroid.x, frontier.centroid.y);
      one["group"] = frontier.group;
      result.append(one);
    }
    return result;
  }

  [[nodiscard]] std::shared_ptr<GridMap> ground() {
    const auto turn = turn_.take("map");
    return std::const_pointer_cast<GridMap>(map_.ground().grid());
  }

 private:
  static FrontierMap made(double radius_m, const py::kwargs& values) {
    if (!(radius_m > 0.0 && radius_m <= 100.0)) {
      refuse(fmt::format("{} is no radius; give 0 to 100 m", radius_m), "radius");
    }
    FrontierOptions options;
    set_options(describe(options), values);
    return {options, radius_m};
  }

  FrontierMap map_;
  std::uint64_t mapper_ = 0;   // whose map it follows
  std::uint64_t version_ = 0;  // of that map
  Turn turn_;
};

}  // namespace

void bind_occupancy(py::module_& module) {
  py::class_<Grid<std::uint8_t>, SharedOccupancy>(module, "OccupancyGrid")
      .def(py::init(&make_grid), py::arg("cells"), py::kw_only(), py::arg("resolution") = 0.05,
           py::arg("origin") = py::make_tuple(0.0, 0.0))
      .def_property_readonly("cells",
                             [](const SharedOccupancy& grid) { return view_of(*grid, py::cast(grid)); })
      .def_property_readonly("resolution",
                             [](const Grid<std::uint8_t>& grid) { return grid.frame.resolution_m; })
      .def_property_readonly("origin",
                             [](const Grid<std::uint8_t>& grid) {
                               return py::make_tuple(grid.frame.origin.x, grid.frame.origin.y);
                             })
      .def("ground", [](const Grid<std::uint8_t>& grid) {
        return std::make_shared<GridMap>(value_of(GridMap::of(grid, GridModel::cells)));
      });
  FrontierOptions options;
  py::class_<Frontiers>(module, "FrontierMap", options_text(describe(options)).c_str())
      .def(py::init<double, const py::kwargs&>(), py::arg("radius"))
      .def("update", &Frontiers::update, py::arg("grid").none(false))
      .def("update", &Frontiers::follow, py::arg("grid").none(false))
      .def_property_readonly("frontiers", &Frontiers::frontiers)
      .def_property_readonly("ground", &Frontiers::ground);
}

}  // namespace outrider::python
