// Self-describing options, and paths, as values of Python.
#pragma once

#include <pybind11/pybind11.h>

#include <string>
#include <vector>

#include "outrider/core/options.hpp"

namespace outrider::python {

/// Returns the text of a bool, a number or a string, as options take it.
std::string option_text(const pybind11::handle& value);
/// Returns the text of a path: a string, or what os.fspath() takes.
std::string path_text(const pybind11::handle& value);
/// Sets an option by its name; raises BadInput for an unknown name or a value that it does not take.
void set_option(const std::vector<Option>& options, const std::string& name, const pybind11::handle& value);
/// Sets options by their names.
void set_options(const std::vector<Option>& options, const pybind11::kwargs& values);
/// Returns the options with their names behind the prefix, such as "tool_width".
std::vector<Option> prefixed(const std::string& prefix, std::vector<Option> options);
/// Returns all options of both lists.
std::vector<Option> joined(std::vector<Option> options, std::vector<Option> more);
/// Returns what an option means: sentence, unit, and range or choices.
std::string sentence_of(const Option& option);
/// Returns a line for each option: name, sentence, unit, range or choices, and its present value.
std::string options_text(const std::vector<Option>& options);
/// Returns the present values by name; angles in degrees.
pybind11::dict options_dict(const std::vector<Option>& options);

}  // namespace outrider::python
