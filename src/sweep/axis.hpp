// Axis: the runs of a sweep by the value of a key that varies: a value of the grid, or a bin of numbers.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "outrider/sweep/summary.hpp"

namespace outrider {

struct Axis {
  std::string key;
  std::vector<std::string> labels;     ///< of each value or bin
  std::vector<std::uint8_t> place_of;  ///< of each run, its value or bin; 255: none
};

/// Returns the axes of the keys that can be shown, in order: grids of 2 to 40 values, and random numbers.
Outcome<std::vector<Axis>> sweep_axes(ChunkReader& chunks, std::size_t most);

/// Returns whether each run is done.
Outcome<std::vector<bool>> done_runs(ChunkReader& chunks);

}  // namespace outrider
