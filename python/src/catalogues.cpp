// The catalogues: what there is to choose from, each row with its sentence, source, guarantee and options.
#include <pybind11/pybind11.h>

#include <string>
#include <string_view>

#include "bindings.hpp"
#include "options.hpp"
#include "outrider/job/run_job.hpp"
#include "outrider/jobs/catalog.hpp"
#include "outrider/jobs/cover/strokes/plan.hpp"
#include "outrider/jobs/explore/choose/catalog.hpp"
#include "outrider/jobs/guard/catalog.hpp"
#include "outrider/path/catalog.hpp"
#include "outrider/pursuit/catalog.hpp"

namespace outrider::python {

namespace py = pybind11;

namespace {

py::dict row_of(std::string_view sentence, std::string_view source, std::string_view guarantee,
                const std::vector<Option>& options) {
  py::dict row, help;
  for (const Option& option : options) help[py::str(option.name)] = sentence_of(option);
  row["sentence"] = py::str(std::string(sentence));
  row["source"] = py::str(std::string(source));
  row["guarantee"] = py::str(std::string(guarantee));
  row["options"] = options_dict(options);
  row["help"] = help;
  return row;
}

/// The row with the defaults of an options struct, which all rows of a catalogue share.
template <class Options>
py::dict row_with(std::string_view sentence, std::string_view source, std::string_view guarantee) {
  Options options;
  return row_of(sentence, source, guarantee, describe(options));
}

py::dict row_of(const Job& job) {
  const auto task = job.blank();
  std::vector<Option> options;
  for (const OptionGroup& group : task->options()) {
    for (Option option : group.options) {
      option.name = key_of(group, option);
      options.push_back(option);
    }
  }
  return row_of(job.sentence, "", "", options);
}

/// Defines a function that returns the rows by name.
template <class Rows, class RowOf>
void bind_catalogue(py::module_& module, const char* name, const Rows& rows, RowOf make) {
  module.def(name, [&rows, make] {
    py::dict result;
    for (const auto& row : rows) result[py::str(std::string(row.name))] = make(row);
    return result;
  });
}

}  // namespace

void bind_catalogues(py::module_& module) {
  const auto configured = [](const auto& row) {
    const auto planner = row.configure();
    return row_of(row.sentence, row.paper, row.guarantee.sentence, planner.options);
  };
  bind_catalogue(module, "path_planners", path_planners(), configured);
  bind_catalogue(module, "pursuit_planners", pursuit_planners(), configured);
  bind_catalogue(module, "cover_methods", cover_methods(), [](const CoverMethod& row) {
    return row_with<CoverOptions>(row.sentence, row.paper, row.guarantee);
  });
  bind_catalogue(module, "explore_strategies", explore_strategies(), [](const ExploreStrategy& row) {
    return row_with<ExploreOptions>(row.sentence, row.paper, row.guarantee);
  });
  bind_catalogue(module, "guard_planners", guard_planners(), [](const GuardPlanner& row) {
    return row_with<GuardOptions>(row.sentence, row.source, row.guarantee);
  });
  bind_catalogue(module, "jobs", jobs(), [](const Job& job) { return row_of(job); });
}

}  // namespace outrider::python
