#include "construct.hpp"

#include <numeric>

namespace outrider::tour {
namespace {

/// How many of the goals each stop could serve.
std::vector<std::uint32_t> count_company(const Instance& instance, const std::vector<std::uint32_t>& goals) {
  std::vector<std::uint32_t> company(instance.stops, 0);
  for (const std::uint32_t goal : goals) {
    for (const std::uint32_t node : instance.nodes_of[goal]) ++company[instance.nodes[node].stop];
  }
  return company;
}

void leave_company(const Instance& instance, std::uint32_t goal, std::vector<std::uint32_t>& company) {
  for (const std::uint32_t node : instance.nodes_of[goal]) --company[instance.nodes[node].stop];
}

/// Inserts all goals, the one with the least score next.
Route cheapest_insertion(const Instance& instance, double sharing) {
  Route route;
  std::vector<std::uint32_t> missing(instance.goals);
  std::iota(missing.begin(), missing.end(), 0U);
  std::vector<std::uint32_t> company = count_company(instance, missing);
  while (!missing.empty()) {
    std::size_t index = 0;
    Insertion best;
    for (std::size_t i = 0; i < missing.size(); ++i) {
      const Insertion candidate = best_insertion(instance, route, missing[i], sharing, company);
      if (candidate.score >= best.score) continue;
      best = candidate;
      index = i;
    }
    leave_company(instance, missing[index], company);
    missing.erase(missing.begin() + static_cast<std::ptrdiff_t>(index));
    splice(instance, route, best.position, best.position, {&best.node, 1});
  }
  return route;
}

Route nearest_next(const Instance& instance) {
  Route route;
  State state = start_of(instance);
  std::vector<bool> served(instance.goals, false);
  for (std::uint32_t count = 0; count < instance.goals; ++count) {
    double least = infinity;
    std::uint32_t chosen = none;
    for (std::uint32_t n = 0; n < instance.nodes.size(); ++n) {
      if (served[instance.nodes[n].goal]) continue;
      State next = state;
      const double time = advance(instance, next, instance.nodes[n]);
      if (chosen != none && !(time < least)) continue;
      least = time;
      chosen = n;
    }
    advance(instance, state, instance.nodes[chosen]);
    served[instance.nodes[chosen].goal] = true;
    route.nodes.push_back(chosen);
  }
  refresh(instance, route);
  return route;
}

}  // namespace

void insert_all(const Instance& instance, Route& route, const std::vector<std::uint32_t>& missing,
                double sharing) {
  std::vector<std::uint32_t> company = count_company(instance, missing);
  for (const std::uint32_t goal : missing) {
    const Insertion best = best_insertion(instance, route, goal, sharing, company);
    leave_company(instance, goal, company);
    splice(instance, route, best.position, best.position, {&best.node, 1});
  }
}

Route construct(const Instance& instance) {
  Route best = nearest_next(instance);
  for (const double sharing : {0.0, 0.3, 1.0}) {
    Route route = cheapest_insertion(instance, sharing);
    if (route.cost < best.cost) best = std::move(route);
  }
  return best;
}

}  // namespace outrider::tour
