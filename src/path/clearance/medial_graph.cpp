#include "medial_graph.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>

#include "placed_trace.hpp"

namespace outrider {
namespace {

constexpr double rounded = 1e-3;  // most distance of a computed point from the axis / its clearance

/// The axis of the ground of the last query.
struct AxisMemory {
  std::shared_ptr<const PolygonGround> made_for;
  VoronoiEdges axis;
};

/// The nearest point of an edge; tells if it is an end of the edge.
struct Foot {
  Vec2 point;
  bool at_end = false;
};

Foot foot_on(const Segment& edge, Vec2 p) {
  const Vec2 along = edge.b - edge.a;
  const double share = dot(p - edge.a, along) / squared_norm(along);
  if (share <= 0.0) return {edge.a, true};
  if (share >= 1.0) return {edge.b, true};
  return {edge.a + share * along, false};
}

/// Returns the distance from p along the unit vector `away` at which the corner is as near as the present
/// nearest feature, whose distance is `near` at p and grows by the distance moved. Infinite if that never
/// happens.
double until_corner(Vec2 p, Vec2 away, double near, Vec2 corner) {
  const Vec2 from = p - corner;
  const double gain = near - dot(away, from);
  const double left = squared_norm(from) - near * near;
  return gain > 1e-12 * near ? std::max(0.0, left) / (2.0 * gain) : std::numeric_limits<double>::infinity();
}

/// Does the same for the inner points of an edge.
double until_edge(Vec2 p, Vec2 away, double near, const Segment& edge) {
  constexpr double never = std::numeric_limits<double>::infinity();
  Vec2 normal = (1.0 / distance(edge.a, edge.b)) * perpendicular(edge.b - edge.a);
  if (dot(p - edge.a, normal) < 0.0) normal = -normal;
  const double gain = 1.0 - dot(away, normal);
  if (gain <= 1e-12) return never;
  const double walk = std::max(0.0, dot(p - edge.a, normal) - near) / gain;
  return foot_on(edge, p + walk * away).at_end ? never : walk;
}

/// Moves from p straight away from the nearest feature until another one is equally near.
Bisector retraction(const PolygonGround& ground, Vec2 p) {
  const auto nearest =
      std::min_element(ground.edges.begin(), ground.edges.end(),
                       [&](const Segment& s, const Segment& t) { return distance(p, s) < distance(p, t); });
  const Foot foot = foot_on(*nearest, p);
  const double near = distance(p, foot.point);
  const Vec2 away = (1.0 / near) * (p - foot.point);
  double walk = std::numeric_limits<double>::infinity();
  for (const Segment& edge : ground.edges) {
    const bool same = foot.at_end ? edge.a == foot.point || edge.b == foot.point : &edge == &*nearest;
    if (!same) walk = std::min(walk, until_edge(p, away, near, edge));
    for (const Vec2 corner : {edge.a, edge.b}) {
      const bool own = foot.at_end ? corner == foot.point : corner == nearest->a || corner == nearest->b;
      if (!own) walk = std::min(walk, until_corner(p, away, near, corner));
    }
  }
  Bisector leg;
  leg.origin = p;
  leg.along = away;
  leg.apart = near;
  leg.slope = 1.0;
  leg.u1 = walk;
  return leg;
}

/// Makes p a node by splitting the nearest edge of the axis, unless that is farther than `within`.
std::uint32_t cut_at(MedialGraph& graph, Vec2 p, double within) {
  std::size_t best = 0;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < graph.edges.size(); ++i) {
    const Bisector& b = graph.edges[i].bisector;
    const double away = distance(p, b.at(b.u_of(p)));
    if (away >= least) continue;
    least = away;
    best = i;
  }
  const auto joint = static_cast<std::uint32_t>(graph.nodes.size());
  graph.nodes.push_back(p);
  if (least > within) return joint;
  VoronoiEdge& edge = graph.edges[best];
  const Bisector whole = edge.bisector;
  const double u = whole.u_of(p);
  const VoronoiEdge rest{joint, edge.to, whole.part(u, whole.u1)};
  edge.to = joint;
  edge.bisector = whole.part(whole.u0, u);
  graph.edges.push_back(rest);
  return joint;
}

void list_incident(MedialGraph& graph) {
  graph.first.assign(graph.nodes.size() + 1, 0);
  for (const VoronoiEdge& edge : graph.edges) {
    ++graph.first[edge.from + 1];
    ++graph.first[edge.to + 1];
  }
  for (std::size_t i = 1; i < graph.first.size(); ++i) graph.first[i] += graph.first[i - 1];
  graph.incident.resize(2 * graph.edges.size());
  std::vector<std::uint32_t> next = graph.first;
  for (std::uint32_t e = 0; e < graph.edges.size(); ++e) {
    graph.incident[next[graph.edges[e].from]++] = e;
    graph.incident[next[graph.edges[e].to]++] = e;
  }
}

/// The common part of both searches.
struct AxisPolicy {
  using Cost = double;

  const MedialGraph& graph;
  const Labels<double>& labels;
  double least_m;  ///< least clearance of the parts used

  [[nodiscard]] std::size_t states() const { return graph.nodes.size(); }
  [[nodiscard]] State start() const { return graph.start.joint; }
  [[nodiscard]] bool is_goal(State s) const { return s == graph.goal.joint; }
  [[nodiscard]] static double value(double cost) { return cost; }
  [[nodiscard]] static double priority(double g, double h) { return g + h; }
  static void settle(State /*s*/) {}

