// thinned() selects the rows of a long recording that represent all rows by linear interpolation.
#pragma once

#include <cstddef>
#include <vector>

namespace outrider {

struct Thinning {
  std::vector<std::size_t> rows;  ///< indices of the kept rows, ascending, with the first and the last
  double within = 0.0;            ///< largest deviation of any column of a removed row from the interpolation
};

/// Keeps all rows if there are at most `most`. Otherwise it applies the rule of Douglas and Peucker with the
/// distance at equal time: the linear interpolation of each column between two kept rows is within a bound of
/// every removed row. The bound starts at `least` and grows by a quarter until at most `most` (at least 2)
/// rows are left. Columns must be as long as `time`, which must not decrease; angles must be unwrapped.
/// Typically O(n log n columns) for each bound. Source: Douglas and Peucker, Cartographica 10 (1973) 112-122.
Thinning thinned(const std::vector<double>& time, const std::vector<std::vector<double>>& columns,
                 std::size_t most, double least);

}  // namespace outrider
