// Scenarios as tasks of a job, with options set by key.
#pragma once

#include <fmt/format.h>
#include <pybind11/pybind11.h>

#include <memory>
#include <optional>
#include <string>

#include "faults.hpp"
#include "options.hpp"
#include "outrider/job/run_job.hpp"
#include "outrider/jobs/catalog.hpp"

namespace outrider::python {

/// Sets the seed, if there is one, and the options by their keys.
inline void change_task(JobTask& task, std::optional<std::int64_t> seed, const pybind11::dict& set) {
  Changes changes;
  if (seed) changes.emplace_back("seed", std::to_string(*seed));
  for (const auto& [key, value] : set) changes.emplace_back(pybind11::str(key), option_text(value));
  require(change(task, changes));
}

/// Reads and loads a scenario of that job. Repairs of the input become a RuntimeWarning.
template <class Task>
std::unique_ptr<Task> load_task_of(const pybind11::handle& path, std::optional<std::int64_t> seed,
                                   const pybind11::dict& set) {
  auto task = std::make_unique<Task>();
  const Job job = value_of(job_of_scenario(jobs(), path_text(path)));
  if (job.name != task->job) {
    refuse(fmt::format("it is a scenario of the job {}; give one of {}", job.name, task->job), "scenario");
  }
  require(read_scenario(*task, path_text(path)));
  change_task(*task, seed, set);
  for (const std::string& warning : value_of(task->load())) {
    if (PyErr_WarnEx(PyExc_RuntimeWarning, warning.c_str(), 1) != 0) throw pybind11::error_already_set();
  }
  return task;
}

}  // namespace outrider::python
