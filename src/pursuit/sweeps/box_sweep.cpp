#include "sweeps/box_sweep.hpp"

#include <algorithm>

namespace outrider {

BoxSweep::BoxSweep(const PursuitProblem& problem) : problem_(&problem) {
  const GridFrame& frame = problem.costs->frame;
  const int last = problem.last_s() - problem.start_s;
  boxes_ = pursuit_boxes({{0, 0}, {frame.width - 1, frame.height - 1}}, problem.start, 0, last, [&](int s) {
    return s == 0 || problem.wall(target(s)) ? std::nullopt : std::optional(target(s));
  });
  while (!boxes_.empty() && boxes_.back().empty()) boxes_.pop_back();
  for (const CellBox& box : boxes_) {
    work_ += box.area();
    if (!box.empty()) window_ = around(around(window_, box.low), box.high);
  }
}

bool BoxSweep::prepare() {
  stride_ = static_cast<std::size_t>(window_.width() + 2 * row_block<Cost>);
  costs_.assign(stride_ * static_cast<std::size_t>(window_.height() + 2), no_catch<Cost>);
  const std::uint32_t wall = problem_->threshold;
  std::uint32_t dearest = 0;
  for (int y = window_.low.y; y <= window_.high.y; ++y) {
    const std::uint32_t* from = &(*problem_->costs)[{window_.low.x, y}];
    Cost* to = costs_.data() + index({window_.low.x, y});
    for (int x = 0; x < window_.width(); ++x) {
      dearest = std::max(dearest, from[x] < wall ? from[x] : 0);
      to[x] = from[x] < wall ? static_cast<Cost>(from[x]) : no_catch<Cost>;
    }
  }
  if (std::uint64_t{dearest} * boxes_.size() >= static_cast<std::uint64_t>(no_catch<Cost>)) return false;
  left_.assign(costs_.size(), no_catch<Cost>);
  next_ = left_;
  if (boxes_.empty()) return true;
  const Cell start = problem_->start;
  left_[index(start)] = costs_[index(start)];
  kept_.reserve(work_);
  kept_.push_back(costs_[index(start)]);
  begin_.push_back(0);
  least_.emplace(window_.width());
  return true;
}

bool BoxSweep::run(BudgetMeter& meter) {
  while (second_ + 1 < static_cast<int>(boxes_.size())) {
    if (owed_ == 0) owed_ = static_cast<std::uint64_t>(box(second_ + 1).height());
    for (; owed_ > 0; --owed_) {
      if (!meter.spend()) return false;
    }
    note_catch(second_ + 1);
    sweep_layer();
    ++second_;
  }
  return true;
}

void BoxSweep::note_catch(int second) {
  const Cell goal = target(second);
  if (!box(second).has(goal) || problem_->wall(goal)) return;
  const Cost cost = cheapest_around(goal, second - 1).second;
  if (cost == no_catch<Cost>) return;
  if (earliest_s_ < 0) earliest_s_ = second;
  if (cost < best_) best_ = cost, best_s_ = second;
}

BoxSweep::Cost BoxSweep::left(Cell c, int second) const {
  const CellBox& of = box(second);
  if (!of.has(c)) return no_catch<Cost>;
  return kept_[begin_[static_cast<std::size_t>(second)] +
               static_cast<std::size_t>((c.y - of.low.y) * of.width() + c.x - of.low.x)];
}

std::pair<Cell, BoxSweep::Cost> BoxSweep::cheapest_around(Cell c, int second) const {
  std::pair<Cell, Cost> best{c, left(c, second)};
  for (int n = 0; n < 9; ++n) {
    const Cell next{c.x + n % 3 - 1, c.y + n / 3 - 1};
    if (const Cost cost = left(next, second); cost < best.second) best = {next, cost};
  }
  return best;
}

/// Cells that the boxes have left keep what they had: nothing reads them again, as no catch is in time from
/// there.
void BoxSweep::sweep_layer() {
  static const RowKernel<Cost>& kernel = row_kernel<Cost>(fastest_processor());
  const CellBox& now = box(second_ + 1);
  const auto narrow = [&](int y) {
    kernel.narrow(left_.data() + index({now.low.x, y}), least_->row(y), now.width());
  };
  begin_.push_back(kept_.size());
  narrow(now.low.y - 1);
  narrow(now.low.y);
  for (int y = now.low.y; y <= now.high.y; ++y) {
    narrow(y + 1);
    Cost* row = next_.data() + index({now.low.x, y});
    least_->settle(kernel, y, costs_.data() + index({now.low.x, y}), row, now.width());
    kept_.insert(kept_.end(), row, row + now.width());
  }
  left_.swap(next_);
}

std::optional<PursuitPlan> BoxSweep::plan() const {
  if (best_s_ < 0) return std::nullopt;
  PursuitPlan plan;
  plan.path = {target(best_s_)};
  for (int s = best_s_ - 1; s >= 0; --s) plan.path.push_back(cheapest_around(plan.path.back(), s).first);
  std::reverse(plan.path.begin(), plan.path.end());
  plan.catch_time_s = problem_->start_s + best_s_;
  plan.earliest_catch_s = problem_->start_s + earliest_s_;
  plan.cost = plan.lower_bound = static_cast<std::uint64_t>(best_);
  return plan;
}

}  // namespace outrider
