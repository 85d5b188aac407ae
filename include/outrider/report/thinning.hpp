// Which rows of a long recording are kept, so that lines between them tell of all.
#pragma once

#include <cstddef>
#include <vector>

namespace outrider {

struct Thinning {
  std::vector<std::size_t> rows;  ///< ascending, the first and the last among them
  double within = 0.0;  ///< no column of a row left out is farther from the line between its neighbours
};

/// Keeps all of at most `most` rows. Of more it keeps those of Douglas and Peucker's rule with the distance
/// taken at equal time: between two rows kept, each column, linear in time, is within a bound of every row
/// left out. The bound is `least`, made a quarter larger until no more than `most` (at least 2) rows are
/// left. Columns are as long as `time`, which does not decrease; angles go on without jumps. Typically O(n
/// log n columns) for each bound. Source: Douglas and Peucker, Cartographica 10 (1973) 112-122.
Thinning thinned(const std::vector<double>& time, const std::vector<std::vector<double>>& columns,
                 std::size_t most, double least);

}  // namespace outrider
