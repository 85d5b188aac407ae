// The catalogues: what there is to choose from, each row with its sentence, source, guarantee and options.
#include <pybind11/pybind11.h>

#include <string>
#include <string_view>

#include "bindings.hpp"
#include "options.hpp"
#include "outrider/job/run_job.hpp"
#include "outrider/jobs/catalog.hpp"
#include "outrider/jobs/cover/plan.hpp"
#include "outrider/jobs/explore/catalog.hpp"
#include "outrider/jobs/guard/catalog.hpp"
#include "outrider/path/catalog.hpp"
#include "outrider/pursuit/catalog.hpp"

namespace outrider::python {

namespace py = pybind11;

namespace {

py::dict row_of(std::string_view sentence, std::string_view source, std::string_view guarantee,
                py::dict options) {
  py::dict row;
  row["sentence"] = py::str(std::string(sentence));
  row["source"] = py::str(std::string(source));
  row["guarantee"] = py::str(std::string(guarantee));
  row["options"] = std::move(options);
  return row;
}

/// Defines a function that returns the rows by name.
template <class Rows, class RowOf>
void bind_catalogue(py::module_& module, const char* name, const char* sentence, const Rows& rows,
                    RowOf make) {
  module.def(
      name,
      [&rows, make] {
        py::dict result;
        for (const auto& row : rows) result[py::str(std::string(row.name))] = make(row);
        return result;
      },
      sentence);
}

/// The defaults of an options struct, which all rows of a catalogue share.
template <class Options>
py::dict defaults() {
  Options options;
  return options_dict(describe(options));
}

py::dict options_of(const Job& job) {
  const auto task = job.blank();
  std::vector<Option> options;
  for (const OptionGroup& group : task->options()) {
    for (Option option : group.options) {
      option.name = key_of(group, option);
      options.push_back(option);
    }
  }
  return options_dict(options);
}

}  // namespace

void bind_catalogues(py::module_& module) {
  const auto configured = [](const auto& row) {
    return row_of(row.sentence, row.paper, row.guarantee.sentence, options_dict(row.configure().options));
  };
  bind_catalogue(module, "path_planners", "Returns the path planners by name.", path_planners(), configured);
  bind_catalogue(module, "pursuit_planners", "Returns the pursuit planners by name.", pursuit_planners(),
                 configured);
  bind_catalogue(module, "cover_methods", "Returns the methods of covering an area by name.", cover_methods(),
                 [](const CoverMethod& row) {
                   return row_of(row.sentence, row.paper, row.guarantee, defaults<CoverOptions>());
                 });
  bind_catalogue(module, "explore_strategies", "Returns the strategies of exploration by name.",
                 explore_strategies(), [](const ExploreStrategy& row) {
                   return row_of(row.sentence, row.paper, row.guarantee, defaults<ExploreOptions>());
                 });
  bind_catalogue(module, "guard_planners", "Returns the guard planners by name.", guard_planners(),
                 [](const GuardPlanner& row) {
                   return row_of(row.sentence, row.source, row.guarantee, defaults<GuardOptions>());
                 });
  bind_catalogue(module, "jobs", "Returns the jobs by name.", jobs(),
                 [](const Job& job) { return row_of(job.sentence, "", "", options_of(job)); });
}

}  // namespace outrider::python
