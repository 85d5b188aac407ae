// Run-length lists of a report: value, count, value, count, ... row by row, as a drawn map has them.
#pragma once

#include <fmt/format.h>

#include <cmath>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "outrider/report/page_report.hpp"

namespace outrider {

/// Why the runs do not fill a map of `columns` x `rows` cells exactly, as a sentence; nothing when they do.
/// Decodes nothing: O(runs) whatever the counts are.
template <class T>
std::optional<std::string> fault_of_runs(const std::vector<T>& runs, int columns, int rows) {
  constexpr const char* remedy = "the file was damaged or written by something else; run the job again";
  const std::int64_t cells = std::int64_t{columns} * rows;
  if (cells > most_drawn_cells) {
    return fmt::format("the map has {} x {} cells, and a report draws {} at most; {}", columns, rows,
                       most_drawn_cells, remedy);
  }
  if (runs.size() % 2 != 0) {
    return fmt::format("the list has {} entries, but values and counts come in pairs; {}", runs.size(),
                       remedy);
  }
  std::int64_t filled = 0;
  for (std::size_t i = 1; i < runs.size(); i += 2) {
    const auto count = static_cast<double>(runs[i]);
    const bool fits = count >= 0.0 && count <= static_cast<double>(cells - filled);
    if (!fits || count != std::floor(count)) {
      return fmt::format("entry {} is {}, but counts are whole numbers that add up to {} x {} cells; {}", i,
                         count, columns, rows, remedy);
    }
    filled += static_cast<std::int64_t>(count);
  }
  if (filled == cells) return std::nullopt;
  return fmt::format("the counts add up to {} cells, but the map has {} x {}; {}", filled, columns, rows,
                     remedy);
}

}  // namespace outrider
