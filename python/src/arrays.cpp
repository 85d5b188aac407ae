#include "arrays.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>

#include "faults.hpp"

namespace outrider::python {

namespace py = pybind11;

namespace {

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

using Integers = py::array_t<std::int64_t, py::array::c_style | py::array::forcecast>;

Integers integers_of(const py::handle& value, const char* name) {
  try {
    const auto array = py::array::ensure(value);
    if (array && std::string("biu").find(array.dtype().kind()) != std::string::npos) return Integers(array);
    if (array) {
      refuse(fmt::format("its dtype is {}; give integers", std::string(py::str(array.dtype()))), name);
    }
  } catch (const py::error_already_set&) {
    // numpy's own message says nothing about the argument
  }
  PyErr_Clear();
  refuse(fmt::format("{} is no array of integers",
                     std::string(py::str(py::type::handle_of(value).attr("__name__")))),
         name);
}

int index_of(std::int64_t number, const char* name) {
  if (number < std::numeric_limits<int>::min() || number > std::numeric_limits<int>::max()) {
    refuse(fmt::format("{} is no cell; give indices of columns and rows", number), name);
  }
  return static_cast<int>(number);
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

Pose2 pose_of(const py::handle& value, const char* name) {
  const std::vector<double> numbers = numbers_of_shape(value, {3}, name);
  return {{numbers[0], numbers[1]}, numbers[2]};
}

py::array_t<double> array_of(const std::vector<Pose2>& poses) {
  std::vector<double> numbers;
  for (const Pose2& pose : poses) {
    numbers.insert(numbers.end(), {pose.position.x, pose.position.y, pose.heading_rad});
  }
  return array_of_shape({static_cast<py::ssize_t>(poses.size()), 3}, numbers.data());
}

py::array_t<double> array_of(const Pose2& pose) {
  const std::array<double, 3> numbers = {pose.position.x, pose.position.y, pose.heading_rad};
  return array_of_shape({3}, numbers.data());
}

Cell cell_of(const py::handle& value, const char* name) {
  const Integers numbers = integers_of(value, name);
  if (numbers.ndim() != 1 || numbers.shape(0) != 2) {
    refuse(fmt::format("its shape is {}; give two integers, column and row", shape_text(numbers)), name);
  }
  return {index_of(numbers.at(0), name), index_of(numbers.at(1), name)};
}

std::vector<Cell> cell_list_of(const py::handle& value, const char* name) {
  const Integers numbers = integers_of(value, name);
  if (numbers.ndim() != 2 || numbers.shape(1) != 2) {
    refuse(fmt::format("its shape is {}; give integers of shape (n, 2), column and row", shape_text(numbers)),
           name);
  }
  std::vector<Cell> cells;
  const auto rows = numbers.unchecked<2>();
  for (py::ssize_t i = 0; i < rows.shape(0); ++i) {
    cells.push_back({index_of(rows(i, 0), name), index_of(rows(i, 1), name)});
  }
  return cells;
}

py::array_t<std::int64_t> array_of(const std::vector<Cell>& cells) {
  py::array_t<std::int64_t> result({static_cast<py::ssize_t>(cells.size()), py::ssize_t{2}});
  std::int64_t* at = result.mutable_data();
  for (const Cell cell : cells) {
    *at++ = cell.x;
    *at++ = cell.y;
  }
  return result;
}

std::vector<std::uint32_t> costs_of(const py::handle& value, GridFrame& frame, const char* name) {
  const Integers numbers = integers_of(value, name);
  if (numbers.ndim() != 2) {
    refuse(
        fmt::format("its shape is {}; give rows and columns, row 0 with the lowest y", shape_text(numbers)),
        name);
  }
  frame.height = index_of(numbers.shape(0), name);
  frame.width = index_of(numbers.shape(1), name);
  std::vector<std::uint32_t> costs;
  costs.reserve(static_cast<std::size_t>(numbers.size()));
  for (py::ssize_t i = 0; i < numbers.size(); ++i) {
    const std::int64_t cost = numbers.data()[i];
    if (cost < 0 || cost > std::numeric_limits<std::uint32_t>::max()) {
      refuse(fmt::format("{} is no cost; give integers from 0 to 4294967295", cost), name);
    }
    costs.push_back(static_cast<std::uint32_t>(cost));
  }
  return costs;
}

std::vector<double> numbers_of_shape(const py::handle& value, const std::vector<py::ssize_t>& shape,
                                     const char* name) {
  const Numbers numbers = numbers_of(value, name);
  bool fits = numbers.ndim() == static_cast<py::ssize_t>(shape.size());
  for (std::size_t i = 0; fits && i < shape.size(); ++i) {
    fits = shape[i] == -1 || shape[i] == numbers.shape(static_cast<py::ssize_t>(i));
  }
  if (!fits) {
    std::string wanted;
    for (const py::ssize_t length : shape) {
      wanted += fmt::format("{}{}", wanted.empty() ? "" : ", ", length < 0 ? "n" : std::to_string(length));
    }
    refuse(fmt::format("its shape is {}; give an array of shape ({})", shape_text(numbers), wanted), name);
  }
  std::vector<double> result(numbers.data(), numbers.data() + numbers.size());
  for (const double number : result) {
    if (!std::isfinite(number)) refuse(fmt::format("{} is not finite; give finite numbers", number), name);
  }
  return result;
}

py::array_t<double> array_of_shape(const std::vector<py::ssize_t>& shape, const double* numbers) {
  py::array_t<double> result(shape);
  std::copy_n(numbers, static_cast<std::size_t>(result.size()), result.mutable_data());
  return result;
}

std::vector<std::int64_t> integers_of_row(const py::handle& value, const char* name) {
  const Integers numbers = integers_of(value, name);
  if (numbers.ndim() != 1) {
    refuse(fmt::format("its shape is {}; give integers of shape (n)", shape_text(numbers)), name);
  }
  return {numbers.data(), numbers.data() + numbers.size()};
}

std::vector<float> ranges_of(const py::handle& value, const char* name) {
  const Numbers numbers = numbers_of(value, name);
  if (numbers.ndim() != 1)
    refuse(fmt::format("its shape is {}; give ranges of shape (n)", shape_text(numbers)), name);
  std::vector<float> ranges;
  ranges.reserve(static_cast<std::size_t>(numbers.size()));
  for (py::ssize_t i = 0; i < numbers.size(); ++i) ranges.push_back(static_cast<float>(numbers.data()[i]));
  return ranges;
}

py::array view_of(const Grid<std::uint8_t>& grid, const py::object& owner) {
  py::array_t<std::uint8_t> view(
      {static_cast<py::ssize_t>(grid.frame.height), static_cast<py::ssize_t>(grid.frame.width)},
      grid.cells.data(), owner);
  py::detail::array_proxy(view.ptr())->flags &= ~py::detail::npy_api::NPY_ARRAY_WRITEABLE_;
  return view;
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