  template <class Visit>
  void for_each_part(State s, Visit visit) {
    for (std::uint32_t i = graph.first[s]; i < graph.first[s + 1]; ++i) {
      const VoronoiEdge& edge = graph.edges[graph.incident[i]];
      const State next = edge.from == s ? edge.to : edge.from;
      if (!labels.closed(next) && edge.bisector.least_clearance() >= least_m) visit(next, edge.bisector);
    }
  }
};

/// Minimises the loss, the amount by which the least clearance is below that of the widest place.
struct WidestAxisPolicy : AxisPolicy {
  [[nodiscard]] static double estimate(State /*s*/) { return 0.0; }

  template <class Relax>
  void expand(State s, Relax& relax) {
    const double g = labels.g(s);
    for_each_part(s, [&](State next, const Bisector& part) {
      relax(next, s, std::max(g, graph.widest_m - part.least_clearance()), 0.0);
    });
  }
};

struct ExposureAxisPolicy : AxisPolicy {
  double weight_m = 0.0;

  [[nodiscard]] double estimate(State s) const {
    return distance(graph.nodes[s], graph.nodes[graph.goal.joint]);
  }
  [[nodiscard]] double cost(const Bisector& part) const { return part.length() + weight_m * part.exposure(); }

  template <class Relax>
  void expand(State s, Relax& relax) {
    const double g = labels.g(s);
    for_each_part(s,
                  [&](State next, const Bisector& part) { relax(next, s, g + cost(part), estimate(next)); });
  }
};

/// Returns the part of the axis that the search took between two neighbours, in that direction.
template <class Value>
Bisector taken(const MedialGraph& graph, State from, State to, double least_m, Value value) {
  Bisector best;
  double least = std::numeric_limits<double>::infinity();
  for (std::uint32_t i = graph.first[from]; i < graph.first[from + 1]; ++i) {
    const VoronoiEdge& edge = graph.edges[graph.incident[i]];
    const bool forward = edge.from == from && edge.to == to;
    const bool backward = edge.to == from && edge.from == to;
    if (!(forward || backward) || edge.bisector.least_clearance() < least_m) continue;
    if (value(edge.bisector) >= least) continue;
    least = value(edge.bisector);
    best = forward ? edge.bisector : edge.bisector.part(edge.bisector.u1, edge.bisector.u0);
  }
  return best;
}

}  // namespace

MedialGraph medial_graph(const std::shared_ptr<const PolygonGround>& ground, Vec2 start, Vec2 goal,
                         Workspace& workspace) {
  auto& memory = workspace.get<AxisMemory>();
  if (memory.made_for != ground) {
    memory.axis = voronoi_edges(*ground);
    memory.made_for = ground;
  }
  MedialGraph graph;
  graph.nodes = memory.axis.nodes;
  graph.edges = memory.axis.edges;
  graph.rounding_m = 2.0 * memory.axis.step_m;
  graph.least_m = ground->radius_m + 2.0 * graph.rounding_m;
  for (const VoronoiEdge& edge : graph.edges) {
    const Bisector& b = edge.bisector;
    graph.widest_m = std::max({graph.widest_m, b.clearance(b.u0), b.clearance(b.u1)});
  }
  for (auto& [end, p] : {std::pair<Retraction*, Vec2>{&graph.start, start}, {&graph.goal, goal}}) {
    end->leg = retraction(*ground, p);
    const double most_off = rounded * end->leg.clearance(end->leg.u1);  // all is free that near
    end->joint = cut_at(graph, end->leg.at(end->leg.u1), most_off);
  }
  list_incident(graph);
  return graph;
}

Outcome<double> largest_clearance(const MedialGraph& graph, BudgetMeter& meter, Workspace& workspace) {
  auto& memory = workspace.get<SearchMemory<double>>();
  WidestAxisPolicy policy{{graph, memory.labels, graph.least_m}};
  const PlacedTrace placed(workspace.trace);
  const auto found = best_first(policy, memory, meter, workspace.trace);
  placed.report([&](State s) { return graph.nodes[s]; });
  if (!found) return pass_on(found);
  double least = std::min(graph.start.leg.apart, graph.goal.leg.apart);
  const std::vector<State> path = path_to(*found, memory.labels);
  for (std::size_t i = 1; i < path.size(); ++i) {
    const Bisector part = taken(graph, path[i - 1], path[i], graph.least_m,
                                [](const Bisector& b) { return -b.least_clearance(); });
    least = std::min(least, part.least_clearance());
  }
  return least;
}

Outcome<std::vector<Bisector>> least_exposed(const MedialGraph& graph, double least_m, double weight_m,
                                             BudgetMeter& meter, Workspace& workspace) {
  auto& memory = workspace.get<SearchMemory<double>>();
  ExposureAxisPolicy policy{{graph, memory.labels, std::max(least_m, graph.least_m)}, weight_m};
  const PlacedTrace placed(workspace.trace);
  const auto found = best_first(policy, memory, meter, workspace.trace);
  placed.report([&](State s) { return graph.nodes[s]; });
  if (!found) return pass_on(found);
  std::vector<Bisector> way{graph.start.leg};
  const std::vector<State> path = path_to(*found, memory.labels);
  for (std::size_t i = 1; i < path.size(); ++i) {
    way.push_back(taken(graph, path[i - 1], path[i], policy.least_m,
                        [&](const Bisector& b) { return policy.cost(b); }));
  }
  way.push_back(graph.goal.leg.part(graph.goal.leg.u1, 0.0));
  return way;
}

}  // namespace outrider
