#include "bounds/forward_bound.hpp"

namespace outrider {

ForwardBound::ForwardBound(const PursuitField& field, const CellSet& reached, CellIndex from, int from_s,
                           std::uint64_t paid, std::int64_t price)
    : field_(&field),
      from_(from),
      from_s_(from_s),
      price_(price),
      open_(reached),
      bound_(field.size(), unreachable),
      steps_(field.size(), 0),
      before_(field.size(), 0) {
  open_.remove(from);
  bound_[from] = static_cast<std::uint64_t>(price_parts) * paid;
  queue_.push(
      bound_[from] + static_cast<std::uint64_t>(price_parts * std::int64_t{field.costs[from]} - price), from);
}

bool ForwardBound::run(BudgetMeter& meter) {
  while (!queue_.empty()) {
    if (!meter.spend()) return false;
    const auto [left, cell] = queue_.pop();
    for_neighbours(open_, cell, field_->stride, [&](CellIndex n) {
      open_.remove(n);
      bound_[n] = left;
      steps_[n] = steps_[cell] + 1;
      before_[n] = cell;
      queue_.push(left + static_cast<std::uint64_t>(price_parts * std::int64_t{field_->costs[n]} - price_),
                  n);
    });
  }
  return true;
}

}  // namespace outrider
