#include "proof/finish.hpp"

#include <bit>
#include <map>

#include "dominance.hpp"

namespace outrider::tour {
namespace {

constexpr double tie = 1e-9;
constexpr std::size_t most_in_a_visit = 16;

/// The tours that end with the same visit.
struct FinishLabel {
  double time = 0.0;
  State state;
  std::uint32_t parent = none;       // the visit before, in the log
  std::vector<std::uint32_t> nodes;  // of the last visit, in order
};

struct LoggedVisit {
  std::uint32_t parent = none;
  std::vector<std::uint32_t> nodes;
};

/// A set of goals that a visit may serve.
struct Choice {
  GoalSet set = 0;
  double least_time = 0.0;
};

/// The orders of a visit's services by dynamic programming: for each set, the best way to end with each.
struct Orders {
  std::vector<std::uint32_t> nodes;
  std::vector<double> time;            // [set * nodes + last], the drive to the stop included
  std::vector<std::uint8_t> previous;  // the same

  /// The best order of all that ends so.
  [[nodiscard]] std::vector<std::uint32_t> ending(std::size_t last) const;
};

std::vector<std::uint32_t> Orders::ending(std::size_t last) const {
  std::vector<std::uint32_t> order(nodes.size());
  std::size_t set = (std::size_t{1} << nodes.size()) - 1;
  for (std::size_t i = nodes.size(); i-- > 0;) {
    order[i] = nodes[last];
    const std::size_t before = previous[set * nodes.size() + last];
    set &= ~(std::size_t{1} << last);
    last = before;
  }
  return order;
}

/// `there` has just come to the stop of the nodes.
Orders orders_of(const Instance& instance, const FinishLabel& there, std::vector<std::uint32_t> nodes) {
  const std::size_t count = nodes.size();
  Orders orders{std::move(nodes), std::vector<double>(count << count, infinity),
                std::vector<std::uint8_t>(count << count, 0)};
  for (std::size_t set = 1; set < std::size_t{1} << count; ++set) {
    for (std::size_t lasts = set; lasts != 0; lasts &= lasts - 1) {
      const auto last = static_cast<std::size_t>(std::countr_zero(lasts));
      const TourNode& node = instance.nodes[orders.nodes[last]];
      const std::size_t rest = set & ~(std::size_t{1} << last);
      double& best = orders.time[set * count + last];
      if (rest == 0) {
        State state = there.state;
        best = there.time + advance(instance, state, node);
      }
      for (std::size_t bits = rest; bits != 0; bits &= bits - 1) {
        const auto p = static_cast<std::size_t>(std::countr_zero(bits));
        const TourNode& before = instance.nodes[orders.nodes[p]];
        const double time = orders.time[rest * count + p] + node.duration +
                            aim_time(instance, before.yaw, before.pitch, node.yaw, node.pitch);
        if (time >= best) continue;
        best = time;
        orders.previous[set * count + last] = static_cast<std::uint8_t>(p);
      }
    }
  }
  return orders;
}

class Finishing {
 public:
  Finishing(const SweepContext& context, const Sweep& back, const std::vector<std::uint32_t>& goals,
            const Bundles& bundles, Finish& result);
  void run(std::uint64_t most_labels, BudgetMeter& meter);

 private:
  void expand(GoalSet set, const FinishLabel& label);
  void visit(GoalSet set, const FinishLabel& there);
  void serve(GoalSet set, const FinishLabel& there, GoalSet bundle, double to_go);
  void add(GoalSet set, FinishLabel label);
  void end(const FinishLabel& label);
  [[nodiscard]] bool hopeless(double time) const {
    return time >= std::min(context_.limit, result_.cost) - tie;
  }
  [[nodiscard]] double outside(GoalSet set) const;
  [[nodiscard]] const SweepRow* row(const Rows& rows, GoalSet set) const;
  [[nodiscard]] double slack(const FinishLabel& a, const FinishLabel& b) const;
  [[nodiscard]] std::uint32_t sector(const State& state) const {
    return context_.drives.sectors > 1 ? sector_of(state.heading, context_.drives.sectors) : 0;
  }

