#include "outrider/report/thinning.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace outrider {
namespace {

using Columns = std::vector<std::vector<double>>;

struct Farthest {
  std::size_t row = 0;
  double away = 0.0;
};

/// Returns the row between two others that lies farthest from the line between them.
Farthest farthest(const std::vector<double>& time, const Columns& columns, std::size_t low,
                  std::size_t high) {
  Farthest found{low, 0.0};
  const double span = time[high] - time[low];
  for (std::size_t row = low + 1; row < high; ++row) {
    const double share = span > 0.0 ? (time[row] - time[low]) / span : 0.0;
    double away = 0.0;
    for (const std::vector<double>& column : columns) {
      const double line = column[low] + share * (column[high] - column[low]);
      away = std::max(away, std::abs(column[row] - line));
    }
    if (away > found.away) found = {row, away};
  }
  return found;
}

Thinning within(const std::vector<double>& time, const Columns& columns, double bound) {
  Thinning kept{{0, time.size() - 1}, 0.0};
  std::vector<std::pair<std::size_t, std::size_t>> open = {{0, time.size() - 1}};
  while (!open.empty()) {
    const auto [low, high] = open.back();
    open.pop_back();
    const Farthest found = farthest(time, columns, low, high);
    if (found.away <= bound) {
      kept.within = std::max(kept.within, found.away);
      continue;
    }
    kept.rows.push_back(found.row);
    open.emplace_back(low, found.row);
    open.emplace_back(found.row, high);
  }
  std::ranges::sort(kept.rows);
  return kept;
}

}  // namespace

Thinning thinned(const std::vector<double>& time, const Columns& columns, std::size_t most, double least) {
  Thinning all;
  for (std::size_t row = 0; row < time.size(); ++row) all.rows.push_back(row);
  most = std::max<std::size_t>(2, most);
  for (double bound = least; all.rows.size() > most; bound *= 1.25) all = within(time, columns, bound);
  return all;
}

}  // namespace outrider
