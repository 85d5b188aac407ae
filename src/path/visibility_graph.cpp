#include "outrider/path/visibility_graph.hpp"

#include <fmt/format.h>

#include <cmath>
#include <limits>

#include "outrider/search/best_first.hpp"
#include "visibility_plan.hpp"
#include "visibility_tangents.hpp"

namespace outrider {
namespace {

constexpr std::uint32_t unknown = std::numeric_limits<std::uint32_t>::max();
constexpr double slack_rad = 1e-9;

/// The legs by the node that they leave; a node may wait to be looked at.
struct TangentGraph {
  std::shared_ptr<const PolygonGround> ground;
  std::vector<Departure> legs;
  std::vector<std::uint32_t> first;
  std::vector<std::uint32_t> count;
  std::uint64_t tests = 0;

  void begin(const std::shared_ptr<const PolygonGround>& on) {
    ground = on;
    legs.clear();
    first.assign(2 * on->arcs.size(), unknown);
    count.assign(2 * on->arcs.size(), 0);
    tests = 0;
  }
  void look_round(Node node) {
    if (first[node] != unknown) return;
    std::vector<Departure> found;
    departures_swept(*ground, place_of(*ground, node), found, tests);
    first[node] = static_cast<std::uint32_t>(legs.size());
    count[node] = static_cast<std::uint32_t>(found.size());
    legs.insert(legs.end(), found.begin(), found.end());
  }
};
struct SweptMemory : TangentGraph {};
struct PairedMemory : TangentGraph {};
struct ImplicitMemory : TangentGraph {};

Status build_swept(TangentGraph& graph, BudgetMeter& meter) {
  for (Node node = 0; node < graph.first.size(); ++node) {
    if (!meter.spend()) return meter.refusal();
    graph.look_round(node);
  }
  return {};
}

/// Each pair once; the way back runs round the same arcs in the other direction.
Status build_paired(TangentGraph& graph, BudgetMeter& meter) {
  const PolygonGround& ground = *graph.ground;
  const auto nodes = static_cast<Node>(graph.first.size());
  std::vector<std::vector<Departure>> by_node(nodes);
  std::vector<Departure> found;
  for (Node node = 0; node < nodes; ++node) {
    if (!meter.spend()) return meter.refusal();
    const Place place = place_of(ground, node);
    found.clear();
    departures_pairwise(ground, place, (node | 1U) + 1, found, graph.tests);
    for (const Departure& leg : found) {
      by_node[node].push_back(leg);
      const double here = place.arc->width_rad, there = ground.arcs[leg.to / 2].width_rad;
      by_node[turned_round(leg.to)].push_back({turned_round(node), there - leg.arrives, here - leg.leaves,
                                               leg.length, point_at(place, leg.leaves)});
    }
  }
  for (Node node = 0; node < nodes; ++node) {
    graph.first[node] = static_cast<std::uint32_t>(graph.legs.size());
    graph.count[node] = static_cast<std::uint32_t>(by_node[node].size());
    graph.legs.insert(graph.legs.end(), by_node[node].begin(), by_node[node].end());
  }
  return {};
}

using Build = Status (*)(TangentGraph&, BudgetMeter&);

/// The graph of this ground, kept from the last query when that was on it too.
Status prepare(TangentGraph& graph, const std::shared_ptr<const PolygonGround>& ground, Build build,
               const Budget& budget) {
  if (graph.ground == ground) return {};
  graph.begin(ground);
  Budget unhurried = budget;
  unhurried.expansions = std::numeric_limits<std::uint64_t>::max();
  BudgetMeter meter(unhurried);
  auto built = build(graph, meter);
  if (!built) graph.ground = nullptr;
  return built;
}

/// How the start and the goal see the arcs.
using Look = void (*)(const PolygonGround&, const Place&, std::vector<Departure>&, std::uint64_t&);

void look_pairwise(const PolygonGround& ground, const Place& place, std::vector<Departure>& found,
                   std::uint64_t& tests) {
  departures_pairwise(ground, place, 0, found, tests);
}

/// States are legs: 0 stands for the start, 1 for the goal, then the legs from the start, then the others.
struct TangentPolicy {
  using Cost = double;

