#include "bounds/price_search.hpp"

#include <algorithm>
#include <utility>

namespace outrider {
namespace {

constexpr std::size_t most_relaxations = 12;                 // maximum number tried
constexpr std::int64_t most_total = std::int64_t{1} << 61U;  // prices with larger totals are not used

}  // namespace

PriceSearch::PriceSearch(const PursuitField& field, const CellSet& reached, std::span<const int> catches,
                         std::int64_t dearest, const TimedWay& known)
    : field_(&field),
      reached_(&reached),
      catches_(catches.begin(), catches.end()),
      dearest_(dearest),
      in_time_(line_of(known)) {
  relax_at(dearest);
}

PriceSearch::Line PriceSearch::line_of(const TimedWay& way) const {
  Line line;
  for (std::size_t i = 0; i + 1 < way.cells.size(); ++i)
    line.cost += price_parts * std::int64_t{field_->costs[way.cells[i]]};
  line.slack_s = way.second - field_->start_s - static_cast<std::int64_t>(way.cells.size() - 1);
  return line;
}

/// Returns the price, rounded down, at which the rising line meets the falling one.
std::int64_t PriceSearch::crossing(const Line& rising, const Line& falling) {
  const std::int64_t apart = rising.cost - falling.cost, run = rising.slack_s - falling.slack_s;
  return -(apart / run) - (apart % run > 0 ? 1 : 0);
}

void PriceSearch::relax_at(std::int64_t price) {
  price = std::max(price, -most_total / (4 * std::int64_t{field_->last_s} + 4));
  running_ = std::make_unique<Relaxation>(*field_, *reached_, catches_, price);
}

bool PriceSearch::run(BudgetMeter& meter) {
  if (!running_->run(meter)) return false;
  const std::int64_t price = running_->price();
  bound_ = running_->bound(field_->start, field_->start_s);
  TimedWay way = running_->way();
  const Line line = line_of(way);
  const bool first = relaxations_.empty(), in_time = line.slack_s >= 0;
  const bool tight = !first && std::min(in_time_.at(price), too_late_.at(price)) <= bound_;
  relaxations_.push_back(std::move(running_));
  (in_time ? in_time_ : too_late_) = line;
  if (in_time) way_ = std::move(way);
  if (tight || (first && in_time) || relaxations_.size() == most_relaxations) return true;
  relax_at(std::min(crossing(in_time_, too_late_), dearest_));
  return true;
}

void PriceSearch::keep_best(std::size_t most) {
  running_.reset();
  if (relaxations_.empty()) return;
  std::sort(relaxations_.begin() + 1, relaxations_.end(), [&](const auto& a, const auto& b) {
    const std::int64_t bound_a = a->bound(field_->start, field_->start_s);
    const std::int64_t bound_b = b->bound(field_->start, field_->start_s);
    return bound_a != bound_b ? bound_a > bound_b : a->price() > b->price();
  });
  if (relaxations_.size() > most) relaxations_.resize(most);
}

const Relaxation& PriceSearch::best() const {
  const auto best =
      std::max_element(relaxations_.begin(), relaxations_.end(), [&](const auto& a, const auto& b) {
        return a->bound(field_->start, field_->start_s) < b->bound(field_->start, field_->start_s);
      });
  return **best;
}

}  // namespace outrider
