#include "dissection_order.hpp"

#include <algorithm>
#include <cstdlib>
#include <limits>
#include <utility>

namespace outrider::hub_labelling {
namespace {

struct Part {
  Cell low, high;  // both belong to it
};

/// Appends the free ones of a row or column of cells, the middle of each stretch before its halves.
void append_line(const GridMap& ground, const std::vector<Cell>& line, std::vector<std::uint32_t>& order) {
  std::vector<std::pair<std::size_t, std::size_t>> stretches = {{0, line.size()}};
  for (std::size_t k = 0; k < stretches.size(); ++k) {
    const auto [begin, end] = stretches[k];
    if (begin == end) continue;
    const std::size_t middle = begin + (end - begin) / 2;
    if (!ground.blocked(line[middle])) order.push_back(ground.index(line[middle]));
    stretches.emplace_back(begin, middle);
    stretches.emplace_back(middle + 1, end);
  }
}

/// Returns the cells of a part with that coordinate, along x if the cut is a column.
std::vector<Cell> line_of(const Part& part, bool column, int at) {
  std::vector<Cell> line;
  for (int k = column ? part.low.y : part.low.x; k <= (column ? part.high.y : part.high.x); ++k) {
    line.push_back(column ? Cell{at, k} : Cell{k, at});
  }
  return line;
}

/// Returns the coordinate of the best cut.
int best_cut(const GridMap& ground, const Part& part, bool column, const std::stop_token& stop) {
  const int low = column ? part.low.x : part.low.y, high = column ? part.high.x : part.high.y;
  const int third = (high - low) / 3, middle = low + (high - low) / 2;
  int best = middle;
  auto least = std::numeric_limits<std::ptrdiff_t>::max();
  for (int at = low + third; at <= high - third && !stop.stop_requested(); ++at) {
    const auto line = line_of(part, column, at);
    const auto free = std::count_if(line.begin(), line.end(), [&](Cell c) { return !ground.blocked(c); });
    const bool nearer = std::abs(at - middle) < std::abs(best - middle);
    if (free < least || (free == least && nearer)) {
      least = free;
      best = at;
    }
  }
  return best;
}

}  // namespace

std::vector<std::uint32_t> dissection_order(const GridMap& ground, const std::stop_token& stop) {
  std::vector<std::uint32_t> order;
  std::vector<Part> parts = {{{0, 0}, {ground.frame.width - 1, ground.frame.height - 1}}};
  for (std::size_t k = 0; k < parts.size() && !stop.stop_requested(); ++k) {
    const Part part = parts[k];
    if (part.low.x > part.high.x || part.low.y > part.high.y) continue;
    const bool column = part.high.x - part.low.x >= part.high.y - part.low.y;
    const int cut = best_cut(ground, part, column, stop);
    append_line(ground, line_of(part, column, cut), order);
    Part lower = part, higher = part;
    (column ? lower.high.x : lower.high.y) = cut - 1;
    (column ? higher.low.x : higher.low.y) = cut + 1;
    parts.push_back(lower);
    parts.push_back(higher);
  }
  return order;
}

}  // namespace outrider::hub_labelling
