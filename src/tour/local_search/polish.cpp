#include "local_search/polish.hpp"

namespace outrider::tour {
namespace {

constexpr double least_gain = 1e-9;

/// The nodes of another stop for the goals at [begin, end]; false when it lacks one of them.
bool same_goals_from(const Instance& instance, const Route& route, std::uint32_t begin, std::uint32_t end,
                     std::uint32_t stop, std::vector<std::uint32_t>& nodes) {
  nodes.clear();
  for (std::uint32_t p = begin; p <= end; ++p) {
    const std::uint32_t node = instance.node(stop, instance.nodes[route.nodes[p]].goal);
    if (node == none) return false;
    nodes.push_back(node);
  }
  return true;
}

std::uint32_t rarest_goal(const Instance& instance, const Route& route, std::uint32_t begin,
                          std::uint32_t end) {
  std::uint32_t rarest = instance.nodes[route.nodes[begin]].goal;
  for (std::uint32_t p = begin + 1; p <= end; ++p) {
    const std::uint32_t goal = instance.nodes[route.nodes[p]].goal;
    if (instance.nodes_of[goal].size() < instance.nodes_of[rarest].size()) rarest = goal;
  }
  return rarest;
}

bool relocate_goals(const Instance& instance, Route& route, const std::stop_token& stop) {
  const std::vector<std::uint32_t> alone(instance.stops, 0);
  bool improved = false;
  for (std::uint32_t goal = 0; goal < instance.goals && !stop.stop_requested(); ++goal) {
    Route without = route;
    std::erase_if(without.nodes, [&](std::uint32_t n) { return instance.nodes[n].goal == goal; });
    refresh(instance, without);
    const Insertion insertion = best_insertion(instance, without, goal, 0.0, alone);
    splice(instance, without, insertion.position, insertion.position, {&insertion.node, 1});
    if (without.cost >= route.cost - least_gain) continue;
    route = std::move(without);
    improved = true;
  }
  return improved;
}

/// Takes the changed route when it is faster.
bool take_if_better(const Instance& instance, Route& route, Route& changed) {
  refresh(instance, changed);
  if (changed.cost >= route.cost - least_gain) return false;
  std::swap(route, changed);
  return true;
}

/// Reverses the run of visits that begins at `begin` and ends at `last`; or swaps the visit at `begin`
/// with the ones after it up to `last`, or the one that ends at `last` with the ones before it.
bool rearrange(const Instance& instance, Route& route, std::uint32_t begin, std::uint32_t last) {
  const auto at = [](Route& r, std::uint32_t position) { return r.nodes.begin() + position; };
  Route changed = route;
  std::reverse(at(changed, begin), at(changed, last + 1));
  if (take_if_better(instance, route, changed)) return true;
  changed = route;
  std::rotate(at(changed, begin), at(changed, route.visit_end[begin] + 1), at(changed, last + 1));
  if (take_if_better(instance, route, changed)) return true;
  std::uint32_t first_of_last = last;
  while (route.visit_end[first_of_last - 1] == last) --first_of_last;
  changed = route;
  std::rotate(at(changed, begin), at(changed, first_of_last), at(changed, last + 1));
  return take_if_better(instance, route, changed);
}

bool rearrange_visits(const Instance& instance, Route& route, const std::stop_token& stop) {
  for (std::uint32_t begin = 0; begin < route.size(); begin = route.visit_end[begin] + 1) {
    std::uint32_t last = route.visit_end[begin];
    while (last + 1 < route.size()) {
      if (stop.stop_requested()) return false;
      last = route.visit_end[last + 1];
      if (rearrange(instance, route, begin, last)) return true;
    }
  }
  return false;
}

}  // namespace

bool restop(const Instance& instance, Route& route, std::uint32_t begin) {
  const std::uint32_t end = route.visit_end[begin];
  std::vector<std::uint32_t> nodes;
  std::vector<std::uint32_t> best;
  double least = -least_gain;
  for (const std::uint32_t candidate : instance.nodes_of[rarest_goal(instance, route, begin, end)]) {
    const std::uint32_t stop = instance.nodes[candidate].stop;
    if (stop == route.after[begin].stop || !same_goals_from(instance, route, begin, end, stop, nodes))
      continue;
    const double change = splice_cost(instance, route, begin, end + 1, nodes);
    if (!(change < least)) continue;  // not a number where both ways are missing
    least = change;
    best = nodes;
  }
  if (best.empty()) return false;
  splice(instance, route, begin, end + 1, best);
  return true;
}

void polish(const Instance& instance, Route& route, const std::stop_token& stop) {
  bool improved = true;
  while (improved && !stop.stop_requested()) {
    improved = false;
    for (std::uint32_t begin = 0; begin < route.size(); begin = route.visit_end[begin] + 1) {
      improved |= restop(instance, route, begin);
    }
    improved |= relocate_goals(instance, route, stop);
    improved |= rearrange_visits(instance, route, stop);
  }
}

}  // namespace outrider::tour
