#include "tangent_search.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "outrider/core/text.hpp"
#include "outrider/search/best_first.hpp"
#include "placed_trace.hpp"
#include "visibility_plan.hpp"

namespace outrider {
namespace {

constexpr double no_bearing_m = 1e-9;  // closer to a goal than this, its direction is undefined

/// The last leg to a goal, listed under the node that it leaves.
struct LastLeg {
  std::uint32_t goal = 0;
  double leaves = 0.0;
  double length = 0.0;
};

/// Finds the legs between a point (start or goal) and the arcs. Both forms find the same legs.
void look(const PolygonGround& ground, TangentForm form, Vec2 p, std::vector<Departure>& found,
          std::uint64_t& tests) {
  if (form == TangentForm::paired) {
    departures_pairwise(ground, point_place(p), 0, found, tests);
  } else {
    departures_swept(ground, point_place(p), 0, found, tests);
  }
}

/// States are legs: 0 stands for the start, 1 to n for the n goals, then come the legs from the start, then
/// the others. For a single goal, the heuristic is the cost of the straight distance and of the turn towards
/// the goal. Both decrease no faster than a path pays for them, so the heuristic is consistent. For several
/// goals it is 0.
struct TangentPolicy {
  using Cost = double;

  const PolygonGround& ground;
  Vec2 from;
  std::vector<Vec2> goals;
  const CostWeights& weights;
  TangentGraph& graph;
  TangentForm form;
  Labels<double>& labels;
  std::size_t waiting = goals.size();
  std::vector<Departure> starts{};
  std::vector<std::vector<LastLeg>> ends{};  ///< by node
  std::vector<std::uint32_t> direct{};       ///< the goals that the start sees
  PlanCounters counters{};

  void look_about() {
    look(ground, form, from, starts, counters.line_of_sight_checks);
    ends.assign(2 * ground.arcs.size(), {});
    std::vector<Departure> back;
    for (std::uint32_t i = 0; i < goals.size(); ++i) {
      back.clear();
      look(ground, form, goals[i], back, counters.line_of_sight_checks);
      for (const Departure& leg : back) {
        const double leaves = ground.arcs[leg.to / 2].width_rad - leg.arrives;
        ends[turned_round(leg.to)].push_back({i, leaves, leg.length});
      }
      ++counters.line_of_sight_checks;
      if (ground.segment_free({from, goals[i]})) direct.push_back(i);
    }
  }

  [[nodiscard]] State first_leg() const { return static_cast<State>(1 + goals.size() + starts.size()); }
  [[nodiscard]] std::size_t states() const { return first_leg() + graph.legs.size(); }
  [[nodiscard]] static State start() { return 0; }
  /// Returns true if closing s ends the search, because s is the last of the goals.
  [[nodiscard]] bool is_goal(State s) { return s != 0 && s <= goals.size() && --waiting == 0; }
  [[nodiscard]] const Departure& leg(State s) const {
    return s < first_leg() ? starts[s - 1 - goals.size()] : graph.legs[s - first_leg()];
  }
  /// Returns the end of a leg.
  [[nodiscard]] Vec2 place(State s) const {
    if (s == 0) return from;
    return s <= goals.size() ? goals[s - 1] : leg(s).at;
  }
  /// Returns the direction of a leg where it meets its arc.
  [[nodiscard]] double heading_of_leg(const Departure& leg) const {
    const Place place = place_of(ground, leg.to);
    const double begin = place.arc->from_rad + (place.side > 0.0 ? 0.0 : place.arc->width_rad);
    return begin + place.side * (leg.arrives + pi / 2);
  }
  [[nodiscard]] double first_turn(double heading_rad) const {
    return weights.heading_rad ? std::abs(wrap_angle(heading_rad - *weights.heading_rad)) : 0.0;
  }
  [[nodiscard]] double estimate(Vec2 at, std::optional<double> heading_rad) const {
    if (goals.size() != 1) return 0.0;
    const double away = distance(at, goals[0]);
    if (weights.per_rad == 0.0 || !heading_rad || away < no_bearing_m) return weights.per_m * away;
    const double turn = std::abs(wrap_angle(heading_of(goals[0] - at) - *heading_rad));
    return weights.per_m * away + weights.per_rad * turn;
  }
  [[nodiscard]] double estimate(const Departure& leg) const {
    if (weights.per_rad == 0.0) return estimate(leg.at, std::nullopt);
    return estimate(leg.at, heading_of_leg(leg));
  }
  [[nodiscard]] double estimate(State s) const {
    if (s == 0) return estimate(from, weights.heading_rad);
    return s <= goals.size() ? 0.0 : estimate(leg(s));
  }
  [[nodiscard]] static double value(double cost) { return cost; }
  [[nodiscard]] static double priority(double g, double h) { return g + h; }
  static void settle(State /*s*/) {}

