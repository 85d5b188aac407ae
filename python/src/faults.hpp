// Faults of Outrider as exceptions of Python: one class for each FaultCode, with sentence and where.
#pragma once

#include <pybind11/pybind11.h>

#include <string>
#include <utility>

#include "outrider/core/outcome.hpp"

namespace outrider::python {

/// A fault on its way to Python.
struct FaultError {
  Fault fault;
};

/// Raises BadInput: a sentence about the argument or key `where`, empty if it is about none.
[[noreturn]] inline void refuse(std::string sentence, std::string where) {
  throw FaultError{{FaultCode::bad_input, std::move(sentence), std::move(where)}};
}

/// Makes FaultError an exception of the classes in outrider/_faults.py.
void bind_faults();

/// Returns the value. Raises the fault if there is none.
template <class T>
T value_of(Outcome<T> outcome) {
  if (!outcome) throw FaultError{std::move(outcome.error())};
  return std::move(*outcome);
}
inline void require(const Status& status) {
  if (!status) throw FaultError{status.error()};
}

}  // namespace outrider::python