  const SweepContext& context_;
  const Instance& instance_;
  const Sweep& back_;
  const std::vector<std::uint32_t>& goals_;
  Finish& result_;
  GoalSet full_, known_;
  std::vector<std::vector<Choice>> choices_;  // by stop
  std::vector<GoalSet> fresh_;                // stop -> what it serves that `back` does not know
  std::vector<bool> joined_;                  // stop -> a drive from it takes no time
  std::map<GoalSet, std::vector<FinishLabel>> pending_;
  std::vector<LoggedVisit> log_;
  bool too_large_ = false;
};

Finishing::Finishing(const SweepContext& context, const Sweep& back, const std::vector<std::uint32_t>& goals,
                     const Bundles& bundles, Finish& result)
    : context_(context),
      instance_(context.instance),
      back_(back),
      goals_(goals),
      result_(result),
      full_(first_of(goals.size())),
      known_(first_of(back.goals.size())),
      choices_(instance_.stops),
      fresh_(instance_.stops, 0),
      joined_(instance_.stops, false) {
  for (const Bundle& bundle : bundles) {
    for (const Way& way : bundle.ways) {
      choices_[way.stop].push_back({bundle.set, rounded_down * static_cast<double>(way.time)});
      fresh_[way.stop] |= bundle.set & ~known_;
    }
  }
  for (std::uint32_t from = 0; from < instance_.stops; ++from) {
    for (std::uint32_t to = 0; to < instance_.stops; ++to) {
      if (instance_.time[instance_.arc(from, to)] == 0.0) joined_[from] = true;
    }
  }
}

/// After a drive of no time something may be served at the same place.
double Finishing::slack(const FinishLabel& a, const FinishLabel& b) const {
  return joined_[a.state.stop] ? loss_before_a_service(instance_, a.state, b.state)
                               : loss_before_a_drive(instance_, a.state, b.state);
}

/// Least durations of the goals that are neither served nor known to the sweep.
double Finishing::outside(GoalSet set) const {
  double time = 0.0;
  for (std::size_t bit = back_.goals.size(); bit < goals_.size(); ++bit) {
    if ((set >> bit & 1U) == 0) time += context_.durations[goals_[bit]];
  }
  return time;
}

const SweepRow* Finishing::row(const Rows& rows, GoalSet set) const {
  const auto found = rows.find(known_ & ~set);
  return found == rows.end() ? nullptr : &found->second;
}

void Finishing::end(const FinishLabel& label) {
  if (hopeless(label.time)) return;
  result_.cost = label.time;
  result_.nodes.assign(label.nodes.rbegin(), label.nodes.rend());
  for (std::uint32_t i = label.parent; i != none; i = log_[i].parent) {
    result_.nodes.insert(result_.nodes.end(), log_[i].nodes.rbegin(), log_[i].nodes.rend());
  }
  std::ranges::reverse(result_.nodes);
}

void Finishing::add(GoalSet set, FinishLabel label) {
  if (set == full_) return end(label);
  std::vector<FinishLabel>& labels = pending_[set];
  const auto same_stop = [&](const FinishLabel& other) { return other.state.stop == label.state.stop; };
  for (const FinishLabel& other : labels) {
    if (same_stop(other) && other.time + slack(other, label) <= label.time + tie) return;
  }
  std::erase_if(labels, [&](const FinishLabel& other) {
    return same_stop(other) && label.time + slack(label, other) <= other.time;
  });
  labels.push_back(std::move(label));
}

/// The labels that serve the bundle where `there` has just come to, one for each last service.
void Finishing::serve(GoalSet set, const FinishLabel& there, GoalSet bundle, double to_go) {
  std::vector<std::uint32_t> nodes;
  for (GoalSet bits = bundle; bits != 0; bits &= bits - 1) {
    nodes.push_back(
        instance_.node(there.state.stop, goals_[static_cast<std::size_t>(std::countr_zero(bits))]));
  }
  if (nodes.size() > most_in_a_visit) {
    too_large_ = true;
    return;
  }
  const Orders orders = orders_of(instance_, there, std::move(nodes));
  const std::size_t count = orders.nodes.size();
  for (std::size_t last = 0; last < count; ++last) {
    const double time = orders.time[((std::size_t{1} << count) - 1) * count + last];
    if (hopeless(time + to_go)) continue;
    const TourNode& node = instance_.nodes[orders.nodes[last]];
    const State& body = there.state;
    add(set | bundle, {time,
                       {body.stop, body.heading, node.yaw - body.heading, node.pitch},
                       there.parent,
                       orders.ending(last)});
  }
}

void Finishing::visit(GoalSet set, const FinishLabel& there) {
  const std::uint32_t stop = there.state.stop;
  const std::uint32_t q = sector(there.state);
  for (const Choice& choice : choices_[stop]) {
    if ((choice.set & set) != 0) continue;
    const GoalSet more = set | choice.set;
    const SweepRow* const left = row(back_.rows, more);
    const float* const beyond = left == nullptr ? nullptr : left->find(stop);
    if (beyond == nullptr) continue;
    const double to_go = rounded_down * static_cast<double>(beyond[q]) + outside(more);
    if (!hopeless(there.time + choice.least_time + to_go)) serve(set, there, choice.set, to_go);
  }
}

/// Drives to each stop from which the rest can still be served in time.
void Finishing::expand(GoalSet set, const FinishLabel& label) {
  const SweepRow* const ahead = row(back_.ahead, set);
  const SweepRow* const beyond = row(back_.rows, set);
  const double left = outside(set);
  for (std::uint32_t stop = 0; stop < instance_.stops; ++stop) {
    if (stop == label.state.stop && set != 0) continue;
    const float* const serving = ahead == nullptr ? nullptr : ahead->find(stop);
    const bool fresh = beyond != nullptr && (fresh_[stop] & ~set) != 0;
    const float* const passing = fresh ? beyond->find(stop) : nullptr;
    if (serving == nullptr && passing == nullptr) continue;
    FinishLabel there = {label.time, label.state, static_cast<std::uint32_t>(log_.size() - 1), {}};
    there.time += drive(instance_, there.state, stop);
    const std::uint32_t q = sector(there.state);
    float least = std::numeric_limits<float>::infinity();
    if (serving != nullptr) least = serving[q];
    if (passing != nullptr) least = std::min(least, passing[q]);
    if (!hopeless(there.time + rounded_down * static_cast<double>(least) + left)) visit(set, there);
  }
}

void Finishing::run(std::uint64_t most_labels, BudgetMeter& meter) {
  pending_[0].push_back({0.0, start_of(instance_), none, {}});
  while (!pending_.empty()) {
    auto next = pending_.extract(pending_.begin());
    for (FinishLabel& label : next.mapped()) {
      if (too_large_ || result_.labels >= most_labels || !meter.spend()) return;
      ++result_.labels;
      log_.push_back({label.parent, std::move(label.nodes)});
      expand(next.key(), label);
    }
  }
  result_.finished = !too_large_;
}

}  // namespace

Finish finish(const SweepContext& context, const Sweep& back, const std::vector<std::uint32_t>& goals,
              const Bundles& bundles, std::uint64_t most_labels, BudgetMeter& meter) {
  Finish result;
  Finishing(context, back, goals, bundles, result).run(most_labels, meter);
  return result;
}

}  // namespace outrider::tour
