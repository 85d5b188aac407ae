// Points and grids of numpy.
#pragma once

#include <pybind11/numpy.h>

#include <cstdint>
#include <vector>

#include "outrider/geometry/vec.hpp"
#include "outrider/world/grid.hpp"

namespace outrider::python {

/// Returns a point of two finite numbers; raises BadInput, which names it, for anything else.
Vec2 point_of(const pybind11::handle& value, const char* name);
/// Returns the rows of an array of shape (n, 2) of finite numbers.
std::vector<Vec2> points_of(const pybind11::handle& value, const char* name);
/// Returns the points as an array of shape (n, 2), m.
pybind11::array_t<double> array_of(const std::vector<Vec2>& points);

/// Returns the cells of an array of shape (rows, columns) of bool or uint8, whose row 0 has the lowest y. Any
/// strides; read once, copied once.
std::vector<std::uint8_t> cells_of(const pybind11::array& array, GridFrame& frame);

}  // namespace outrider::python
