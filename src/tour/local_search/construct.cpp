#include "local_search/construct.hpp"

#include <numeric>

namespace outrider::tour {
namespace {

/// Returns the number of the goals that each stop could serve.
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

/// Inserts all goals, the one with the least score next. The best insertion of each goal is kept, and found
/// anew only where the route or the company of its stop has changed.
class CheapestInsertion {
 public:
  CheapestInsertion(const Instance& instance, double sharing, const std::stop_token& stop)
      : instance_(instance), sharing_(sharing), stop_(stop), missing_(instance.goals), best_(instance.goals) {
    std::iota(missing_.begin(), missing_.end(), 0U);
    company_ = count_company(instance, missing_);
  }

  /// Returns the route; it lacks goals after a stop request.
  Route run() {
    for (const std::uint32_t goal : missing_)
      best_[goal] = best_insertion(instance_, route_, goal, sharing_, company_);
    while (!missing_.empty() && !stop_.stop_requested()) {
      const auto next = std::ranges::min_element(missing_, {}, [&](auto goal) { return best_[goal].score; });
      const std::uint32_t goal = *next;
      missing_.erase(next);
      insert(goal);
    }
    return std::move(route_);
  }

 private:
  static constexpr int visits_before = 3;  // of a change, from which on insertions cost something else
  static constexpr int visits_after = 2;

  void insert(std::uint32_t goal) {
    const Insertion chosen = best_[goal];
    leave_company(instance_, goal, company_);
    splice(instance_, route_, chosen.position, chosen.position, {&chosen.node, 1});
    const auto [begin, end] = changed_around(chosen.position);
    for (const std::uint32_t other : missing_) {
      if (stop_.stop_requested()) return;
      Insertion& best = best_[other];
      const std::uint32_t stop = instance_.nodes[best.node].stop;
      const bool was_near = best.position + 1 >= begin && best.position < end;
      if (was_near || instance_.node(stop, goal) != none) {
        best = best_insertion(instance_, route_, other, sharing_, company_);
        continue;
      }
      if (best.position >= chosen.position) ++best.position;
      find_better(instance_, route_, other, sharing_, company_, begin, end, best);
    }
  }

  /// The positions at which an insertion may cost something else since that one: whole visits.
  [[nodiscard]] std::pair<std::uint32_t, std::uint32_t> changed_around(std::uint32_t position) const {
    std::uint32_t begin = first_of_visit(position), end = position;
    for (int k = 0; k < visits_before && begin > 0; ++k) begin = first_of_visit(begin - 1);
    for (int k = 0; k <= visits_after && end < route_.size(); ++k) end = route_.visit_end[end] + 1;
    return {begin, end == route_.size() ? end + 1 : end};
  }

  [[nodiscard]] std::uint32_t first_of_visit(std::uint32_t position) const {
    while (position > 0 && route_.visit_end[position - 1] >= position) --position;
    return position;
  }

  const Instance& instance_;
  double sharing_;
  const std::stop_token& stop_;
  Route route_;
  std::vector<std::uint32_t> missing_;
  std::vector<std::uint32_t> company_;
  std::vector<Insertion> best_;  // by goal
};

Route nearest_next(const Instance& instance, const std::stop_token& stop) {
  Route route;
  State state = start_of(instance);
  std::vector<bool> served(instance.goals, false);
  for (std::uint32_t count = 0; count < instance.goals && !stop.stop_requested(); ++count) {
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

std::optional<Route> construct(const Instance& instance, const std::stop_token& stop) {
  Route best = nearest_next(instance, stop);
  for (const double sharing : {0.0, 0.3, 1.0}) {
    Route route = CheapestInsertion(instance, sharing, stop).run();
    if (stop.stop_requested()) return std::nullopt;
    if (route.cost < best.cost) best = std::move(route);
  }
  return best;
}

}  // namespace outrider::tour