  const Problem& problem;
  TangentGraph& graph;
  bool implicit;
  Labels<double>& labels;
  const PolygonGround& ground = *problem.polygons;
  std::vector<Departure> starts{};
  std::vector<Departure> ends{};  ///< by node: the leg from it to the goal; no length when there is none
  bool direct = false;
  PlanCounters counters{};

  void look(Look around) {
    around(ground, point_place(problem.start), starts, counters.line_of_sight_checks);
    std::vector<Departure> back;
    around(ground, point_place(problem.goal), back, counters.line_of_sight_checks);
    ends.assign(2 * ground.arcs.size(), {0, 0.0, 0.0, -1.0, {}});
    for (const Departure& leg : back) {
      const double leaves = ground.arcs[leg.to / 2].width_rad - leg.arrives;
      ends[turned_round(leg.to)] = {0, leaves, 0.0, leg.length, problem.goal};
    }
    ++counters.line_of_sight_checks;
    direct = ground.segment_free({problem.start, problem.goal});
  }

  [[nodiscard]] State first_leg() const { return static_cast<State>(2 + starts.size()); }
  [[nodiscard]] std::size_t states() const { return first_leg() + graph.legs.size(); }
  [[nodiscard]] static State start() { return 0; }
  [[nodiscard]] bool is_goal(State s) const { return s == 1 || (s == 0 && problem.start == problem.goal); }
  [[nodiscard]] const Departure& leg(State s) const {
    return s < first_leg() ? starts[s - 2] : graph.legs[s - first_leg()];
  }
  [[nodiscard]] double estimate(State s) const {
    if (s == 1) return 0.0;
    return distance(s == 0 ? problem.start : leg(s).at, problem.goal);
  }
  [[nodiscard]] static double value(double cost) { return cost; }
  [[nodiscard]] static double priority(double g, double h) { return g + h; }
  static void settle(State /*s*/) {}

