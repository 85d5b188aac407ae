// Covering areas: polygons of numpy, tracks, and what is proven of them.
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
#include "outrider/jobs/cover/strokes/plan.hpp"
#include "outrider/path/pieces.hpp"

namespace outrider::python {

namespace py = pybind11;

namespace {

std::vector<Option> options_of(CoverProblem& problem) {
  return joined(joined(describe(problem), prefixed("tool_", describe(problem.tool))),
                prefixed("pace_", describe(problem.pace)));
}

std::vector<std::vector<Vec2>> polygons_of(const py::iterable& polygons, const char* name) {
  std::vector<std::vector<Vec2>> result;
  for (const py::handle polygon : polygons) result.push_back(points_of(polygon, name));
  return result;
}

std::unique_ptr<CoverProblem> make_problem(const py::handle& boundary, const py::iterable& holes,
                                           const py::iterable& others, const py::object& start,
                                           const py::kwargs& options) {
  auto problem = std::make_unique<CoverProblem>();
  problem->boundary = points_of(boundary, "boundary");
  problem->holes = polygons_of(holes, "holes");
  for (const py::handle other : others) problem->others.push_back({points_of(other, "others"), {}});
  if (!start.is_none()) problem->start = pose_of(start, "start");
  set_options(options_of(*problem), options);
  return problem;
}

/// A method with its options.
class Planner {
 public:
  Planner(const std::string& name, const py::kwargs& options) : row_(value_of(find_cover_method(name))) {
    set_options(describe(options_), options);
  }
  [[nodiscard]] const CoverMethod& row() const { return row_; }
  py::dict options() { return options_dict(describe(options_)); }
  [[nodiscard]] CoverPlan plan(const CoverProblem& problem,
                               std::optional<std::uint64_t> most_expansions) const {
    return value_of(interruptible([&](const std::stop_token& stop) {
      return row_.plan(problem, options_, budget_of(most_expansions, stop));
    }));
  }

 private:
  CoverMethod row_;
  CoverOptions options_;
};

CoverProof prove_plan(const CoverPlan& plan, const CoverProblem& problem) {
  return value_of(interruptible(
      [&](const std::stop_token& stop) { return prove_anew(plan, problem, budget_of({}, stop)); }));
}

void check_plan(const CoverPlan& plan, const CoverProblem& problem) {
  const CoverProof proof = prove_plan(plan, problem);
  if (!proof.complete) {
    refuse("the track leaves out more than it may; prove() lists the places", "plan");
  }
}

py::array_t<double> missed_of(const CoverProof& proof) {
  std::vector<double> numbers;
  for (const MissedPlace& place : proof.missed) {
    numbers.insert(numbers.end(), {place.at.x, place.at.y, place.area_m2});
  }
  return array_of_shape({static_cast<py::ssize_t>(proof.missed.size()), 3}, numbers.data());
}

void bind_values(py::module_& module) {
  CoverProblem defaults;
  py::class_<CoverProblem>(module, "CoverProblem", options_text(options_of(defaults)).c_str())
      .def(py::init(&make_problem), py::arg("boundary"), py::kw_only(), py::arg("holes") = py::tuple(),
           py::arg("others") = py::tuple(), py::arg("start") = py::none())
      .def_property_readonly("boundary",
                             [](const CoverProblem& problem) { return array_of(problem.boundary); })
      .def_property_readonly("holes",
                             [](const CoverProblem& problem) {
                               py::list holes;
                               for (const auto& hole : problem.holes) holes.append(array_of(hole));
                               return holes;
                             })
      .def_property_readonly("options",
                             [](CoverProblem& problem) { return options_dict(options_of(problem)); });
  py::class_<CoverPlan>(module, "CoverPlan")
      .def_readonly("method", &CoverPlan::method)
      .def_property_readonly("start", [](const CoverPlan& plan) { return array_of(plan.track.start); })
      .def_property_readonly(
          "waypoints",
          [](const CoverPlan& plan) {
            return array_of(points_along(plan.track.start.position, plan.track.pieces, radians(5.0)));
          })
      .def_property_readonly("length", [](const CoverPlan& plan) { return plan.sums.length_m; })
      .def_property_readonly("turned", [](const CoverPlan& plan) { return plan.sums.turned_rad; })
      .def_property_readonly("time", [](const CoverPlan& plan) { return plan.sums.time_s; })
      .def_readonly("order_bound", &CoverPlan::order_bound_s)
      .def_readonly("laps", &CoverPlan::laps)
      .def_readonly("lanes", &CoverPlan::lanes)
      .def_readonly("cells", &CoverPlan::cells);
  py::class_<CoverProof>(module, "CoverProof")
      .def_property_readonly("planned_fraction",
                             [](const CoverProof& proof) { return proof.planned.fraction; })
      .def_readonly("sure_fraction", &CoverProof::sure_fraction)
      .def_readonly("inner_fraction", &CoverProof::inner_fraction)
      .def_readonly("clearance", &CoverProof::clearance_m)
      .def_readonly("length_bound", &CoverProof::length_bound_m)
      .def_readonly("complete", &CoverProof::complete)
      .def_property_readonly("missed", &missed_of);
}

}  // namespace

void bind_cover(py::module_& module) {
  bind_values(module);
  CoverOptions options;
  py::class_<Planner>(module, "CoverPlanner", options_text(describe(options)).c_str())
      .def(py::init<const std::string&, const py::kwargs&>())
      .def_property_readonly("name", [](const Planner& planner) { return std::string(planner.row().name); })
      .def_property_readonly("sentence",
                             [](const Planner& planner) { return std::string(planner.row().sentence); })
      .def_property_readonly("guarantee",
                             [](const Planner& planner) { return std::string(planner.row().guarantee); })
      .def_property_readonly("options", &Planner::options)
      .def("plan", &Planner::plan, py::arg("problem"), py::kw_only(),
           py::arg("most_expansions") = py::none());
  module.def("prove", &prove_plan, py::arg("plan"), py::arg("problem"));
  module.def("check", &check_plan, py::arg("plan"), py::arg("problem"));
}

}  // namespace outrider::python
