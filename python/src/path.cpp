// Grid maps, path planners and check().
#include <fmt/format.h>
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "arrays.hpp"
#include "bindings.hpp"
#include "faults.hpp"
#include "interruptible.hpp"
#include "options.hpp"
#include "outrider/path/catalog.hpp"
#include "outrider/path/check.hpp"
#include "polygons.hpp"
#include "turn.hpp"

namespace outrider::python {

namespace py = pybind11;

namespace {

using SharedMap = std::shared_ptr<GridMap>;

SharedMap make_map(const py::array& blocked, double resolution_m, const py::handle& origin,
                   const std::string& model) {
  Grid<std::uint8_t> grid;
  grid.frame.resolution_m = resolution_m;
  grid.frame.origin = point_of(origin, "origin");
  if (model != "cells" && model != "corners") {
    refuse(fmt::format("'{}' is no model; give cells or corners", model), "model");
  }
  grid.cells = cells_of(blocked, grid.frame);
  require(check_frame(grid.frame));
  return std::make_shared<GridMap>(
      value_of(GridMap::of(grid, model == "cells" ? GridModel::cells : GridModel::corners)));
}

/// A view of the marks of the cells, without the border; it keeps the map alive.
py::array marks_of(const SharedMap& map) {
  py::array_t<std::uint8_t> view(
      {static_cast<py::ssize_t>(map->frame.height), static_cast<py::ssize_t>(map->frame.width)},
      {static_cast<py::ssize_t>(map->stride), py::ssize_t{1}}, map->marks.data() + map->index({0, 0}),
      py::cast(map));
  py::detail::array_proxy(view.ptr())->flags &= ~py::detail::npy_api::NPY_ARRAY_WRITEABLE_;
  return view;
}

SharedPolygons make_polygons(const py::handle& boundary, const py::iterable& obstacles, double radius_m) {
  std::vector<std::vector<Vec2>> rings;
  for (const py::handle& ring : obstacles) rings.push_back(points_of(ring, "obstacles"));
  return std::make_shared<PolygonGround>(
      value_of(PolygonGround::of(points_of(boundary, "boundary"), std::move(rings), radius_m)));
}

/// A ground, and the robot if the ground is a World.
struct Ground {
  py::object map;
  std::optional<double> radius_m;
  double height_m;
};

/// A problem on a GridMap, a PolygonMap, or a World as polygons.
Problem problem_on(const Ground& ground, Vec2 start, Vec2 goal) {
  const py::object& map = ground.map;
  if (py::isinstance<World>(map)) {
    if (!ground.radius_m) refuse("missing; give that of the robot, m, to plan on a World", "radius");
    return {nullptr, start, goal, polygons_of(map.cast<const World&>(), *ground.radius_m, ground.height_m)};
  }
  if (ground.radius_m) {
    refuse("the map has the robot's radius already; give one only with a World", "radius");
  }
  if (py::isinstance<GridMap>(map)) return {map.cast<SharedMap>(), start, goal};
  if (py::isinstance<PolygonGround>(map)) return {nullptr, start, goal, map.cast<SharedPolygons>()};
  refuse(fmt::format("{} is no ground; give a GridMap, a PolygonMap or a World", Py_TYPE(map.ptr())->tp_name),
         "map");
}

/// A planner with its options and its memory.
class Planner {
 public:
  Planner(const std::string& name, const py::kwargs& options)
      : row_(value_of(find_path_planner(name))), configured_(row_.configure()) {
    for (const auto& [key, value] : options) set(py::str(key), value);
  }

  [[nodiscard]] const PathPlanner& row() const { return row_; }
  void set(const std::string& key, const py::handle& value) {
    const auto turn = turn_.take("planner");
    set_option(configured_.options, key, value);
  }
  py::dict options() { return options_dict(configured_.options); }

  Plan plan(const Ground& ground, const py::handle& start, const py::handle& goal,
            std::optional<std::uint64_t> most_expansions, Trace* trace) {
    const Problem problem = problem_on(ground, point_of(start, "start"), point_of(goal, "goal"));
    const auto turn = turn_.take("planner");
    const py::gil_scoped_release others_may_run;
    workspace_.trace = trace;
    auto plan = configured_.plan(problem, budget_of(most_expansions), workspace_);
    workspace_.trace = nullptr;
    return value_of(std::move(plan));
  }

  /// The cost of each query: NaN where it is proven that there is no path.
  py::array_t<double> costs(const py::object& map, const py::handle& starts, const py::handle& goals,
                            std::optional<double> radius_m, double height_m) {
    const std::vector<Vec2> from = points_of(starts, "starts"), to = points_of(goals, "goals");
    if (from.size() != to.size()) {
      refuse(fmt::format("{} goals for {} starts; give one for each", to.size(), from.size()), "goals");
    }
    py::array_t<double> result(static_cast<py::ssize_t>(from.size()));
    double* const costs = result.mutable_data();
    Problem problem = problem_on({map, radius_m, height_m}, {}, {});
    const auto turn = turn_.take("planner");
    const py::gil_scoped_release others_may_run;
    for (std::size_t i = 0; i < from.size(); ++i) {
      problem.start = from[i];
      problem.goal = to[i];
      auto plan = configured_.plan(problem, {}, workspace_);
      if (!plan && plan.error().code != FaultCode::no_path) {
        plan.error().where = fmt::format("query {}", i);
        throw FaultError{std::move(plan.error())};
      }
      costs[i] = plan ? plan->cost : std::numeric_limits<double>::quiet_NaN();
    }
    return result;
  }

