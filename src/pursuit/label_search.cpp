#include "label_search.hpp"

#include <algorithm>

namespace outrider {

LabelSearch::LabelSearch(const PursuitField& field, Relaxations relaxations, std::uint64_t best,
                         std::uint64_t most_work)
    : field_(&field),
      relaxations_(relaxations),
      best_(best),
      most_work_(most_work),
      first_(field.size(), none) {
  add({0, static_cast<std::uint32_t>(field.start_s), field.costs[field.start], field.start, none, none,
       false},
      0);
}

bool LabelSearch::dominated(const PursuitLabel& label) {
  const auto beats = [](const PursuitLabel& a, const PursuitLabel& b) {
    return a.t <= b.t && a.m <= b.m && a.g + std::uint64_t{b.t - a.t} * a.m <= b.g;
  };
  std::uint32_t* link = &first_[label.cell];
  while (*link != none) {
    ++work_;
    PursuitLabel& other = labels_[*link];
    if (beats(other, label)) return true;
    if (beats(label, other)) {
      other.dropped = true;
      *link = other.next;
    } else {
      link = &other.next;
    }
  }
  return false;
}

void LabelSearch::add(const PursuitLabel& label, std::uint64_t at_least) {
  if (label.t > static_cast<std::uint32_t>(field_->last_s)) return;
  const std::uint64_t least =
      std::max(at_least, least_total(relaxations_, label.cell, static_cast<int>(label.t), label.g));
  if (least == unreachable || least + price_parts > price_parts * best_) return;
  if (dominated(label)) return;
  const auto id = static_cast<std::uint32_t>(labels_.size());
  labels_.push_back(label);
  labels_.back().next = first_[label.cell];
  first_[label.cell] = id;
  queue_.push(least, id);
  const int second = field_->next_visit(label.cell, std::max(1, static_cast<int>(label.t)));
  if (second < 0) return;
  const std::uint64_t cost =
      label.g + (static_cast<std::uint32_t>(second) - label.t) * std::uint64_t{label.m};
  if (cost >= best_) return;
  best_ = cost;
  better_ = way_of(id, second);
}

std::optional<TimedWay> LabelSearch::next_better(BudgetMeter& meter) {
  while (!better_ && !queue_.empty() && !gave_up()) {
    const auto [least, id] = queue_.pop();
    if (labels_[id].dropped || least + price_parts > price_parts * best_) continue;
    if (!meter.spend()) {
      queue_.push(least, id);
      break;
    }
    work_ += work_to_take_up;
    const PursuitLabel from = labels_[id];
    const std::uint64_t g = from.g + field_->costs[from.cell];
    for_neighbours(field_->free, from.cell, field_->stride, [&](CellIndex n) {
      add({g, from.t + 1, std::min(from.m, field_->costs[n]), n, id, none, false}, least);
    });
  }
  return std::exchange(better_, std::nullopt);
}

std::uint64_t LabelSearch::lower_bound() {
  if (queue_.empty()) return best_;
  return std::min(best_, (queue_.least() + price_parts - 1) / price_parts);
}

TimedWay LabelSearch::way_of(std::uint32_t label, int second) const {
  TimedWay way{{}, second};
  for (; label != none; label = labels_[label].parent) way.cells.push_back(labels_[label].cell);
  std::reverse(way.cells.begin(), way.cells.end());
  return way;
}

}  // namespace outrider
