// Catching a moving target on a grid of costs.
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "arrays.hpp"
#include "bindings.hpp"
#include "faults.hpp"
#include "interruptible.hpp"
#include "options.hpp"
#include "outrider/io/map/pursuit_map.hpp"
#include "outrider/pursuit/catalog.hpp"
#include "outrider/pursuit/check.hpp"
#include "turn.hpp"

namespace outrider::python {

namespace py = pybind11;

namespace {

PursuitProblem make_problem(const py::handle& costs, std::uint32_t threshold, const py::handle& start,
                            const py::handle& target, int start_s) {
  auto grid = std::make_shared<CostGrid>();
  grid->cells = costs_of(costs, grid->frame, "costs");
  PursuitProblem problem{std::move(grid), threshold, cell_of(start, "start"), cell_list_of(target, "target"),
                         start_s};
  require(check(problem));
  return problem;
}

/// A view of the costs that keeps them alive.
py::array costs_view(const PursuitProblem& problem) {
  auto* const owner = new std::shared_ptr<const CostGrid>(problem.costs);
  const py::capsule alive(owner,
                          [](void* held) { delete static_cast<std::shared_ptr<const CostGrid>*>(held); });
  const CostGrid& grid = *problem.costs;
  py::array_t<std::uint32_t> view(
      {static_cast<py::ssize_t>(grid.frame.height), static_cast<py::ssize_t>(grid.frame.width)},
      grid.cells.data(), alive);
  py::detail::array_proxy(view.ptr())->flags &= ~py::detail::npy_api::NPY_ARRAY_WRITEABLE_;
  return view;
}

class Planner {
 public:
  Planner(const std::string& name, const py::kwargs& options)
      : row_(value_of(find_pursuit_planner(name))), configured_(row_.configure()) {
    set_options(configured_.options, options);
  }
  [[nodiscard]] const PursuitPlanner& row() const { return row_; }
  void set(const std::string& key, const py::handle& value) {
    const auto turn = turn_.take("planner");
    set_option(configured_.options, key, value);
  }
  [[nodiscard]] py::dict options() const { return options_dict(configured_.options); }
  PursuitPlan plan(const PursuitProblem& problem, std::optional<std::uint64_t> most_expansions) {
    const auto turn = turn_.take("planner");
    return value_of(interruptible([&](const std::stop_token& stop) {
      return configured_.plan(problem, budget_of(most_expansions, stop), workspace_);
    }));
  }

 private:
  PursuitPlanner row_;
  ConfiguredPursuitPlanner configured_;
  Workspace workspace_;
  Turn turn_;
};

py::dict guarantee_of(const Planner& planner) {
  const PursuitGuarantee& guarantee = planner.row().guarantee;
  py::dict result;
  result["complete"] = guarantee.complete;
  result["optimal"] = guarantee.optimal;
  result["sentence"] = std::string(guarantee.sentence);
  return result;
}

void bind_values(py::module_& module) {
  py::class_<PursuitProblem>(module, "PursuitProblem")
      .def(py::init(&make_problem), py::arg("costs"), py::kw_only(), py::arg("threshold"), py::arg("start"),
           py::arg("target"), py::arg("start_s") = 0)
      .def_static(
          "load", [](const py::handle& path) { return value_of(load_pursuit_map(path_text(path))); },
          py::arg("path"))
      .def_property_readonly("costs", &costs_view)
      .def_readonly("threshold", &PursuitProblem::threshold)
      .def_property_readonly(
          "start",
          [](const PursuitProblem& problem) { return py::make_tuple(problem.start.x, problem.start.y); })
      .def_property_readonly("target", [](const PursuitProblem& problem) { return array_of(problem.target); })
      .def_readonly("start_s", &PursuitProblem::start_s);
  py::class_<PursuitPlan>(module, "PursuitPlan")
      .def_property_readonly("path", [](const PursuitPlan& plan) { return array_of(plan.path); })
      .def_readonly("catch_time_s", &PursuitPlan::catch_time_s)
      .def_readonly("cost", &PursuitPlan::cost)
      .def_readonly("lower_bound", &PursuitPlan::lower_bound)
      .def_property_readonly("earliest_catch_s",
                             [](const PursuitPlan& plan) {
                               return plan.earliest_catch_s < 0 ? std::nullopt
                                                                : std::optional(plan.earliest_catch_s);
                             })
      .def_property_readonly("optimal", &PursuitPlan::optimal)
      .def_property_readonly("expansions", [](const PursuitPlan& plan) { return plan.counters.expansions; });
  module.def(
      "check", [](const PursuitPlan& plan, const PursuitProblem& problem) { require(check(plan, problem)); },
      py::arg("plan"), py::arg("problem"));
}

}  // namespace

void bind_pursuit(py::module_& module) {
  bind_values(module);
  py::class_<Planner>(module, "PursuitPlanner")
      .def(py::init<const std::string&, const py::kwargs&>())
      .def_property_readonly("name", [](const Planner& planner) { return std::string(planner.row().name); })
      .def_property_readonly("sentence",
                             [](const Planner& planner) { return std::string(planner.row().sentence); })
      .def_property_readonly("paper", [](const Planner& planner) { return std::string(planner.row().paper); })
      .def_property_readonly("guarantee", &guarantee_of)
      .def_property_readonly("options", &Planner::options)
      .def("set", &Planner::set, py::arg("option"), py::arg("value"))
      .def("plan", &Planner::plan, py::arg("problem"), py::kw_only(),
           py::arg("most_expansions") = py::none());
}

}  // namespace outrider::python
