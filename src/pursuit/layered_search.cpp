#include "layered_search.hpp"

#include <algorithm>
#include <cmath>

namespace outrider {
namespace {

/// Returns the possible sources of a state: the neighbours of a cell and the cell itself, in the order of
/// indices.
std::array<CellIndex, 9> sources_of(CellIndex stride) {
  return {0U - stride - 1, 0U - stride, 0U - stride + 1, 0U - 1U, 0U, 1U, stride - 1, stride, stride + 1};
}

}  // namespace

LayeredSearch::LayeredSearch(const PursuitField& field, Relaxations relaxations, std::uint64_t best)
    : field_(&field),
      relaxations_(relaxations),
      best_(best),
      layer_{{field.start, 0}},
      kept_{layer_},
      block_s_(1 + static_cast<int>(std::sqrt(3.0 * field.last_s))),
      cost_(field.size(), unreachable),
      step_(field.size(), 0) {}

bool LayeredSearch::take_up_layer(BudgetMeter& meter) {
  const CellIndex stride = field_->stride;
  for (; done_ < layer_.size(); ++done_) {
    if (!meter.spend()) return false;
    const State from = layer_[done_];
    const std::uint64_t left = from.cost + field_->costs[from.cell];
    std::uint8_t step = 9;  // the source seen from the neighbour is opposite to the neighbour
    for (const CellIndex row : {from.cell - stride, from.cell, from.cell + stride}) {
      const unsigned three = field_->free.three(row - 1);
      for (unsigned k = 0; k < 3; ++k) {
        --step;
        const CellIndex to = row - 1 + k;
        if ((three >> k & 1U) == 0 || left >= cost_[to]) continue;
        if (cost_[to] == unreachable) touched_.push_back(to);
        cost_[to] = left;
        step_[to] = step;
      }
    }
  }
  return true;
}

void LayeredSearch::finish_layer(Moves* moves) {
  ++second_;
  done_ = 0;
  layer_.clear();
  const CellIndex target = field_->target[static_cast<std::size_t>(second_)];
  if (cost_[target] < best_) {
    best_ = cost_[target];
    caught_s_ = second_;
  }
  least_total_ = unreachable;
  for (const CellIndex cell : touched_) {
    const std::uint64_t total = least_total(relaxations_, cell, second_, cost_[cell]);
    const bool cheaper = total != unreachable && total + price_parts <= price_parts * best_;
    if (cheaper || (cell == target && caught_s_ == second_)) {
      if (moves != nullptr) {
        moves->cells.push_back(cell);
        moves->steps.push_back(step_[cell]);
      }
      layer_.push_back({cell, cost_[cell]});
      least_total_ = std::min(least_total_, total);
    }
    cost_[cell] = unreachable;
  }
  touched_.clear();
  if (second_ == field_->last_s) layer_.clear();
}

std::optional<TimedWay> LayeredSearch::next_better(BudgetMeter& meter) {
  while (!layer_.empty() && take_up_layer(meter)) {
    finish_layer(nullptr);
    if (second_ % block_s_ == 0) kept_.push_back(layer_);
  }
  if (caught_s_ == 0 || !layer_.empty()) return std::nullopt;
  TimedWay found = way();
  caught_s_ = 0;
  return found;
}

std::uint64_t LayeredSearch::lower_bound() const {
  if (layer_.empty()) return best_;
  return std::min(best_, (least_total_ + price_parts - 1) / price_parts);
}

std::vector<LayeredSearch::Moves> LayeredSearch::replay(std::size_t kept, int last,
                                                        const LayeredSearch& recorded) {
  BudgetMeter unlimited{Budget{}};
  layer_ = recorded.kept_[kept];
  second_ = static_cast<int>(kept) * block_s_;
  best_ = recorded.best_ + 1;  // so that the states of the best way are not dropped
  std::vector<Moves> moves;
  while (second_ < last && take_up_layer(unlimited)) finish_layer(&moves.emplace_back());
  return moves;
}

TimedWay LayeredSearch::way() const {
  const std::array<CellIndex, 9> sources = sources_of(field_->stride);
  LayeredSearch again(*field_, relaxations_, best_ + 1);
  TimedWay way{{field_->target[static_cast<std::size_t>(caught_s_)]}, caught_s_};
  for (int last = caught_s_; last > 0;) {
    const auto kept = static_cast<std::size_t>((last - 1) / block_s_);
    const std::vector<Moves> moves = again.replay(kept, last, *this);
    for (auto move = moves.rbegin(); move != moves.rend(); ++move, --last) {
      const auto at = std::find(move->cells.begin(), move->cells.end(), way.cells.back());
      const auto place = static_cast<std::size_t>(at - move->cells.begin());
      way.cells.push_back(way.cells.back() + sources[move->steps[place]]);
    }
  }
  std::reverse(way.cells.begin(), way.cells.end());
  return way;
}

}  // namespace outrider