 private:
  PathPlanner row_;
  ConfiguredPlanner configured_;
  Workspace workspace_;
  Turn turn_;
};

py::tuple plan_with_trace(Planner& planner, const py::object& map, const py::handle& start,
                          const py::handle& goal, std::optional<double> radius_m, double height_m,
                          std::optional<std::uint64_t> most_expansions) {
  Trace trace;
  Plan plan = planner.plan({map, radius_m, height_m}, start, goal, most_expansions, &trace);
  return py::make_tuple(
      std::move(plan),
      py::array_t<Expansion>(static_cast<py::ssize_t>(trace.expansions.size()), trace.expansions.data()));
}

py::dict guarantee_of(const Planner& planner) {
  const Guarantee& guarantee = planner.row().guarantee;
  py::dict result;
  result["complete"] = guarantee.complete;
  result["most_ratio"] = guarantee.most_ratio;
  result["sentence"] = std::string(guarantee.sentence);
  return result;
}

void bind_map(py::module_& module) {
  py::class_<GridMap, SharedMap>(module, "GridMap")
      .def(py::init(&make_map), py::arg("blocked"), py::kw_only(), py::arg("resolution") = 1.0,
           py::arg("origin") = py::make_tuple(0.0, 0.0), py::arg("model") = "cells")
      .def_property_readonly(
          "shape", [](const GridMap& map) { return py::make_tuple(map.frame.height, map.frame.width); })
      .def_property_readonly("resolution", [](const GridMap& map) { return map.frame.resolution_m; })
      .def_property_readonly(
          "origin", [](const GridMap& map) { return py::make_tuple(map.frame.origin.x, map.frame.origin.y); })
      .def_property_readonly("model", [](const GridMap& map) { return std::string(to_string(map.model)); })
      .def_property_readonly("marks", &marks_of);
}

void bind_polygons(py::module_& module) {
  py::class_<PolygonGround, SharedPolygons>(module, "PolygonMap")
      .def(py::init(&make_polygons), py::arg("boundary"), py::kw_only(), py::arg("obstacles") = py::tuple(),
           py::arg("radius") = 0.18)
      .def_property_readonly("boundary",
                             [](const PolygonGround& ground) { return array_of(ground.boundary); })
      .def_property_readonly("obstacles",
                             [](const PolygonGround& ground) {
                               py::list rings;
                               for (const auto& ring : ground.obstacles) rings.append(array_of(ring));
                               return rings;
                             })
      .def_readonly("radius", &PolygonGround::radius_m);
}

void bind_plan(py::module_& module) {
  PYBIND11_NUMPY_DTYPE(Expansion, state, parent, f, g, h);
  py::class_<Plan>(module, "Plan")
      .def_property_readonly("waypoints", [](const Plan& plan) { return array_of(plan.waypoints); })
      .def_readonly("cost", &Plan::cost)
      .def_readonly("lower_bound", &Plan::lower_bound)
      .def_property_readonly("length", [](const Plan& plan) { return length_of(plan); })
      .def_property_readonly("expansions", [](const Plan& plan) { return plan.counters.expansions; });
  module.def(
      "check",
      [](const Plan& plan, const py::object& map, const py::handle& start, const py::handle& goal,
         std::optional<double> radius_m, double height_m) {
        require(check(
            plan, problem_on({map, radius_m, height_m}, point_of(start, "start"), point_of(goal, "goal"))));
      },
      py::arg("plan"), py::arg("map"), py::arg("start"), py::arg("goal"), py::kw_only(),
      py::arg("radius") = py::none(), py::arg("height") = 0.2);
}

}  // namespace

void bind_path(py::module_& module) {
  bind_map(module);
  bind_polygons(module);
  bind_plan(module);
  py::class_<Planner>(module, "PathPlanner")
      .def(py::init<const std::string&, const py::kwargs&>())
      .def_property_readonly("name", [](const Planner& planner) { return std::string(planner.row().name); })
      .def_property_readonly("sentence",
                             [](const Planner& planner) { return std::string(planner.row().sentence); })
      .def_property_readonly("paper", [](const Planner& planner) { return std::string(planner.row().paper); })
      .def_property_readonly("guarantee", &guarantee_of)
      .def_property_readonly("options", &Planner::options)
      .def("set", &Planner::set, py::arg("option"), py::arg("value"))
      .def(
          "plan",
          [](Planner& planner, const py::object& map, const py::handle& start, const py::handle& goal,
             std::optional<double> radius_m, double height_m, std::optional<std::uint64_t> most_expansions) {
            return planner.plan({map, radius_m, height_m}, start, goal, most_expansions, nullptr);
          },
          py::arg("map"), py::arg("start"), py::arg("goal"), py::kw_only(), py::arg("radius") = py::none(),
          py::arg("height") = 0.2, py::arg("most_expansions") = py::none())
      .def("trace", &plan_with_trace, py::arg("map"), py::arg("start"), py::arg("goal"), py::kw_only(),
           py::arg("radius") = py::none(), py::arg("height") = 0.2, py::arg("most_expansions") = py::none())
      .def("costs", &Planner::costs, py::arg("map"), py::arg("starts"), py::arg("goals"), py::kw_only(),
           py::arg("radius") = py::none(), py::arg("height") = 0.2);
}

}  // namespace outrider::python
