// Helpers shared by the suites: calling an observer and turning rows into a result.
#pragma once

#include <algorithm>
#include <limits>
#include <string>
#include <vector>

#include "suites.hpp"

namespace outrider::bench {

inline void begin_steps(const BenchObserver& observer, std::size_t steps) {
  if (observer.begin) observer.begin(static_cast<int>(steps));
}

inline void next_step(const BenchObserver& observer, const std::string& step) {
  if (observer.next) observer.next(step);
}

/// Returns the value below which that part of the values lies; NaN if there are none.
inline double quantile(std::vector<double> values, double part) {
  if (values.empty()) return std::numeric_limits<double>::quiet_NaN();
  std::ranges::sort(values);
  return values[static_cast<std::size_t>(part * static_cast<double>(values.size() - 1))];
}

/// Builds the result with the row_json() and table_text() declared beside Row.
template <class Row>
BenchResult result_of(const std::vector<Row>& rows) {
  BenchResult result;
  for (const Row& row : rows) result.rows.push_back(row_json(row));
  result.table = table_text(rows);
  return result;
}

}  // namespace outrider::bench
