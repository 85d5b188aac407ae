#include "supply/supply_exact.hpp"

#include <queue>

#include "dominance.hpp"
#include "proof/relaxation.hpp"

namespace outrider::tour {
namespace {

constexpr double tie = 1e-9;
constexpr std::size_t most_labels = 3'000'000;
constexpr double most_entries = 2e7;
constexpr double most_work = 1e9;

struct SupplyLabel {
  Fuel fuel;
  std::uint32_t set = 0;  // goals served
  std::uint32_t choice = none;
  std::uint32_t parent = none;
  std::uint32_t next = none;  // older label with the same set and stop
  bool dominated = false;
};

/// Drives without turns, directly or by depots.
RelaxedDrives by_depots(const Supplied& supplied) {
  RelaxedDrives drives = sectored(supplied.instance, 1);
  const std::uint32_t stops = supplied.instance.stops;
  for (const FuelStation& depot : supplied.depots) {
    for (std::uint32_t to = 0; to < stops; ++to) {
      const float onward = drives.time_to[std::size_t{to} * stops + depot.stop];
      for (std::uint32_t from = 0; from < stops; ++from) {
        float& direct = drives.time_to[std::size_t{to} * stops + from];
        direct = std::min(direct, drives.time_to[std::size_t{depot.stop} * stops + from] + onward);
      }
    }
  }
  return drives;
}

class Search {
 public:
  Search(const Supplied& supplied, const Relaxation& relaxation, double known_cost)
      : supplied_(supplied),
        instance_(supplied.instance),
        relaxation_(relaxation),
        all_((1U << instance_.goals) - 1),
        best_cost_(known_cost),
        beside_depot_(instance_.stops, false),
        newest_((std::size_t{all_} + 1) * instance_.stops, none) {
    for (std::uint32_t stop = 0; stop < instance_.stops; ++stop) {
      for (const FuelStation& depot : supplied.depots) {
        if (depot.stop == stop || instance_.time[instance_.arc(stop, depot.stop)] == 0.0) {
          beside_depot_[stop] = true;
        }
      }
    }
  }

  SupplyExact run(std::uint64_t expansions, BudgetMeter& meter) {
    SupplyExact result;
    SupplyLabel start;
    start.fuel = full_at_start(supplied_);
    labels_.push_back(start);
    open_.push({0.0, 0});
    while (!open_.empty() && open_.top().estimate < best_cost_ - tie) {
      const std::uint32_t next = open_.top().label;
      open_.pop();
      if (labels_[next].dominated) continue;
      if (result.expansions >= expansions || labels_.size() >= most_labels || !meter.spend()) {
        result.choices = std::move(best_);
        return result;
      }
      ++result.expansions;
      expand(next);
    }
    result.choices = std::move(best_);
    result.finished = true;
    return result;
  }

 private:
  void expand(std::uint32_t index) {
    const SupplyLabel from = labels_[index];
    const auto nodes = static_cast<std::uint32_t>(instance_.nodes.size());
    for (std::uint32_t n = 0; n < nodes; ++n) {
      const std::uint32_t bit = 1U << instance_.nodes[n].goal;
      if ((from.set & bit) != 0) continue;
      SupplyLabel label{from.fuel, from.set | bit, n, index, none, false};
      if (serve(supplied_, label.fuel, instance_.nodes[n])) add(label);
    }
    for (std::uint32_t d = 0; d < supplied_.depots.size(); ++d) {
      SupplyLabel label{from.fuel, from.set, nodes + d, index, none, false};
      if (fill(supplied_, label.fuel, supplied_.depots[d])) add(label);
    }
  }

  void add(SupplyLabel label) {
    const std::uint32_t left = all_ & ~label.set;
    const float to_go = relaxation_.served[relaxation_.index(left, label.fuel.state.stop, 0)];
    const double estimate = label.fuel.time + rounded_down * static_cast<double>(to_go);
    if (!(estimate < best_cost_ - tie)) return;
    if (left == 0) return finish(label);
    if (is_dominated(label)) return;
    std::uint32_t& newest = newest_[std::size_t{label.set} * instance_.stops + label.fuel.state.stop];
    label.next = newest;
    newest = static_cast<std::uint32_t>(labels_.size());
    open_.push({estimate, newest});
    labels_.push_back(label);
  }

  void finish(const SupplyLabel& label) {
    best_cost_ = label.fuel.time;
    best_.assign(1, label.choice);
    for (std::uint32_t i = label.parent; labels_[i].choice != none; i = labels_[i].parent) {
      best_.push_back(labels_[i].choice);
    }
    std::ranges::reverse(best_);
  }

  [[nodiscard]] double slack(const State& a, const State& b) const {
    const bool turned = angle_between(a.heading, b.heading) > 0.0;
    if (turned && beside_depot_[a.stop] && supplied_.per_second > 0.0) return infinity;
    return loss_before_a_service(instance_, a, b);
  }

  [[nodiscard]] bool dominates(const Fuel& a, const Fuel& b, double margin) const {
    if (a.water < b.water || a.time > b.time + margin) return false;
    const double between = slack(a.state, b.state);
    if (!(a.time + between <= b.time + margin)) return false;
    return std::isinf(b.charge) || a.charge - supplied_.per_second * between >= b.charge;
  }

  bool is_dominated(const SupplyLabel& label) {
    for (std::uint32_t i = newest_[std::size_t{label.set} * instance_.stops + label.fuel.state.stop];
         i != none; i = labels_[i].next) {
      SupplyLabel& other = labels_[i];
      if (other.dominated) continue;
      if (dominates(other.fuel, label.fuel, tie)) return true;
      if (dominates(label.fuel, other.fuel, 0.0)) other.dominated = true;
    }
    return false;
  }

  const Supplied& supplied_;
  const Instance& instance_;
  const Relaxation& relaxation_;
  std::uint32_t all_;
  double best_cost_;
  std::vector<bool> beside_depot_;
  std::vector<std::uint32_t> best_;
  std::vector<SupplyLabel> labels_;
  std::vector<std::uint32_t> newest_;  // [set * stops + stop] -> its newest label
  std::priority_queue<Open> open_;
};

}  // namespace

bool exact_is_possible(const Supplied& supplied) {
  const auto goals = static_cast<int>(supplied.instance.goals);
  const double stops = supplied.instance.stops;
  return goals <= 16 && std::ldexp(stops, goals) <= most_entries &&
         std::ldexp(stops * stops, goals) <= most_work;
}

SupplyExact search_exactly(const Supplied& supplied, double known_cost, std::uint64_t expansions,
                           BudgetMeter& meter) {
  std::vector<std::uint32_t> goals(supplied.instance.goals);
  for (std::uint32_t goal = 0; goal < supplied.instance.goals; ++goal) goals[goal] = goal;
  const auto relaxation = relax(supplied.instance, goals, by_depots(supplied), meter);
  if (!relaxation) return {};
  return Search(supplied, *relaxation, known_cost).run(expansions, meter);
}

}  // namespace outrider::tour
