#include "options.hpp"

#include <fmt/format.h>

#include "faults.hpp"

namespace outrider::python {

namespace py = pybind11;

std::string option_text(const py::handle& value) {
  if (py::isinstance<py::bool_>(value)) return value.cast<bool>() ? "true" : "false";
  return py::str(value);
}

std::string path_text(const py::handle& value) {
  return py::str(py::module_::import("os").attr("fspath")(value));
}

void set_option(const std::vector<Option>& options, const std::string& name, const py::handle& value) {
  std::vector<std::string> known;
  for (const Option& option : options) {
    if (option.name == name) return require(assign(option, option_text(value)));
    known.push_back(option.name);
  }
  throw FaultError{no_such_row("option", name, known, name).value()};
}

void set_options(const std::vector<Option>& options, const py::kwargs& values) {
  for (const auto& [key, value] : values) set_option(options, py::str(key), value);
}

std::vector<Option> prefixed(const std::string& prefix, std::vector<Option> options) {
  for (Option& option : options) option.name.insert(0, prefix);
  return options;
}

std::vector<Option> joined(std::vector<Option> options, std::vector<Option> more) {
  options.insert(options.end(), more.begin(), more.end());
  return options;
}

std::string sentence_of(const Option& option) {
  std::string text = option.sentence;
  if (!option.unit.empty()) text += ", " + option.unit;
  const std::string_view type = type_name(option);
  if (type == "number" || type == "integer") text += fmt::format("; {:g} to {:g}", option.low, option.high);
  if (!option.choices.empty()) text += fmt::format("; one of {}", fmt::join(option.choices, ", "));
  return text;
}

std::string options_text(const std::vector<Option>& options) {
  std::string text;
  for (const Option& option : options) {
    const std::string value = value_text(option);
    text += fmt::format("\n  {}: {}; default {}", option.name, sentence_of(option),
                        value.empty() ? "empty" : value);
  }
  return text.empty() ? text : "Options:" + text;
}

py::dict options_dict(const std::vector<Option>& options) {
  py::dict result;
  for (const Option& option : options) {
    const std::string text = value_text(option);
    const py::str name(option.name);
    if (type_name(option) == "string") {
      result[name] = text;
    } else if (type_name(option) == "boolean") {
      result[name] = text == "true";
    } else if (type_name(option) == "integer") {
      result[name] = py::int_(py::str(text));
    } else {
      result[name] = py::float_(py::str(text));
    }
  }
  return result;
}

}  // namespace outrider::python
