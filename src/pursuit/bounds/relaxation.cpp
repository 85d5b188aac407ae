#include "bounds/relaxation.hpp"

#include <algorithm>
#include <utility>

namespace outrider {

Relaxation::Relaxation(const PursuitField& field, const CellSet& reached, std::span<const int> catches,
                       std::int64_t price)
    : field_(&field),
      price_(price),
      zero_s_(price >= 0 ? 0 : catches.back()),
      open_(reached),
      bound_(field.size(), unreachable),
      step_(field.size(), 0) {
  for (const int second : catches)
    sources_.push_back({field.target[static_cast<std::size_t>(second)], second});
  std::sort(sources_.begin(), sources_.end(), [&](const Source& a, const Source& b) {
    if (a.cell != b.cell) return a.cell < b.cell;
    return price >= 0 ? a.second < b.second : a.second > b.second;
  });
  const auto same = [](const Source& a, const Source& b) { return a.cell == b.cell; };
  sources_.erase(std::unique(sources_.begin(), sources_.end(), same), sources_.end());
  std::vector<Source> by_worth = sources_;
  std::sort(by_worth.begin(), by_worth.end(), [&](const Source& a, const Source& b) {
    return std::pair(worth(a.second), a.cell) < std::pair(worth(b.second), b.cell);
  });
  for (const Source& source : by_worth) queue_.push(worth(source.second), source.cell);
}

const Relaxation::Source* Relaxation::source_at(CellIndex i) const {
  if (!field_->visited.has(i)) return nullptr;
  const auto found = std::lower_bound(sources_.begin(), sources_.end(), i,
                                      [](const Source& a, CellIndex cell) { return a.cell < cell; });
  return found != sources_.end() && found->cell == i ? &*found : nullptr;
}

bool Relaxation::run(BudgetMeter& meter) {
  const std::array<CellIndex, 8> steps = field_->steps();
  while (!queue_.empty()) {
    if (!meter.spend()) return false;
    const auto [key, cell] = queue_.pop();
    if (open_.has(cell)) {  // a cell of the target, at its own worth
      open_.remove(cell);
      bound_[cell] = key;
    } else if (bound_[cell] != key) {
      continue;  // a cell of the target that was reached more cheaply
    }
    for_neighbours(open_, cell, field_->stride, [&](CellIndex n) {
      const auto cost = static_cast<std::uint64_t>(price_parts * std::int64_t{field_->costs[n]} - price_);
      if (const Source* source = source_at(n); source != nullptr && worth(source->second) <= key + cost)
        return;
      open_.remove(n);
      bound_[n] = key + cost;
      step_[n] =
          static_cast<std::uint8_t>(1 + (std::find(steps.begin(), steps.end(), cell - n) - steps.begin()));
      queue_.push(key + cost, n);
    });
  }
  return true;
}

TimedWay Relaxation::way() const {
  TimedWay way{{field_->start}, 0};
  while (next(way.cells.back()) != way.cells.back()) way.cells.push_back(next(way.cells.back()));
  way.second = catch_at(way.cells.back());
  return way;
}

std::uint64_t least_total(Relaxations relaxations, CellIndex cell, int second, std::uint64_t cost) {
  std::int64_t most = -price_parts * static_cast<std::int64_t>(cost);
  for (const auto& relaxation : relaxations) {
    if (!relaxation->reached(cell)) return unreachable;
    most = std::max(most, relaxation->bound(cell, second));
  }
  return static_cast<std::uint64_t>(most + price_parts * static_cast<std::int64_t>(cost));
}

}  // namespace outrider
