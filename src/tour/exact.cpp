#include "exact.hpp"

#include <queue>

#include "dominance.hpp"
#include "proof/relaxation.hpp"

namespace outrider::tour {
namespace {

constexpr double tie = 1e-9;
constexpr std::size_t most_labels = 6'000'000;
constexpr double most_work = 6e9;      // of the relaxation with one sector
constexpr double pleasant_work = 3e8;  // up to which more sectors are worth it
constexpr double most_entries = 2e7;

struct TourLabel {
  double time = 0.0;
  State state;
  std::uint32_t set = 0;  // goals served
  std::uint32_t node = none;
  std::uint32_t parent = none;
  std::uint32_t next = none;  // older label with the same set and stop
  bool dominated = false;
};

double relaxation_work(const Instance& instance) {
  return std::ldexp(static_cast<double>(instance.stops) * instance.stops, static_cast<int>(instance.goals));
}

std::uint32_t choose_sectors(const Instance& instance) {
  const double entries = std::ldexp(static_cast<double>(instance.stops), static_cast<int>(instance.goals));
  std::uint32_t sectors = 16;
  while (sectors > 1 &&
         (relaxation_work(instance) * sectors > pleasant_work || entries * sectors > most_entries)) {
    sectors /= 2;
  }
  return sectors;
}

class Search {
 public:
  Search(const Instance& instance, const Relaxation& relaxation, double known_cost)
      : instance_(instance),
        relaxation_(relaxation),
        all_((1U << instance.goals) - 1),
        best_cost_(known_cost),
        nearby_(relaxation.covered),
        newest_((std::size_t{all_} + 1) * instance.stops, none) {
    for (std::uint32_t from = 0; from < instance.stops; ++from) {
      for (std::uint32_t to = 0; to < instance.stops; ++to) {
        if (instance.time[instance.arc(from, to)] == 0.0) nearby_[from] |= relaxation.covered[to];
      }
    }
  }

  Exact run(std::uint64_t expansions, BudgetMeter& meter);

 private:
  void expand(std::uint32_t index);
  void visit(std::uint32_t index, std::uint32_t stop);
  void add(TourLabel label);
  bool is_dominated(const TourLabel& label);
  [[nodiscard]] double slack(const TourLabel& a, const TourLabel& b) const;
  [[nodiscard]] double to_go(const std::vector<float>& table, const TourLabel& label) const;
  void finish(const TourLabel& label);

  const Instance& instance_;
  const Relaxation& relaxation_;
  std::uint32_t all_;
  double best_cost_;
  std::vector<std::uint32_t> best_nodes_;
  std::vector<TourLabel> labels_;
  std::vector<std::uint32_t> nearby_;  // stop -> goals that can be served there without driving
  std::vector<std::uint32_t> newest_;  // [set * stops + stop] -> its newest label
  std::priority_queue<Open> open_;
};

double Search::slack(const TourLabel& a, const TourLabel& b) const {
  const bool drives_next = (nearby_[a.state.stop] & ~a.set) == 0;
  return drives_next ? loss_before_a_drive(instance_, a.state, b.state)
                     : loss_before_a_service(instance_, a.state, b.state);
}

bool Search::is_dominated(const TourLabel& label) {
  for (std::uint32_t i = newest_[std::size_t{label.set} * instance_.stops + label.state.stop]; i != none;
       i = labels_[i].next) {
    TourLabel& other = labels_[i];
    if (other.dominated) continue;
    const double between = slack(other, label);
    if (other.time + between <= label.time + tie) return true;
    if (label.time + between <= other.time) other.dominated = true;
  }
  return false;
}

double Search::to_go(const std::vector<float>& table, const TourLabel& label) const {
  const std::uint32_t sector = sector_of(label.state.heading, relaxation_.sectors);
  return rounded_down *
         static_cast<double>(table[relaxation_.index(all_ & ~label.set, label.state.stop, sector)]);
}

void Search::finish(const TourLabel& label) {
  best_cost_ = label.time;
  best_nodes_.assign(1, label.node);
  for (std::uint32_t i = label.parent; labels_[i].node != none; i = labels_[i].parent) {
    best_nodes_.push_back(labels_[i].node);
  }
  std::ranges::reverse(best_nodes_);
}

void Search::add(TourLabel label) {
  const double estimate = label.time + to_go(relaxation_.served, label);
  if (estimate >= best_cost_ - tie) return;
  if (label.set == all_) return finish(label);
  if (is_dominated(label)) return;
  std::uint32_t& newest = newest_[std::size_t{label.set} * instance_.stops + label.state.stop];
  label.next = newest;
  newest = static_cast<std::uint32_t>(labels_.size());
  open_.push({estimate, newest});
  labels_.push_back(label);
}

/// The labels that serve one goal more at that stop, driving there where need be.
void Search::visit(std::uint32_t index, std::uint32_t stop) {
  const TourLabel from = labels_[index];
  if (stop != from.state.stop) {
    TourLabel there = from;
    there.time += drive(instance_, there.state, stop);
    if (there.time + to_go(relaxation_.arrived, there) >= best_cost_ - tie) return;
  }
  for (std::uint32_t n = instance_.first[stop]; n < instance_.first[stop + 1]; ++n) {
    const std::uint32_t bit = 1U << instance_.nodes[n].goal;
    if ((from.set & bit) != 0) continue;
    TourLabel label{from.time, from.state, from.set | bit, n, index, none, false};
    label.time += advance(instance_, label.state, instance_.nodes[n]);
    add(label);
  }
}

void Search::expand(std::uint32_t index) {
  const std::uint32_t left = all_ & ~labels_[index].set;
  for (std::uint32_t stop = 0; stop < instance_.stops; ++stop) {
    if ((relaxation_.covered[stop] & left) != 0) visit(index, stop);
  }
}

Exact Search::run(std::uint64_t expansions, BudgetMeter& meter) {
  Exact result;
  TourLabel start;
  start.state = start_of(instance_);
  labels_.push_back(start);
  open_.push({0.0, 0});
  while (!open_.empty() && open_.top().estimate < best_cost_ - tie) {
    const Open next = open_.top();
    result.lower_bound = std::max(result.lower_bound, next.estimate);
    if (!labels_[next.label].dominated) {
      if (result.expansions >= expansions || labels_.size() >= most_labels || !meter.spend()) {
        result.nodes = std::move(best_nodes_);
        return result;
      }
      ++result.expansions;
      open_.pop();
      expand(next.label);
      continue;
    }
    open_.pop();
  }
  result.nodes = std::move(best_nodes_);
  result.lower_bound = best_cost_;
  result.finished = true;
  return result;
}

}  // namespace

bool exact_is_possible(const Instance& instance) {
  const double entries = std::ldexp(static_cast<double>(instance.stops), static_cast<int>(instance.goals));
  return instance.goals <= 16 && relaxation_work(instance) <= most_work && entries <= most_entries;
}

Exact search_exactly(const Instance& instance, double known_cost, const TourOptions& options,
                     BudgetMeter& meter) {
  std::vector<std::uint32_t> goals(instance.goals);
  for (std::uint32_t goal = 0; goal < instance.goals; ++goal) goals[goal] = goal;
  const auto relaxation = relax(instance, goals, sectored(instance, choose_sectors(instance)), meter);
  if (!relaxation) return {};
  return Search(instance, *relaxation, known_cost).run(static_cast<std::uint64_t>(options.expansions), meter);
}

}  // namespace outrider::tour
