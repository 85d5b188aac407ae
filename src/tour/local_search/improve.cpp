#include "local_search/improve.hpp"

#include "local_search/construct.hpp"
#include "local_search/polish.hpp"
#include "outrider/core/rng.hpp"

namespace outrider::tour {
namespace {

constexpr std::uint32_t most_removed = 12;
constexpr double hot = 0.1;    // temperature at first, as a part of the cost
constexpr double cold = 2e-3;  // at last

std::uint32_t draw(Rng& rng, std::uint32_t count) { return static_cast<std::uint32_t>(rng.below(count)); }

/// Goal -> the other goals, those with most stops in common first.
std::vector<std::vector<std::uint32_t>> related_goals(const Instance& instance, const std::stop_token& stop) {
  std::vector<std::vector<std::uint32_t>> related(instance.goals);
  std::vector<std::uint32_t> shared(instance.goals);
  for (std::uint32_t goal = 0; goal < instance.goals && !stop.stop_requested(); ++goal) {
    std::ranges::fill(shared, 0U);
    for (const std::uint32_t node : instance.nodes_of[goal]) {
      const std::uint32_t at = instance.nodes[node].stop;
      for (std::uint32_t n = instance.first[at]; n < instance.first[at + 1]; ++n) {
        ++shared[instance.nodes[n].goal];
      }
    }
    for (std::uint32_t other = 0; other < instance.goals; ++other) {
      if (other != goal && shared[other] > 0) related[goal].push_back(other);
    }
    std::ranges::sort(related[goal],
                      [&](auto a, auto b) { return std::pair(shared[b], a) < std::pair(shared[a], b); });
  }
  return related;
}

/// A run of the route, from any place.
void ruin_run(const Route& route, std::uint32_t count, Rng& rng, std::vector<bool>& marked) {
  const std::uint32_t begin = draw(rng, route.size() - count + 1);
  std::fill_n(marked.begin() + begin, count, true);
}

/// Whole visits, drawn at random.
void ruin_visits(const Route& route, std::uint32_t count, Rng& rng, std::vector<bool>& marked) {
  for (std::uint32_t removed = 0; removed < count;) {
    const std::uint32_t p = draw(rng, route.size());
    const std::uint32_t stop = route.after[p].stop;
    for (std::uint32_t q = 0; q < route.size(); ++q) {
      if (route.after[q].stop == stop && !marked[q]) {
        marked[q] = true;
        ++removed;
      }
    }
    if (draw(rng, 2) == 0) return;
  }
}

/// A goal and some that share stops with it.
void ruin_related(const Instance& instance, const Route& route,
                  const std::vector<std::vector<std::uint32_t>>& related, std::uint32_t count, Rng& rng,
                  std::vector<bool>& marked) {
  std::vector<bool> chosen(instance.goals, false);
  const std::uint32_t seed = instance.nodes[route.nodes[draw(rng, route.size())]].goal;
  chosen[seed] = true;
  std::uint32_t left = count - 1;
  for (const std::uint32_t goal : related[seed]) {
    if (left == 0) break;
    if (draw(rng, 4) == 0) continue;
    chosen[goal] = true;
    --left;
  }
  for (std::uint32_t p = 0; p < route.size(); ++p) marked[p] = chosen[instance.nodes[route.nodes[p]].goal];
}

void ruin_scattered(const Route& route, std::uint32_t count, Rng& rng, std::vector<bool>& marked) {
  for (std::uint32_t i = 0; i < count; ++i) marked[draw(rng, route.size())] = true;
}

/// Takes some goals out of the route and returns them.
std::vector<std::uint32_t> ruin(const Instance& instance, Route& route,
                                const std::vector<std::vector<std::uint32_t>>& related, Rng& rng) {
  const std::uint32_t count = 1 + draw(rng, std::min(route.size(), most_removed));
  std::vector<bool> marked(route.size(), false);
  switch (draw(rng, 4)) {
    case 0: ruin_run(route, count, rng, marked); break;
    case 1: ruin_visits(route, count, rng, marked); break;
    case 2: ruin_related(instance, route, related, count, rng, marked); break;
    default: ruin_scattered(route, count, rng, marked); break;
  }
  std::vector<std::uint32_t> removed;
  std::vector<std::uint32_t> kept;
  for (std::uint32_t p = 0; p < route.size(); ++p) {
    if (marked[p]) {
      removed.push_back(instance.nodes[route.nodes[p]].goal);
    } else {
      kept.push_back(route.nodes[p]);
    }
  }
  route.nodes = std::move(kept);
  refresh(instance, route);
  return removed;
}

/// Puts the goals back one by one, in random order or the one with the fewest stops first.
void recreate(const Instance& instance, Route& route, std::vector<std::uint32_t> missing, Rng& rng) {
  constexpr double sharings[] = {0.0, 0.2, 0.5, 1.0};
  const double sharing = sharings[draw(rng, 4)];
  for (std::size_t i = missing.size(); i > 1; --i) std::swap(missing[i - 1], missing[rng.below(i)]);
  if (draw(rng, 2) == 0) {
    const auto fewest_stops = [&](auto goal) { return std::pair(instance.nodes_of[goal].size(), goal); };
    std::ranges::sort(missing, {}, fewest_stops);
  }
  insert_all(instance, route, missing, sharing);
}

}  // namespace

Improvement improve(const Instance& instance, Route route, std::int64_t seed, std::int64_t iterations,
                    BudgetMeter& meter, const std::stop_token& stop, const Price& price,
                    const Better& better) {
  double present = price(route);
  const auto polish_if_better = [&](Route& candidate, double& worth) {
    Route polished = candidate;
    polish(instance, polished, stop);
    const double polished_worth = price(polished);
    if (polished_worth > worth) return;
    candidate = std::move(polished);
    worth = polished_worth;
  };
  polish_if_better(route, present);
  Improvement result{route, 0};
  if (better) better(result.best);
  double least = present;
  Rng rng = Rng(static_cast<std::uint64_t>(seed)).child("tour");
  const auto related = related_goals(instance, stop);
  const std::uint64_t rounds =
      std::min(static_cast<std::uint64_t>(iterations), most_rounds_per_goal * instance.nodes_of.size());
  const auto total = static_cast<double>(rounds);
  for (; result.iterations < rounds && meter.spend(); ++result.iterations) {
    const double temperature =
        least * hot * std::pow(cold / hot, static_cast<double>(result.iterations) / total);
    Route candidate = route;
    recreate(instance, candidate, ruin(instance, candidate, related, rng), rng);
    restop(instance, candidate, draw(rng, candidate.size()));
    double worth = price(candidate);
    if (worth < least - 1e-9) {
      polish_if_better(candidate, worth);
      result.best = candidate;
      least = worth;
      if (better) better(result.best);
    }
    if (worth < present - temperature * std::log(1.0 - rng.uniform())) {
      route = std::move(candidate);
      present = worth;
    }
  }
  return result;
}

}  // namespace outrider::tour
