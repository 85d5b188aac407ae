#include "outrider/pursuit/sweep.hpp"

#include <algorithm>
#include <limits>

namespace outrider {
namespace {

constexpr std::uint64_t unreached = std::numeric_limits<std::uint64_t>::max();

/// The least cost of being in each cell in one second, with a border of cells that are never occupied.
struct Layer {
  std::size_t stride;
  std::vector<std::uint64_t> cost;

  explicit Layer(const GridFrame& frame)
      : stride(static_cast<std::size_t>(frame.width) + 2),
        cost(stride * (static_cast<std::size_t>(frame.height) + 2), unreached) {}
  [[nodiscard]] std::size_t index(Cell c) const {
    return static_cast<std::size_t>(c.y + 1) * stride + static_cast<std::size_t>(c.x + 1);
  }
};

/// Computes one row of the next second; `left` is the layer of the costs paid on leaving each cell.
void sweep_row(const PursuitProblem& problem, const Layer& left, Layer& next, int y) {
  for (int x = 0; x < problem.costs->frame.width; ++x) {
    const Cell c{x, y};
    if (problem.wall(c)) continue;
    const std::size_t i = left.index(c);
    std::uint64_t least = unreached;
    for (const std::size_t row : {i - left.stride, i, i + left.stride}) {
      for (const std::size_t k : {row - 1, row, row + 1}) least = std::min(least, left.cost[k]);
    }
    next.cost[i] = least;
  }
}

void leave_cells(const PursuitProblem& problem, const Layer& here, Layer& left) {
  const GridFrame& frame = problem.costs->frame;
  for (int y = 0; y < frame.height; ++y) {
    for (int x = 0; x < frame.width; ++x) {
      const std::size_t i = here.index({x, y});
      left.cost[i] = here.cost[i] == unreached ? unreached : here.cost[i] + (*problem.costs)[{x, y}];
    }
  }
}

}  // namespace

Outcome<LeastCatch> sweep(const PursuitProblem& problem, const Budget& budget) {
  if (Status good = check(problem); !good) return pass_on(good);
  BudgetMeter meter(budget);
  const GridFrame& frame = problem.costs->frame;
  Layer here(frame), left(frame);
  here.cost[here.index(problem.start)] = 0;
  LeastCatch least{unreached, 0, -1};
  for (int s = problem.start_s + 1; s <= problem.last_s(); ++s) {
    leave_cells(problem, here, left);
    for (int y = 0; y < frame.height; ++y) {
      if (!meter.spend()) return meter.refusal();
      sweep_row(problem, left, here, y);
    }
    const std::uint64_t cost = here.cost[here.index(problem.target[static_cast<std::size_t>(s)])];
    if (cost == unreached) continue;
    if (least.earliest_catch_s < 0) least.earliest_catch_s = s;
    if (cost < least.cost) least.cost = cost, least.catch_time_s = s;
  }
  if (least.earliest_catch_s < 0) return fault(FaultCode::no_path, "no second allows a catch");
  return least;
}

}  // namespace outrider
