// LogMap: the occupancy map of a log, as it grows.
#pragma once

#include <cstdint>
#include <functional>
#include <span>

#include "outrider/log/log.hpp"
#include "outrider/world/grid.hpp"

namespace outrider {

class LogMap {
 public:
  /// Receives the map after each message: whether it was logged whole, the indices of the cells in the
  /// message, and the time.
  using Changed =
      std::function<void(const Grid<std::uint8_t>&, bool whole, std::span<const std::size_t>, double time_s)>;

  /// Applies the messages since the last call, in the order of time. O(cells in them).
  void read(const Log& log, const Changed& changed = {});

  /// Returns the map. Its cells are values of Occupancy.
  [[nodiscard]] const Grid<std::uint8_t>& grid() const { return grid_; }

 private:
  Grid<std::uint8_t> grid_;
  std::size_t wholes_ = 0;   ///< number of whole maps that were applied
  std::size_t updates_ = 0;  ///< number of updates that were applied
};

}  // namespace outrider
