#include "arrays.hpp"

#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <string>

#include "faults.hpp"

namespace outrider::python {

namespace py = pybind11;

namespace {

[[noreturn]] void refuse(std::string sentence, const char* name) {
  throw FaultError{{FaultCode::bad_input, std::move(sentence), name}};
}

std::string shape_text(const py::array& array) {
  std::string text;
  for (py::ssize_t i = 0; i < array.ndim(); ++i)
    text += fmt::format("{}{}", i == 0 ? "" : ", ", array.shape(i));
  return "(" + text + ")";
}

using Numbers = py::array_t<double, py::array::c_style | py::array::forcecast>;

/// Converts to numbers; refuses what numpy cannot convert, and complex numbers.
Numbers numbers_of(const py::handle& value, const char* name) {
  try {
    const auto array = py::array::ensure(value);
    if (array && std::string("biuf").find(array.dtype().kind()) != std::string::npos) return Numbers(array);
  } catch (const py::error_already_set&) {
    // numpy's own message says nothing about the argument
  }
  PyErr_Clear();
  refuse(fmt::format("{} is no array of numbers; give x and y in m",
                     std::string(py::str(py::type::handle_of(value).attr("__name__")))),
         name);
}

void check_finite(const Vec2 p, const char* name) {
  if (std::isfinite(p.x) && std::isfinite(p.y)) return;
  refuse(fmt::format("({}, {}) is no point; give finite numbers", p.x, p.y), name);
}

}  // namespace

Vec2 point_of(const py::handle& value, const char* name) {
  const Numbers numbers = numbers_of(value, name);
  if (numbers.ndim() != 1 || numbers.shape(0) != 2) {
    refuse(fmt::format("its shape is {}; give two numbers, x and y in m", shape_text(numbers)), name);
  }
  const Vec2 p{numbers.at(0), numbers.at(1)};
  check_finite(p, name);
  return p;
}

std::vector<Vec2> points_of(const py::handle& value, const char* name) {
  const Numbers numbers = numbers_of(value, name);
  if (numbers.ndim() != 2 || numbers.shape(1) != 2) {
    refuse(fmt::format("its shape is {}; give an array of shape (n, 2), x and y in m", shape_text(numbers)),
           name);
  }
  std::vector<Vec2> points;
  points.reserve(static_cast<std::size_t>(numbers.shape(0)));
  const auto rows = numbers.unchecked<2>();
  for (py::ssize_t i = 0; i < rows.shape(0); ++i) {
    points.push_back({rows(i, 0), rows(i, 1)});
    check_finite(points.back(), name);
  }
  return points;
}

py::array_t<double> array_of(const std::vector<Vec2>& points) {
  py::array_t<double> result({static_cast<py::ssize_t>(points.size()), py::ssize_t{2}});
  auto rows = result.mutable_unchecked<2>();
  for (std::size_t i = 0; i < points.size(); ++i) {
    rows(static_cast<py::ssize_t>(i), 0) = points[i].x;
    rows(static_cast<py::ssize_t>(i), 1) = points[i].y;
  }
  return result;
}

std::vector<std::uint8_t> cells_of(const py::array& array, GridFrame& frame) {
  if (array.ndim() != 2) {
    refuse(fmt::format("its shape is {}; give rows and columns, row 0 with the lowest y", shape_text(array)),
           "blocked");
  }
  const char kind = array.dtype().kind();
  if (array.itemsize() != 1 || (kind != 'b' && kind != 'u')) {
    refuse(fmt::format("its dtype is {}; give bool or uint8, where 0 is free",
                       std::string(py::str(array.dtype()))),
           "blocked");
  }
  constexpr py::ssize_t most = std::numeric_limits<int>::max();
  if (array.shape(0) > most || array.shape(1) > most) {
    refuse(fmt::format("its shape is {}; a grid has at most 2^25 cells", shape_text(array)), "blocked");
  }
  frame.height = static_cast<int>(array.shape(0));
  frame.width = static_cast<int>(array.shape(1));
  std::vector<std::uint8_t> cells;
  cells.reserve(frame.size());
  const auto* const data = static_cast<const char*>(array.data());
  for (py::ssize_t y = 0; y < array.shape(0); ++y) {
    for (py::ssize_t x = 0; x < array.shape(1); ++x) {
      cells.push_back(static_cast<std::uint8_t>(data[y * array.strides(0) + x * array.strides(1)]));
    }
  }
  return cells;
}

}  // namespace outrider::python
