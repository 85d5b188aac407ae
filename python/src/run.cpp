// Runs of scenarios.
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <memory>
#include <optional>
#include <stop_token>
#include <string>
#include <utility>

#include "arrays.hpp"
#include "bindings.hpp"
#include "faults.hpp"
#include "interruptible.hpp"
#include "log.hpp"
#include "options.hpp"
#include "outrider/core/overload.hpp"
#include "outrider/io/scenario/scenario.hpp"
#include "outrider/job/write_run.hpp"
#include "outrider/jobs/catalog.hpp"
#include "scenario.hpp"

namespace outrider::python {

namespace py = pybind11;

namespace {

struct FinishedRun {
  Run run;
  std::string scenario;  ///< its text, with all options
};

std::shared_ptr<FinishedRun> run_scenario(const py::handle& scenario_path, std::optional<std::int64_t> seed,
                                          const py::dict& set) {
  const std::string path = path_text(scenario_path);
  const Job job = value_of(job_of_scenario(jobs(), path));
  const auto task = job.blank();
  require(read_scenario(*task, path));
  change_task(*task, seed, set);
  const std::string scenario = scenario_text(task->options());
  auto run = interruptible([&](const std::stop_token& stop) {
    RunWatch watch;
    watch.stop = stop;
    return run_task(job, *task, watch);
  });
  return std::make_shared<FinishedRun>(FinishedRun{value_of(std::move(run)), scenario});
}

template <class Value>
py::dict dict_of(const std::vector<std::pair<std::string, Value>>& pairs) {
  py::dict result;
  for (const auto& [name, value] : pairs) result[py::str(name)] = value;
  return result;
}

py::object table_value(const TableValue& value) {
  return std::visit(Overload{[](double number) -> py::object { return py::float_(number); },
                             [](const std::string& text) -> py::object { return py::str(text); },
                             [](Vec2 point) -> py::object { return py::make_tuple(point.x, point.y); },
                             [](const std::vector<Vec2>& points) -> py::object { return array_of(points); },
                             [](const std::vector<TableArc>& pieces) -> py::object {
                               std::vector<Vec2> ends;
                               for (const TableArc& piece : pieces) ends.push_back(piece.from);
                               if (!pieces.empty()) ends.push_back(pieces.back().to);
                               return array_of(ends);
                             }},
                    value);
}

/// Returns the tables by name, each with a list of values for each column.
py::dict tables_of(const FinishedRun& finished) {
  py::dict tables;
  for (const Table& table : finished.run.report.tables) {
    py::dict columns;
    for (std::size_t i = 0; i < table.columns.size(); ++i) {
      py::list values;
      for (const auto& row : table.rows) values.append(table_value(row[i]));
      columns[py::str(table.columns[i])] = values;
    }
    tables[py::str(table.name)] = columns;
  }
  return tables;
}

py::dict save(FinishedRun& finished, const py::handle& path) {
  const std::string folder = path_text(path);
  const std::vector<NamedContent> files = finished.run.files;
  RunLog log(folder, finished.scenario);
  finished.run.log.add_sink(log);
  auto written = write_run(finished.run, log, folder);
  finished.run.log.remove_sink(log);
  finished.run.files = files;
  return dict_of(value_of(std::move(written)));
}

}  // namespace

void bind_run(py::module_& module) {
  py::class_<FinishedRun, std::shared_ptr<FinishedRun>>(module, "Run")
      .def_property_readonly("status", [](const FinishedRun& finished) { return finished.run.report.status; })
      .def_property_readonly("job", [](const FinishedRun& finished) { return finished.run.report.job; })
      .def_property_readonly("reason", [](const FinishedRun& finished) { return finished.run.report.reason; })
      .def_property_readonly("warnings",
                             [](const FinishedRun& finished) { return finished.run.report.warnings; })
      .def_property_readonly("metrics",
                             [](const FinishedRun& finished) { return dict_of(finished.run.report.metrics); })
      .def_property_readonly(
          "settings", [](const FinishedRun& finished) { return dict_of(finished.run.report.settings); })
      .def_property_readonly("tables", &tables_of)
      .def_property_readonly("log", [](FinishedRun& finished) { return arrays_of(finished.run.log); })
      .def_property_readonly("result", [](const FinishedRun& finished) { return result_text(finished.run); })
      .def("save", &save, py::arg("folder"));
  module.def("run", &run_scenario, py::arg("scenario"), py::kw_only(), py::arg("seed") = py::none(),
             py::arg("set") = py::dict());
}

}  // namespace outrider::python