  template <class Relax>
  void expand(State s, Relax& relax) {
    if (s != 0) return expand_leg(s, relax);
    if (direct) relax(1, 0, distance(problem.start, problem.goal), 0.0);
    for (State i = 0; i < starts.size(); ++i) {
      ++counters.generated;
      relax(2 + i, 0, starts[i].length, distance(starts[i].at, problem.goal));
    }
  }
  template <class Relax>
  void expand_leg(State s, Relax& relax) {
    const Departure came = leg(s);
    const double g = labels.g(s);
    const auto onwards = [&](State next, const Departure& to, double h) {
      if (to.leaves < came.arrives - slack_rad) return;
      ++counters.generated;
      const double turned = std::max(0.0, to.leaves - came.arrives);
      relax(next, s, g + ground.radius_m * turned + to.length, h);
    };
    if (ends[came.to].length >= 0.0) onwards(1, ends[came.to], 0.0);
    if (implicit) {
      graph.look_round(came.to);
      labels.grow(states());
    }
    for (std::uint32_t i = graph.first[came.to]; i < graph.first[came.to] + graph.count[came.to]; ++i) {
      onwards(first_leg() + i, graph.legs[i], distance(graph.legs[i].at, problem.goal));
    }
  }
  [[nodiscard]] std::vector<WayLeg> way_to(State goal) const {
    std::vector<WayLeg> way;
    const std::vector<State> states_passed = path_to(goal, labels);
    for (std::size_t i = 1; i < states_passed.size(); ++i) {
      const State s = states_passed[i], before = states_passed[i - 1];
      WayLeg next{0, 0.0, 0.0, s == 1 ? problem.goal : leg(s).at};
      if (before != 0) {
        next.round = leg(before).to;
        next.entered = leg(before).arrives;
        next.left = s == 1 ? ends[next.round].leaves : leg(s).leaves;
      }
      way.push_back(next);
    }
    return way;
  }
};

Outcome<Plan> search(const Problem& problem, const VisibilityOptions& options, const Budget& budget,
                     Workspace& workspace, TangentGraph& graph, bool implicit, Look look) {
  auto& memory = workspace.get<SearchMemory<double>>();
  TangentPolicy policy{problem, graph, implicit, memory.labels};
  policy.look(look);
  BudgetMeter meter(budget);
  auto found = best_first(policy, memory, meter, workspace.trace);
  if (!found) return pass_on(found);
  policy.counters.expansions = meter.spent();
  if (implicit) policy.counters.line_of_sight_checks += graph.tests;
  return plan_of(problem, policy.way_to(*found), options, policy.counters);
}

Status check_options(const VisibilityOptions& options) {
  const double step = degrees(options.arc_step_rad);
  const bool good = step >= 1.0 - 1e-9 && step <= 90.0 + 1e-9;
  if (good) return {};
  return bad_input(fmt::format("{} degrees is no good; it takes 1 to 90", step), "arc_step");
}

Outcome<Plan> explicit_search(const Problem& problem, const VisibilityOptions& options, const Budget& budget,
                              Workspace& workspace, TangentGraph& graph, Build build, Look look) {
  if (auto good = check_options(options); !good) return pass_on(good);
  auto ground = polygon_query(problem);
  if (!ground) return pass_on(ground);
  if (auto built = prepare(graph, *ground, build, budget); !built) return pass_on(built);
  return search(problem, options, budget, workspace, graph, false, look);
}

}  // namespace

std::vector<Option> describe(VisibilityOptions& options) {
  return {{"polygonal", "", 0.0, 0.0, "straight legs in place of arcs, a little longer", &options.polygonal},
          {"arc_step", "deg", 1.0, 90.0, "largest turn between the straight legs that stand for an arc",
           &options.arc_step_rad}};
}

Outcome<Plan> visibility_graph(const Problem& problem, const VisibilityOptions& options, const Budget& budget,
                               Workspace& workspace) {
  return explicit_search(problem, options, budget, workspace, workspace.get<SweptMemory>(), build_swept,
                         departures_swept);
}

Outcome<Plan> visibility_graph_reduced(const Problem& problem, const VisibilityOptions& options,
                                       const Budget& budget, Workspace& workspace) {
  return explicit_search(problem, options, budget, workspace, workspace.get<PairedMemory>(), build_paired,
                         look_pairwise);
}

Outcome<Plan> visibility_graph_implicit(const Problem& problem, const VisibilityOptions& options,
                                        const Budget& budget, Workspace& workspace) {
  if (auto good = check_options(options); !good) return pass_on(good);
  auto ground = polygon_query(problem);
  if (!ground) return pass_on(ground);
  auto& graph = workspace.get<ImplicitMemory>();
  graph.begin(*ground);
  return search(problem, options, budget, workspace, graph, true, departures_swept);
}

std::vector<Segment> visibility_legs(const PolygonGround& ground, bool swept) {
  TangentGraph graph;
  graph.begin(std::make_shared<const PolygonGround>(ground));
  BudgetMeter meter(Budget{});
  const Status built = swept ? build_swept(graph, meter) : build_paired(graph, meter);
  std::vector<Segment> legs;
  for (Node node = 0; built && node < graph.first.size(); ++node) {
    for (std::uint32_t i = graph.first[node]; i < graph.first[node] + graph.count[node]; ++i) {
      const Departure& leg = graph.legs[i];
      const bool once = node < turned_round(leg.to);
      if (once) legs.push_back({point_at(place_of(ground, node), leg.leaves), leg.at});
    }
  }
  return legs;
}

}  // namespace outrider
