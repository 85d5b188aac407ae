#include "proof/sweep.hpp"

#include <map>

namespace outrider::tour {
namespace {

class Sweeping {
 public:
  Sweeping(SweepContext& context, const Sweep& before, Bundles& bundles, Sweep& result);
  void run(BudgetMeter& meter);

 private:
  void work(GoalSet set, const SweepRow& row);
  void go(GoalSet set, const SweepRow& row);
  void drive(const std::vector<std::uint32_t>& stops);
  void drive_forward(std::uint32_t from, std::uint32_t to);
  void drive_backward(std::uint32_t from, std::uint32_t to);
  void pass_by(GoalSet set);
  void serve(GoalSet set);
  void store(GoalSet set);
  [[nodiscard]] const SweepRow* opposite(GoalSet set) const;
  [[nodiscard]] double rest(GoalSet set) const;
  void keep(std::uint32_t stop, std::uint32_t sector) { kept_[stop * sectors_ + sector] = true; }

  SweepContext& context_;
  const Instance& instance_;
  const RelaxedDrives& drives_;
  const Sweep& before_;
  Bundles& bundles_;
  std::vector<GoalSet> sets_;  // of the bundles
  Sweep& result_;
  GoalSet full_, known_;
  std::uint32_t stops_, sectors_;
  std::uint32_t heading_;              // at the start, its sector
  double limit_;                       // as sums of floats, which are rounded, are compared with it
  std::vector<std::uint32_t> useful_;  // stops
  std::vector<std::uint32_t> others_;  // stops that serve goals which were not chosen
  std::map<GoalSet, SweepRow> pending_;
  std::vector<float> in_, out_;                  // before and after the drives, in the direction of the sweep
  std::vector<std::uint32_t> lowest_, highest_;  // stop -> the sectors between which in_ is finite
  std::vector<bool> kept_;
  std::uint64_t operations_ = 0;
};

Sweeping::Sweeping(SweepContext& context, const Sweep& before, Bundles& bundles, Sweep& result)
    : context_(context),
      instance_(context.instance),
      drives_(context.drives),
      before_(before),
      bundles_(bundles),
      result_(result),
      full_(first_of(result.goals.size())),
      known_(first_of(before.goals.size())),
      stops_(context.instance.stops),
      sectors_(context.drives.sectors),
      heading_(sectors_ > 1 ? sector_of(instance_.heading, sectors_) : 0),
      limit_(context.limit / rounded_down),
      in_(std::size_t{stops_} * sectors_, never),
      out_(in_.size(), never),
      lowest_(stops_, 0),
      highest_(stops_, 0),
      kept_(in_.size(), false) {
  std::vector<bool> chosen(instance_.goals, false);
  for (const std::uint32_t goal : result.goals) chosen[goal] = true;
  std::vector<bool> useful(stops_, false);
  std::vector<bool> other(stops_, false);
  for (const Bundle& bundle : bundles) {
    sets_.push_back(bundle.set);
    for (const Way& way : bundle.ways) useful[way.stop] = true;
  }
  for (const TourNode& node : instance_.nodes) other[node.stop] = other[node.stop] || !chosen[node.goal];
  for (std::uint32_t stop = 0; stop < stops_; ++stop) {
    if (other[stop]) others_.push_back(stop);
    if (useful[stop] || other[stop] || stop == 0) useful_.push_back(stop);
  }
}

/// The row of the opposite sweep that meets these states; null when no tour below the limit passes them.
const SweepRow* Sweeping::opposite(GoalSet set) const {
  const auto found = before_.rows.find(known_ & ~set);
  return found == before_.rows.end() ? nullptr : &found->second;
}

/// Returns the time that neither this sweep nor the opposite one has counted when they meet.
double Sweeping::rest(GoalSet set) const {
  double time = result_.outside;
  for (std::size_t bit = before_.goals.size(); bit < result_.goals.size(); ++bit) {
    if ((set >> bit & 1U) == 0) time += context_.durations[result_.goals[bit]];
  }
  return time;
}

/// out[to] from in[from].
void Sweeping::drive_forward(std::uint32_t from, std::uint32_t to) {
  const std::size_t entry = instance_.arc(to, from);
  const float* const in = &in_[std::size_t{from} * sectors_];
  float* const out = &out_[std::size_t{to} * sectors_];
  if (sectors_ > 1 && drives_.arriving[entry] == same_sector) {
    for (std::uint32_t q = 0; q < sectors_; ++q) out[q] = std::min(out[q], in[q]);
    return;
  }
  float least = never;
  for (std::uint32_t q = lowest_[from]; q <= highest_[from]; ++q) {
    least = std::min(least, in[q] + (sectors_ > 1 ? drives_.turn[entry * sectors_ + q] : 0.0F));
  }
  float& there = out[sectors_ > 1 ? drives_.arriving[entry] : 0];
  there = std::min(there, least + drives_.time_to[entry]);
}

/// out[from] from in[to].
void Sweeping::drive_backward(std::uint32_t from, std::uint32_t to) {
  const std::size_t entry = instance_.arc(to, from);
  const float* const in = &in_[std::size_t{to} * sectors_];
  float* const out = &out_[std::size_t{from} * sectors_];
  if (sectors_ > 1 && drives_.arriving[entry] == same_sector) {
    for (std::uint32_t q = 0; q < sectors_; ++q) out[q] = std::min(out[q], in[q]);
    return;
  }
  const float there = in[sectors_ > 1 ? drives_.arriving[entry] : 0] + drives_.time_to[entry];
  if (there == never) return;
  for (std::uint32_t q = 0; q < sectors_; ++q) {
    const float turn = sectors_ > 1 ? drives_.turn[entry * sectors_ + q] : 0.0F;
    out[q] = std::min(out[q], there + turn);
  }
}

void Sweeping::drive(const std::vector<std::uint32_t>& stops) {
  operations_ += stops.size() * useful_.size();
  for (const std::uint32_t stop : stops) {
    lowest_[stop] = sectors_ - 1;
    highest_[stop] = 0;
    for (std::uint32_t q = 0; q < sectors_; ++q) {
      if (in_[std::size_t{stop} * sectors_ + q] == never) continue;
      lowest_[stop] = std::min(lowest_[stop], q);
      highest_[stop] = q;
    }
  }
  // The tables lie by the stop driven to, so that it is in the outer loop.
  for (const std::uint32_t to : result_.forward ? useful_ : stops) {
    for (const std::uint32_t from : result_.forward ? stops : useful_) {
      if (from == to) continue;
      result_.forward ? drive_forward(from, to) : drive_backward(from, to);
    }
  }
}

/// Visits that serve none of the chosen goals: whoever came may go on.
void Sweeping::pass_by(GoalSet set) {
  const SweepRow* const opposite_row = opposite(set);
  if (opposite_row == nullptr) return;
  const double left = rest(set);
  for (std::vector<std::uint32_t> changed = others_; !changed.empty();) {
    std::vector<std::uint32_t> next;
    for (const std::uint32_t stop : changed) {
      const float* const on = opposite_row->find(stop);
      if (on == nullptr) continue;
      bool better = false;
      for (std::uint32_t q = 0; q < sectors_; ++q) {
        const std::size_t i = std::size_t{stop} * sectors_ + q;
        if (static_cast<double>(out_[i]) + static_cast<double>(on[q]) + left >= limit_) continue;
        keep(stop, q);
        if (out_[i] >= in_[i]) continue;
        in_[i] = out_[i];
        better = true;
      }
      if (better) next.push_back(stop);
    }
    drive(next);
    changed = next.empty() ? next : others_;
  }
}

/// Hands the values on to the sets that have one bundle more.
void Sweeping::serve(GoalSet set) {
  operations_ += bundles_.size();
  for (std::size_t b = 0; b < bundles_.size(); ++b) {
    if ((sets_[b] & set) != 0) continue;
    const GoalSet more = set | sets_[b];
    const SweepRow* const opposite_row = opposite(more);
    if (opposite_row == nullptr) continue;
    const double left = rest(more);
    SweepRow* target = nullptr;
    for (Way& way : bundles_[b].ways) {
      const float* const on = opposite_row->find(way.stop);
      if (on == nullptr) continue;
      float* to = nullptr;
      for (std::uint32_t q = 0; q < sectors_; ++q) {
        const float value = out_[std::size_t{way.stop} * sectors_ + q] + way.time;
        if (!(static_cast<double>(value) + static_cast<double>(on[q]) + left < limit_)) continue;
        if (target == nullptr) target = &pending_.try_emplace(more, stops_, sectors_).first->second;
        if (to == nullptr) to = target->at(way.stop);
        to[q] = std::min(to[q], value);
        way.needed = true;
        keep(way.stop, q);
      }
    }
  }
}

/// Fills out_ from the values of the set, which are before the drives.
void Sweeping::go(GoalSet set, const SweepRow& row) {
  std::ranges::fill(in_, never);
  std::ranges::fill(out_, never);
  for (const std::uint32_t stop : row.stops()) {
    std::copy_n(row.find(stop), sectors_, in_.begin() + stop * sectors_);
  }
  if (set == 0 && !result_.forward) {
    std::ranges::fill(out_, 0.0F);
    return;
  }
  drive(row.stops());
  if (set == 0) out_[heading_] = 0.0F;
}

/// Keeps those values of out_ from which a tour that matters goes on.
void Sweeping::store(GoalSet set) {
  SweepRow row(stops_, sectors_);
  for (const std::uint32_t stop : useful_) {
    for (std::uint32_t q = 0; q < sectors_; ++q) {
      const std::size_t i = std::size_t{stop} * sectors_ + q;
      if (kept_[i]) row.at(stop)[q] = out_[i];
    }
  }
  if (!row.stops().empty()) result_.rows.emplace(set, std::move(row));
}

void Sweeping::work(GoalSet set, const SweepRow& row) {
  kept_.assign(kept_.size(), false);
  go(set, row);
  pass_by(set);
  if (set == full_) {
    const float best =
        result_.forward ? *std::ranges::min_element(in_) : std::min(in_[heading_], out_[heading_]);
    result_.bound = std::min(result_.bound, static_cast<double>(best) * rounded_down + result_.outside);
  }
  serve(set);
  store(set);
}

void Sweeping::run(BudgetMeter& meter) {
  SweepRow& nothing = pending_.try_emplace(0, stops_, sectors_).first->second;
  if (result_.forward) nothing.at(0)[heading_] = 0.0F;
  while (!pending_.empty()) {
    if (!meter.spend()) return;
    operations_ = 0;
    auto next = pending_.extract(pending_.begin());
    work(next.key(), next.mapped());
    if (!result_.forward) result_.ahead.emplace(next.key(), std::move(next.mapped()));
    if (operations_ > context_.operations) return;
    context_.operations -= operations_;
  }
  result_.finished = true;
}

}  // namespace

float* SweepRow::at(std::uint32_t stop) {
  if (block_[stop] == absent) {
    block_[stop] = static_cast<std::uint16_t>(stops_.size());
    stops_.push_back(stop);
    values_.resize(values_.size() + sectors_, never);
  }
  return &values_[std::size_t{block_[stop]} * sectors_];
}

Sweep nothing_swept(const SweepContext& context, bool forward) {
  Sweep result;
  result.forward = forward;
  SweepRow row(context.instance.stops, context.drives.sectors);
  for (std::uint32_t stop = 0; stop < context.instance.stops; ++stop) {
    std::fill_n(row.at(stop), context.drives.sectors, 0.0F);
  }
  result.rows.emplace(0, std::move(row));
  return result;
}

Sweep sweep(SweepContext& context, const Sweep& before, std::vector<std::uint32_t> goals, Bundles& bundles,
            BudgetMeter& meter) {
  Sweep result;
  result.forward = !before.forward;
  result.goals = std::move(goals);
  result.bound = context.limit;
  for (const double duration : context.durations) result.outside += duration;
  for (const std::uint32_t goal : result.goals) result.outside -= context.durations[goal];
  Sweeping(context, before, bundles, result).run(meter);
  return result;
}

}  // namespace outrider::tour
