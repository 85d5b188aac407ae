#include "proof/proof.hpp"

#include "proof/finish.hpp"
#include "proof/remainder.hpp"

namespace outrider::tour {
namespace {

constexpr std::size_t first_goals = 8;  // of the first sweep
constexpr std::size_t more_goals = 2;   // of each further one
constexpr std::size_t most_goals = 40;  // of all, beyond which sweeps do not get far
constexpr std::size_t most_apart = 10;  // goals whose drives and turns a remainder follows
constexpr std::uint32_t most_sectors = 32;
constexpr double most_turns = 3.2e7;  // table entries
constexpr double a_hair = 1e-12;      // so that the gap left rounds to no more than what was asked

std::uint32_t choose_sectors(const Instance& instance) {
  const double drives = static_cast<double>(instance.stops) * instance.stops;
  std::uint32_t sectors = most_sectors;
  while (sectors > 1 && drives * sectors > most_turns) sectors /= 2;
  return sectors;
}

std::vector<double> least_durations(const Instance& instance) {
  std::vector<double> least(instance.goals, infinity);
  for (const TourNode& node : instance.nodes) least[node.goal] = std::min(least[node.goal], node.duration);
  return least;
}

/// Each goal as far as can be from those before it and from the start, by the drives between the stops where
/// the known tour serves them; among equals, that with the fewest services.
std::vector<std::uint32_t> spread(const Instance& instance, const Route& known) {
  std::vector<std::uint32_t> stop_of(instance.goals, 0);
  for (const std::uint32_t node : known.nodes) stop_of[instance.nodes[node].goal] = instance.nodes[node].stop;
  const auto far = [&](std::uint32_t from, std::uint32_t to) {
    return from == to ? 0.0 : instance.time[instance.arc(from, to)];
  };
  std::vector<double> away(instance.goals);
  for (std::uint32_t goal = 0; goal < instance.goals; ++goal) away[goal] = far(0, stop_of[goal]);
  std::vector<std::uint32_t> order;
  std::vector<bool> taken(instance.goals, false);
  while (order.size() < instance.goals) {
    std::uint32_t best = none;
    for (std::uint32_t goal = 0; goal < instance.goals; ++goal) {
      if (taken[goal]) continue;
      const auto fewer = [&] { return instance.nodes_of[goal].size() < instance.nodes_of[best].size(); };
      if (best == none || away[goal] > away[best] || (away[goal] == away[best] && fewer())) best = goal;
    }
    order.push_back(best);
    taken[best] = true;
    for (std::uint32_t goal = 0; goal < instance.goals; ++goal) {
      away[goal] =
          std::min({away[goal], far(stop_of[best], stop_of[goal]), far(stop_of[goal], stop_of[best])});
    }
  }
  return order;
}

/// Returns the number of goals that each sweep looks at. The exact end takes in the last sixth at once.
std::vector<std::size_t> plan_sweeps(std::size_t goals) {
  const std::size_t most = std::min(goals - goals / 6, most_goals);
  std::vector<std::size_t> sizes;
  for (std::size_t size = std::min(first_goals, most); size < most; size += more_goals) sizes.push_back(size);
  sizes.push_back(most);
  return sizes;
}

/// A sweep with the bundles that it marked.
struct Stage {
  Sweep sweep;
  Bundles bundles;
};

/// From a few divisions of the drives between the shares and the remainder, the best bound, or the first that
/// is no less than the limit.
double bound_by_shares(const SweepContext& context, const std::vector<std::uint32_t>& order,
                       BudgetMeter& meter) {
  const auto count = static_cast<std::ptrdiff_t>(std::min(most_apart, order.size()));
  const std::vector<std::uint32_t> apart(order.begin(), order.begin() + count);
  double bound = 0.0;
  for (const double most_s : {1.2, 3.0, infinity}) {
    const AscentRules rules{most_s < infinity ? apart : std::vector<std::uint32_t>{}, most_s};
    const Shares shares = ascend(context.instance, rules, meter);
    const double rest =
        rules.apart.empty() ? 0.0 : remainder(context.instance, shares, apart, context.drives, meter);
    bound = std::max(bound, shares.total + rest);
    if (bound >= context.limit) break;
  }
  return bound;
}

/// Sweeps and the exact end, for goals in that order.
Proof sweep_all(SweepContext& context, const std::vector<std::uint32_t>& order, const Route& known,
                const TourOptions& options, BudgetMeter& meter) {
  const VisitTimes times(context.instance);
  const std::vector<std::size_t> sizes = plan_sweeps(order.size());
  Proof proof;
  Stage last{nothing_swept(context, sizes.size() % 2 == 1), {}};  // so that the last goes backward
  Stage back;
  for (const std::size_t size : sizes) {
    std::vector<std::uint32_t> goals(order.begin(), order.begin() + static_cast<std::ptrdiff_t>(size));
    Stage next{{}, extended(context.instance, times, last.bundles, goals, last.sweep.goals.size())};
    next.sweep = sweep(context, last.sweep, std::move(goals), next.bundles, meter);
    if (!next.sweep.finished) break;
    proof.lower_bound = std::max(proof.lower_bound, next.sweep.bound);
    if (!last.sweep.forward) back = std::move(last);
    last = std::move(next);
  }
  if (!last.sweep.forward) back = std::move(last);
  if (!back.sweep.finished) return proof;
  const Bundles all = extended(context.instance, times, back.bundles, order, back.sweep.goals.size());
  Finish end = finish(context, back.sweep, order, all, static_cast<std::uint64_t>(options.expansions), meter);
  proof.labels = end.labels;
  if (end.cost < known.cost) proof.nodes = std::move(end.nodes);
  if (!end.finished) return proof;
  proof.lower_bound = std::min(context.limit, end.cost);
  proof.optimal = options.gap == 0.0 || end.cost < context.limit;
  return proof;
}

}  // namespace

Proof prove(const Instance& instance, const Route& known, const TourOptions& options, BudgetMeter& meter) {
  SweepContext context{instance, sectored(instance, choose_sectors(instance)), least_durations(instance),
                       known.cost * (1.0 - options.gap * (1.0 - a_hair)),
                       static_cast<std::uint64_t>(options.operations)};
  const std::vector<std::uint32_t> order = spread(instance, known);
  Proof proof;
  if (order.size() <= most_goals) proof = sweep_all(context, order, known, options, meter);
  if (!proof.optimal && proof.lower_bound < context.limit) {
    proof.lower_bound = std::max(proof.lower_bound, bound_by_shares(context, order, meter));
  }
  return proof;
}

}  // namespace outrider::tour
