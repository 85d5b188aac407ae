// Points and grids of numpy.
#pragma once

#include <pybind11/numpy.h>

#include <cstdint>
#include <vector>

#include "outrider/geometry/pose.hpp"
#include "outrider/world/grid.hpp"

namespace outrider::python {

/// Returns a point of two finite numbers; raises BadInput, which names it, for anything else.
Vec2 point_of(const pybind11::handle& value, const char* name);
/// Returns the rows of an array of shape (n, 2) of finite numbers.
std::vector<Vec2> points_of(const pybind11::handle& value, const char* name);
/// Returns the points as an array of shape (n, 2), m.
pybind11::array_t<double> array_of(const std::vector<Vec2>& points);

/// Returns a pose of three finite numbers: x, y in m and heading in rad.
Pose2 pose_of(const pybind11::handle& value, const char* name);
/// Returns the poses as an array of shape (n, 3), or one as an array of shape (3).
pybind11::array_t<double> array_of(const std::vector<Pose2>& poses);
pybind11::array_t<double> array_of(const Pose2& pose);

/// Returns a cell of two integers, column and row, which count from 0.
Cell cell_of(const pybind11::handle& value, const char* name);
/// Returns the rows of an array of integers of shape (n, 2).
std::vector<Cell> cell_list_of(const pybind11::handle& value, const char* name);
/// Returns the cells as an array of shape (n, 2) of int64.
pybind11::array_t<std::int64_t> array_of(const std::vector<Cell>& cells);

/// Returns the integers of an array of shape (rows, columns), whose row 0 has the lowest y, and sets the size
/// of the frame; refuses numbers that do not fit into 32 bits.
std::vector<std::uint32_t> costs_of(const pybind11::handle& value, GridFrame& frame, const char* name);

/// Returns finite numbers of any shape, such as {n, 3}, where -1 stands for any length.
std::vector<double> numbers_of_shape(const pybind11::handle& value,
                                     const std::vector<pybind11::ssize_t>& shape, const char* name);
/// Returns an array of that shape with the numbers.
pybind11::array_t<double> array_of_shape(const std::vector<pybind11::ssize_t>& shape, const double* numbers);

/// Returns the integers of an array of shape (n).
std::vector<std::int64_t> integers_of_row(const pybind11::handle& value, const char* name);
/// Returns the ranges of an array of shape (n), m; they may be infinite or no numbers.
std::vector<float> ranges_of(const pybind11::handle& value, const char* name);

/// Returns a read-only view of a grid of bytes, of shape (rows, columns); `owner` stays alive with it.
pybind11::array view_of(const Grid<std::uint8_t>& grid, const pybind11::object& owner);

/// Returns the cells of an array of shape (rows, columns) of bool or uint8, whose row 0 has the lowest y. Any
/// strides; read once, copied once.
std::vector<std::uint8_t> cells_of(const pybind11::array& array, GridFrame& frame);

}  // namespace outrider::python
