#include "local_search/route.hpp"

namespace outrider::tour {
namespace {

constexpr double same_s = 1e-12;  // times that differ by no more are the same

State state_before(const Instance& instance, const Route& route, std::uint32_t position) {
  return position == 0 ? start_of(instance) : route.after[position - 1];
}

void consider(const Instance& instance, const Route& route, std::uint32_t position, std::uint32_t node,
              double divisor, Insertion& best) {
  const double cost = splice_cost(instance, route, position, position, {&node, 1});
  if (cost / divisor < best.score) best = {cost, cost / divisor, position, node};
}

/// Visits that begin at the positions [first, end), and the start if that is 0. Within a visit a service adds
/// its duration at least, since the time to aim is a metric: once that is reached the others are not looked
/// at.
void insert_in_visits(const Instance& instance, const Route& route, std::uint32_t goal, std::uint32_t first,
                      std::uint32_t end, Insertion& best) {
  if (const std::uint32_t node = instance.node(0, goal); first == 0 && node != none) {
    consider(instance, route, 0, node, 1.0, best);
  }
  for (std::uint32_t begin = first; begin < std::min(end, route.size()); begin = route.visit_end[begin] + 1) {
    const std::uint32_t node = instance.node(route.after[begin].stop, goal);
    if (node == none) continue;
    const double least = instance.nodes[node].duration + same_s;
    for (std::uint32_t at = begin; at <= route.visit_end[begin] + 1 && best.score > least; ++at)
      consider(instance, route, at, node, 1.0, best);
  }
}

/// New visits between the visit that ends before `position` and the one that begins there. Driving
/// alone already costs more than the best in most cases: then the turns are not looked at.
void insert_visit(const Instance& instance, const Route& route, std::uint32_t goal, std::uint32_t position,
                  double sharing, std::span<const std::uint32_t> company, Insertion& best) {
  const std::uint32_t from = state_before(instance, route, position).stop;
  const bool last = position == route.size();
  const std::uint32_t to = last ? from : route.after[position].stop;
  const double direct = from == to ? 0.0 : instance.time[instance.arc(from, to)];
  const double* outward = &instance.time[instance.arc(from, 0)];
  const double* onward = &instance.time_to[instance.arc(to, 0)];
  const std::vector<std::uint32_t>& stops = instance.stops_of[goal];
  for (std::size_t i = 0; i < stops.size(); ++i) {
    const std::uint32_t stop = stops[i];
    const double detour = outward[stop] + (last ? 0.0 : onward[stop]) - direct;
    const double divisor = 1.0 + sharing * company[stop];
    if (detour >= best.score * divisor || stop == from || stop == to) continue;
    consider(instance, route, position, instance.nodes_of[goal][i], divisor, best);
  }
}

/// Fills what follows from the steps and states.
void sum_up(Route& route) {
  const std::uint32_t size = route.size();
  route.cost = 0.0;
  for (const double step : route.step) route.cost += step;
  route.visit_end.resize(size);
  for (std::uint32_t p = size; p-- > 0;) {
    const bool ends = p + 1 == size || route.after[p + 1].stop != route.after[p].stop;
    route.visit_end[p] = ends ? p : route.visit_end[p + 1];
  }
}

template <class T>
void replace(std::vector<T>& values, std::uint32_t begin, std::uint32_t end, std::size_t by) {
  values.erase(values.begin() + begin, values.begin() + end);
  values.insert(values.begin() + begin, by, T{});
}

}  // namespace

void refresh(const Instance& instance, Route& route) {
  const std::uint32_t size = route.size();
  route.after.resize(size);
  route.step.resize(size);
  State state = start_of(instance);
  for (std::uint32_t p = 0; p < size; ++p) {
    route.step[p] = advance(instance, state, instance.nodes[route.nodes[p]]);
    route.after[p] = state;
  }
  sum_up(route);
}

double splice_cost(const Instance& instance, const Route& route, std::uint32_t begin, std::uint32_t end,
                   std::span<const std::uint32_t> replacement) {
  State state = state_before(instance, route, begin);
  double change = 0.0;
  for (const std::uint32_t node : replacement) change += advance(instance, state, instance.nodes[node]);
  for (std::uint32_t p = begin; p < end; ++p) change -= route.step[p];
  if (end == route.size()) return change;
  change += advance(instance, state, instance.nodes[route.nodes[end]]) - route.step[end];
  for (std::uint32_t p = end; state.heading != route.after[p].heading;) {
    const std::uint32_t last = route.visit_end[p];
    if (last + 1 == route.size()) break;
    const TourNode& leaving = instance.nodes[route.nodes[last]];
    state = {leaving.stop, state.heading, leaving.yaw - state.heading, leaving.pitch};
    p = last + 1;
    change += advance(instance, state, instance.nodes[route.nodes[p]]) - route.step[p];
  }
  return change;
}

void splice(const Instance& instance, Route& route, std::uint32_t begin, std::uint32_t end,
            std::span<const std::uint32_t> replacement) {
  const std::size_t count = replacement.size();
  State state = state_before(instance, route, begin);
  replace(route.nodes, begin, end, count);
  std::ranges::copy(replacement, route.nodes.begin() + begin);
  replace(route.after, begin, end, count);
  replace(route.step, begin, end, count);
  for (std::uint32_t p = begin; p < route.size(); ++p) {
    route.step[p] = advance(instance, state, instance.nodes[route.nodes[p]]);
    if (p >= begin + count && state == route.after[p]) break;  // from here on as before
    route.after[p] = state;
  }
  sum_up(route);
}

void find_better(const Instance& instance, const Route& route, std::uint32_t goal, double sharing,
                 std::span<const std::uint32_t> company, std::uint32_t begin, std::uint32_t end,
                 Insertion& best) {
  insert_in_visits(instance, route, goal, begin, end, best);
  for (std::uint32_t p = begin; p < std::min(end, route.size()); p = route.visit_end[p] + 1)
    insert_visit(instance, route, goal, p, sharing, company, best);
  if (end > route.size()) insert_visit(instance, route, goal, route.size(), sharing, company, best);
}

Insertion best_insertion(const Instance& instance, const Route& route, std::uint32_t goal, double sharing,
                         std::span<const std::uint32_t> company) {
  Insertion best;
  find_better(instance, route, goal, sharing, company, 0, route.size() + 1, best);
  return best;
}

}  // namespace outrider::tour
