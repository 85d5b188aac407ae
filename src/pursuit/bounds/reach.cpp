#include "bounds/reach.hpp"

#include <algorithm>

namespace outrider {
namespace {

std::uint8_t mark_of(int steps) { return static_cast<std::uint8_t>(1 + steps % 255); }

}  // namespace

Reach::Reach(const PursuitField& field)
    : cells(field.size()),
      cheapest(field.costs[field.start]),
      field_(&field),
      open_(field.free),
      mark_(field.size(), 0),
      frontier_{field.start} {
  open_.remove(field.start);
  cells.add(field.start);
  mark_[field.start] = mark_of(0);
}

bool Reach::next_catch(BudgetMeter& meter) {
  while (second_ < field_->last_s) {
    if (!flood_one(meter)) return false;
    if (mark_[field_->target[static_cast<std::size_t>(second_)]] == 0) continue;
    catches.push_back(second_);
    return true;
  }
  complete = true;
  return true;
}

bool Reach::flood_one(BudgetMeter& meter) {
  const std::uint8_t mark = mark_of(second_ + 1);
  for (; done_ < frontier_.size(); ++done_) {
    if (!meter.spend()) return false;
    for_neighbours(open_, frontier_[done_], field_->stride, [&](CellIndex n) {
      open_.remove(n);
      cells.add(n);
      mark_[n] = mark;
      cheapest = std::min(cheapest, field_->costs[n]);
      next_.push_back(n);
      ++size_;
    });
  }
  frontier_.swap(next_);
  next_.clear();
  done_ = 0;
  ++second_;
  return true;
}

std::vector<CellIndex> Reach::path_to(CellIndex cell) const {
  std::vector<CellIndex> path{cell};
  while (path.back() != field_->start) {
    const std::uint8_t here = mark_[path.back()];
    const std::uint8_t before = here == 1 ? 255 : static_cast<std::uint8_t>(here - 1);
    CellIndex next = path.back();
    for (const CellIndex step : field_->steps()) {
      if (mark_[path.back() + step] == before) next = path.back() + step;
    }
    path.push_back(next);
  }
  std::reverse(path.begin(), path.end());
  return path;
}

}  // namespace outrider
