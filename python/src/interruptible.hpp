// Work that Ctrl-C can end.
#pragma once

#include <pybind11/pybind11.h>

#include <chrono>
#include <cstdint>
#include <future>
#include <optional>
#include <stop_token>

#include "outrider/core/budget.hpp"

namespace outrider::python {

/// Runs the work on a thread of its own, without the lock of the interpreter, until it ends or Ctrl-C asks it
/// to stop.
template <class Work>
auto interruptible(Work work) {
  std::stop_source stop;
  auto result = std::async(std::launch::async, work, stop.get_token());
  while (true) {
    {
      const pybind11::gil_scoped_release others_may_run;
      if (result.wait_for(std::chrono::milliseconds(20)) == std::future_status::ready) return result.get();
    }
    if (PyErr_CheckSignals() == 0) continue;
    stop.request_stop();
    {
      const pybind11::gil_scoped_release others_may_run;
      result.wait();
    }
    throw pybind11::error_already_set();
  }
}

/// Returns a budget of so many expansions; none: without a limit.
inline Budget budget_of(std::optional<std::uint64_t> most_expansions, std::stop_token stop = {}) {
  Budget budget;
  if (most_expansions) budget.expansions = *most_expansions;
  budget.stop = std::move(stop);
  return budget;
}

}  // namespace outrider::python
