// Axis: the runs of a sweep by the value of a key that varies: a value of the grid, or a bin of numbers.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "outrider/sweep/columns.hpp"

namespace outrider {

struct Axis {
  std::string key;
  std::vector<std::string> labels;     ///< of each value or bin
  std::vector<std::uint8_t> place_of;  ///< of each run, its value or bin; 255: none
};

/// Returns the first keys that can be shown: grids of 2 to 40 values, and random numbers.
std::vector<std::string> shown_keys(const Sweep& sweep, std::size_t most);

/// Returns the axis of one of these keys, from its column. It has no labels if all numbers are the same.
Axis axis_of(const Sweep& sweep, const Column& column);

}  // namespace outrider
