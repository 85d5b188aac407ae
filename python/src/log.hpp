// Logs as structured arrays of numpy (outrider/log/numpy.hpp).
#pragma once

#include <pybind11/pybind11.h>

#include "outrider/log/log.hpp"

namespace outrider::python {

/// Returns the messages of a log by the names of their arrays, such as "pose" or "scan/ranges".
pybind11::dict arrays_of(Log& log);

}  // namespace outrider::python
