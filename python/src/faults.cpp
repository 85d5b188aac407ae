#include "faults.hpp"

#include <string>

namespace outrider::python {

namespace py = pybind11;

void bind_faults() {
  py::register_exception_translator([](std::exception_ptr thrown) {
    try {
      if (thrown) std::rethrow_exception(std::move(thrown));
    } catch (const FaultError& error) {
      const py::object exception = py::module_::import("outrider._faults")
                                       .attr("exception_of")(std::string(to_string(error.fault.code)),
                                                             error.fault.sentence, error.fault.where);
      PyErr_SetObject(py::type::handle_of(exception).ptr(), exception.ptr());
    }
  });
}

}  // namespace outrider::python
