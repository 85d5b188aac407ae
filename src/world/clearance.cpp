#include "outrider/world/clearance.hpp"

#include <algorithm>
#include <vector>

namespace outrider {
namespace {

constexpr std::int64_t none = std::numeric_limits<std::int32_t>::max();

std::int64_t floor_divide(std::int64_t a, std::int64_t positive) {
  return a >= 0 ? a / positive : -((positive - 1 - a) / positive);
}

/// Returns the distance from each cell to the nearest blocked cell of its column, or `none`.
std::vector<std::int64_t> along_columns(const Grid<std::uint8_t>& blocked, const std::stop_token& stop) {
  const auto width = static_cast<std::size_t>(blocked.frame.width), size = blocked.cells.size();
  std::vector<std::int64_t> apart(size, none);
  const auto next_to = [&](std::size_t i, std::size_t neighbour) {
    if (apart[neighbour] != none) apart[i] = std::min(apart[i], apart[neighbour] + 1);
  };
  for (std::size_t i = 0; i < size; ++i) {
    if (i % width == 0 && stop.stop_requested()) return apart;
    if (blocked.cells[i] != 0)
      apart[i] = 0;
    else if (i >= width)
      next_to(i, i - width);
  }
  for (std::size_t i = size; i-- > 0;) {
    if (i % width == 0 && stop.stop_requested()) return apart;
    if (i + width < size) next_to(i, i + width);
  }
  return apart;
}

/// The lower envelope of the parabolas (x - x0)^2 + height of one row, and the x from which each is the
/// lowest.
struct Envelope {
  std::vector<std::int64_t> centre, height, from;

  void clear() {
    centre.clear();
    height.clear();
    from.clear();
  }
  /// Adds a parabola. The centres must be added in ascending order.
  void add(std::int64_t x, std::int64_t h) {
    std::int64_t start = 0;
    while (!centre.empty()) {
      const std::int64_t rise = (h + x * x) - (height.back() + centre.back() * centre.back());
      start = floor_divide(rise, 2 * (x - centre.back())) + 1;  // first x where the new one is lower
      if (start > from.back()) break;
      centre.pop_back();
      height.pop_back();
      from.pop_back();
      start = 0;
    }
    centre.push_back(x);
    height.push_back(h);
    from.push_back(start);
  }
};

}  // namespace

Grid<std::uint32_t> squared_clearance(const Grid<std::uint8_t>& blocked, const std::stop_token& stop) {
  Grid<std::uint32_t> result(blocked.frame, no_obstacle);
  const std::vector<std::int64_t> apart = along_columns(blocked, stop);
  const auto width = static_cast<std::size_t>(blocked.frame.width);
  Envelope envelope;
  for (std::size_t row = 0; row < result.cells.size() && !stop.stop_requested(); row += width) {
    envelope.clear();
    for (std::size_t x = 0; x < width; ++x) {
      const std::int64_t y = apart[row + x];
      if (y != none) envelope.add(static_cast<std::int64_t>(x), y * y);
    }
    for (std::size_t x = 0, k = 0; x < width && !envelope.centre.empty(); ++x) {
      const auto at = static_cast<std::int64_t>(x);
      while (k + 1 < envelope.from.size() && envelope.from[k + 1] <= at) ++k;
      const std::int64_t d = at - envelope.centre[k];
      result.cells[row + x] = static_cast<std::uint32_t>(d * d + envelope.height[k]);
    }
  }
  return result;
}

}  // namespace outrider