  template <class Relax>
  void expand(State s, Relax& relax) {
    if (s == 0) return expand_start(relax);
    if (s > goals.size()) expand_leg(s, relax);
  }
  template <class Relax>
  void expand_start(Relax& relax) {
    for (const std::uint32_t i : direct) {
      const double length = distance(from, goals[i]);
      const double turn = length > 0.0 ? first_turn(heading_of(goals[i] - from)) : 0.0;
      relax(1 + i, 0, weights.per_m * length + weights.per_rad * turn, 0.0);
    }
    for (State i = 0; i < starts.size(); ++i) {
      ++counters.generated;
      const double turn = weights.heading_rad ? first_turn(heading_of_leg(starts[i])) : 0.0;
      relax(static_cast<State>(1 + goals.size() + i), 0,
            weights.per_m * starts[i].length + weights.per_rad * turn, estimate(starts[i]));
    }
  }
  template <class Relax>
  void expand_leg(State s, Relax& relax) {
    const Departure came = leg(s);
    const double g = labels.g(s), per_turn = weights.per_m * ground.radius_m + weights.per_rad;
    const auto reach = [&](double leaves, double length) {
      return g + per_turn * std::max(0.0, leaves - came.arrives) + weights.per_m * length;
    };
    for (const LastLeg& last : ends[came.to]) {
      if (last.leaves < came.arrives - tangent_slack_rad) continue;
      ++counters.generated;
      relax(1 + last.goal, s, reach(last.leaves, last.length), 0.0);
    }
    if (form == TangentForm::implicit) {
      graph.look_round(came.to);
      labels.grow(states());
    }
    for (std::uint32_t i = graph.first[came.to]; i < graph.first[came.to] + graph.count[came.to]; ++i) {
      const Departure& next = graph.legs[i];
      if (next.leaves < came.arrives - tangent_slack_rad) continue;
      ++counters.generated;
      if (labels.closed(first_leg() + i)) continue;
      relax(first_leg() + i, s, reach(next.leaves, next.length), estimate(next));
    }
  }

  [[nodiscard]] double last_leaves(Node node, State goal) const {
    const auto last = std::find_if(ends[node].begin(), ends[node].end(),
                                   [&](const LastLeg& end) { return 1 + end.goal == goal; });
    return last->leaves;
  }
  [[nodiscard]] std::vector<WayLeg> way_to(State goal) const {
    std::vector<WayLeg> way;
    const std::vector<State> passed = path_to(goal, labels);
    for (std::size_t i = 1; i < passed.size(); ++i) {
      const State s = passed[i], before = passed[i - 1];
      const bool at_goal = s <= goals.size();
      WayLeg next{0, 0.0, 0.0, at_goal ? goals[s - 1] : leg(s).at};
      if (before != 0) {
        next.round = leg(before).to;
        next.entered = leg(before).arrives;
        next.left = at_goal ? last_leaves(next.round, s) : leg(s).leaves;
      }
      way.push_back(next);
    }
    return way;
  }
};

Status check_options(const VisibilityOptions& options) {
  const double step = degrees(options.arc_step_rad);
  const bool good = step >= 1.0 - 1e-9 && step <= 90.0 + 1e-9;
  if (good) return {};
  return bad_input(fmt::format("{} degrees is not valid; expected 1 to 90", short_number(step)), "arc_step");
}

}  // namespace

Outcome<Plan> tangent_search(const Problem& problem, const CostWeights& weights,
                             const VisibilityOptions& options, TangentForm form, const Budget& budget,
                             Workspace& workspace) {
  if (auto good = check_options(options); !good) return pass_on(good);
  auto ground = polygon_query(problem);
  if (!ground) return pass_on(ground);
  auto graph = tangent_graph(*ground, form, budget, workspace);
  if (!graph) return pass_on(graph);
  auto& memory = workspace.get<SearchMemory<double>>();
  TangentPolicy policy{**ground, problem.start, {problem.goal}, weights, **graph, form, memory.labels};
  policy.look_about();
  BudgetMeter meter(budget);
  const PlacedTrace placed(workspace.trace);
  auto found = best_first(policy, memory, meter, workspace.trace);
  placed.report([&](State s) { return policy.place(s); });
  if (!found) return pass_on(found);
  policy.counters.expansions = meter.spent();
  if (form == TangentForm::implicit) policy.counters.line_of_sight_checks += (*graph)->tests;
  return plan_of(problem, policy.way_to(*found), weights, options, policy.counters);
}

std::vector<Outcome<Plan>> tangent_search_many(const Problem& problem, const std::vector<Vec2>& goals,
                                               const CostWeights& weights, const VisibilityOptions& options,
                                               TangentForm form, const Budget& budget, Workspace& workspace) {
  std::vector<Outcome<Plan>> plans(goals.size(), fault(FaultCode::no_path, ""));
  if (auto good = check_options(options); !good) {
    plans.assign(goals.size(), pass_on(good));
    return plans;
  }
  std::vector<std::size_t> asked;
  std::vector<Vec2> places;
  for (std::size_t i = 0; i < goals.size(); ++i) {
    auto stands = polygon_query({nullptr, problem.start, goals[i], problem.polygons});
    if (!stands) {
      plans[i] = pass_on(stands);
      continue;
    }
    asked.push_back(i);
    places.push_back(goals[i]);
  }
  if (asked.empty()) return plans;
  auto graph = tangent_graph(problem.polygons, form, budget, workspace);
  for (std::size_t k = 0; !graph && k < asked.size(); ++k) plans[asked[k]] = pass_on(std::as_const(graph));
  if (!graph) return plans;
  auto& memory = workspace.get<SearchMemory<double>>();
  TangentPolicy policy{*problem.polygons, problem.start, places, weights, **graph, form, memory.labels};
  policy.look_about();
  BudgetMeter meter(budget);
  const PlacedTrace placed(workspace.trace);
  const auto found = best_first(policy, memory, meter, workspace.trace);
  placed.report([&](State s) { return policy.place(s); });
  policy.counters.expansions = meter.spent();
  if (form == TangentForm::implicit) policy.counters.line_of_sight_checks += (*graph)->tests;
  for (std::size_t k = 0; k < asked.size(); ++k) {
    const auto goal = static_cast<State>(1 + k);
    if (!memory.labels.known(goal) || !memory.labels.closed(goal)) {
      plans[asked[k]] = pass_on(found);
      continue;
    }
    Problem one = problem;
    one.goal = places[k];
    plans[asked[k]] = plan_of(one, policy.way_to(goal), weights, options, policy.counters);
  }
  return plans;
}

}  // namespace outrider
