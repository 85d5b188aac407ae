// Gives the docstrings of the stub, outrider/_outrider.pyi, to the classes, properties and functions that
// run.
#include <fmt/format.h>
#include <pybind11/pybind11.h>

#include <cstdlib>
#include <cstring>
#include <string>
#include <string_view>

#include "bindings.hpp"

namespace outrider::python {

namespace py = pybind11;

namespace {

struct Docstring {
  const char* name;  ///< such as "GridMap.shape"
  const char*
      signature;  ///< such as "load(path)", a line for each overload; empty for classes and properties
  const char* text;
};

constexpr Docstring docstrings[] = {
#include "docstrings.inc"
};

/// Appends the list of options, which is the docstring that a class or a function has so far.
std::string with_options(const std::string& text, const char* options) {
  return options == nullptr || *options == '\0' ? text : fmt::format("{}\n\n{}", text, options);
}

/// Functions of C have the signature in front of their text; inspect.signature() reads it there. pybind11
/// frees the text of a function with std::free().
void set_text(PyObject* function, const Docstring& docstring) {
  const bool overloaded = std::strchr(docstring.signature, '\n') != nullptr;
  const bool is_made = *docstring.text == '\0';
  PyMethodDef* const method = reinterpret_cast<PyCFunctionObject*>(function)->m_ml;
  const std::string text =
      with_options(fmt::format("{}{}{}", docstring.signature, overloaded ? "\n\n" : "\n--\n\n",
                               is_made ? "The class says what is made." : docstring.text),
                   method->ml_doc);
  std::free(const_cast<char*>(method->ml_doc));
  method->ml_doc = ::strdup(text.c_str());
}

void set_class_text(const py::object& type, const Docstring& docstring) {
  const py::object options = type.attr("__doc__");
  const std::string had = options.is_none() ? std::string() : std::string(py::str(options));
  type.attr("__doc__") = with_options(docstring.text, had.c_str());
}

void document(const py::module_& module, const Docstring& docstring) {
  const std::string_view name = docstring.name;
  const std::size_t dot = name.find('.');
  py::object owner = module;
  if (dot != name.npos) owner = module.attr(std::string(name.substr(0, dot)).c_str());
  const std::string member(dot == name.npos ? name : name.substr(dot + 1));
  py::object object = owner.attr(member.c_str());
  if (PyInstanceMethod_Check(object.ptr()) != 0)
    object = py::reinterpret_borrow<py::object>(PyInstanceMethod_GET_FUNCTION(object.ptr()));
  if (PyCFunction_Check(object.ptr()) != 0) {
    set_text(object.ptr(), docstring);
  } else if (PyType_Check(object.ptr()) != 0) {
    set_class_text(object, docstring);
  } else {
    object.attr("__doc__") = docstring.text;
  }
}

}  // namespace

void bind_docstrings(py::module_& module) {
  for (const Docstring& docstring : docstrings) document(module, docstring);
}

}  // namespace outrider::python
