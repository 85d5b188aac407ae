#include "outrider/path/clearance/medial_axis.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "clearance_options.hpp"
#include "exposure_bound.hpp"
#include "exposure_descent.hpp"
#include "medial_graph.hpp"
#include "outrider/path/visibility/visibility_graph.hpp"
#include "polygon_clearance.hpp"
#include "straighten.hpp"

namespace outrider {
namespace {

constexpr double legs_keep = 0.999;      // fraction of the clearance that legs keep
constexpr double most_exposure = 0.125;  // largest exposure between points of the path
constexpr double least_apart_m = 1e-9;
constexpr int most_halvings_of_part = 40;
constexpr double tight = 0.999;  // share of the cost that a lower bound reaches
constexpr std::int64_t most_bound_cells = 1024;

Status check_options(const MedialAxisOptions& options) {
  if (auto good = check_weight(options.weight_m); !good) return good;
  if (auto good = check_share(options.kept, "kept"); !good) return good;
  if (auto good = check_share(options.slack, "slack"); !good) return good;
  const bool good_cells = options.bound_cells >= 0 && options.bound_cells <= most_bound_cells;
  if (!good_cells) {
    return bad_input(fmt::format("{} is not valid; expected 0 to {}", options.bound_cells, most_bound_cells),
                     "bound_cells");
  }
  return {};
}

/// A path as points so close that legs between neighbours keep its clearance, with the cost up to each point.
struct PointsOfWay {
  const PolygonGround& ground;
  double weight_m;
  double least_m;
  std::vector<Vec2> points{};
  std::vector<double> cost{};

  void add(const Bisector& part, int halvings = 0) {
    const Segment chord{part.at(part.u0), part.at(part.u1)};
    const bool narrow = part.kind == Bisector::Kind::parabola && leg_clearance(ground, chord) < least_m;
    if ((part.exposure() > most_exposure || narrow) && halvings < most_halvings_of_part) {
      const double middle = 0.5 * (part.u0 + part.u1);
      add(part.part(part.u0, middle), halvings + 1);
      add(part.part(middle, part.u1), halvings + 1);
      return;
    }
    if (distance(points.back(), chord.b) < least_apart_m) return;
    points.push_back(chord.b);
    cost.push_back(cost.back() + part.length() + weight_m * part.exposure());
  }
};

PointsOfWay points_of(const std::vector<Bisector>& way, const PolygonGround& ground, const Problem& problem,
                      double weight_m, double least_m, const std::stop_token& stop) {
  PointsOfWay fine{ground, weight_m, least_m};
  fine.points = {problem.start};
  fine.cost = {0.0};
  for (const Bisector& part : way) {
    if (!stop.stop_requested()) fine.add(part);
  }
  if (fine.points.size() > 1 && distance(fine.points.back(), problem.goal) < least_apart_m) {
    fine.points.back() = problem.goal;
  } else {
    fine.points.push_back(problem.goal);
    fine.cost.push_back(fine.cost.back());
  }
  return fine;
}

/// Returns a lower bound of the cost of any path: clearance grows by at most the distance moved, and is
/// limited by that of the widest place.
double least_cost(const MedialGraph& graph, Vec2 start, Vec2 goal, double weight_m) {
  const double length = distance(start, goal);
  const double from = graph.start.leg.apart, to = graph.goal.leg.apart;
  const double top = std::min(0.5 * (from + to + length), std::max({graph.widest_m, from, to}));
  const double level = std::max(0.0, length - (top - from) - (top - to));
  return length + weight_m * (std::log(top / from) + std::log(top / to) + level / top);
}

/// Returns few points of a path, so that legs between them cost at most 1 + `slack` times as
/// much and keep the clearance.
std::vector<Vec2> few_legs(const std::vector<Vec2>& points, const std::vector<double>& costs,
                           const LegCost& cost, double slack, PlanCounters& counters) {
  const auto does = [&](std::size_t i, std::size_t j) {
    ++counters.line_of_sight_checks;
    return cost(points[i], points[j]) <= (1.0 + slack) * (costs[j] - costs[i]);
  };
  std::vector<Vec2> kept;
  for (const std::size_t i : straightened(points.size(), does)) kept.push_back(points[i]);
  return kept;
}

std::vector<double> costs_along(const std::vector<Vec2>& points, const LegCost& cost) {
  std::vector<double> costs{0.0};
  for (std::size_t i = 1; i < points.size(); ++i)
    costs.push_back(costs.back() + cost(points[i - 1], points[i]));
  return costs;
}

/// Returns the path bent until it costs least, as few legs that cost at most 1 + `slack` times as much; or as
/// it is, if it costs less. Fewer legs are tried first, and bent again.
std::vector<Vec2> bent(const std::vector<Vec2>& path, const LegCost& cost, double slack,
                       PlanCounters& counters) {
  const std::vector<Vec2> points = descended(path, cost);
  const std::vector<double> costs = costs_along(points, cost);
  const double most = std::min((1.0 + slack) * costs.back(), costs_along(path, cost).back());
  for (const double share : {16.0, 8.0, 4.0, 2.0, 1.0}) {
    const std::vector<Vec2> few = settled(few_legs(points, costs, cost, share * slack, counters), cost);
    if (costs_along(few, cost).back() <= most) return few;
  }
  return path;
}

/// Returns the shortest path that keeps the clearance, with straight legs.
Outcome<Plan> shortest_wide(const Problem& problem, double clearance_m, const Budget& budget,
                            Workspace& workspace) {
  const PolygonGround& ground = *problem.polygons;
  auto wide = PolygonGround::of(ground.boundary, ground.obstacles,
                                std::clamp(clearance_m, ground.radius_m, most_polygon_radius_m));
  if (!wide) return pass_on(wide);
  Problem widened = problem;
  widened.polygons = std::make_shared<const PolygonGround>(std::move(*wide));
  return visibility_graph_implicit(widened, {.polygonal = true}, budget, workspace);
}

Plan plan_of(const Problem& problem, const std::vector<Vec2>& waypoints, double weight_m) {
  Plan plan;
  plan.waypoints = waypoints;
  for (std::size_t i = 1; i < waypoints.size(); ++i) {
    plan.pieces.push_back({waypoints[i - 1], waypoints[i], {}, 0.0});
    plan.exposure += leg_exposure(*problem.polygons, {waypoints[i - 1], waypoints[i]});
  }
  plan.weights.per_exposure_m = weight_m;
  plan.cost = length_of(plan) + weight_m * plan.exposure;
  return plan;
}

/// Returns the larger of two lower bounds; the costly one only if the other leaves a gap.
double bound_of(const MedialGraph& graph, const LegCost& cost, const Problem& problem, double found,
                const MedialAxisOptions& options) {
  const double simple = least_cost(graph, problem.start, problem.goal, options.weight_m);
  if (options.bound_cells == 0 || simple >= tight * found) return simple;
  const ExposureQuestion question{cost.ground,      problem.start, problem.goal,
                                  options.weight_m, cost.least_m,  cost.stop};
  return std::max(simple, least_cost_bound(question, static_cast<int>(options.bound_cells)));
}

}  // namespace

std::vector<Option> describe(MedialAxisOptions& options) {
  return {
      weight_option(options.weight_m),
      kept_option(options.kept),
      {"slack", "", 0.0, 1.0, "by how much a straight leg may cost more than the way it replaces",
       &options.slack},
      {"bound_cells", "", 0.0, static_cast<double>(most_bound_cells),
       "cells along the longer side for the lower bound; 0: a bound without cells", &options.bound_cells}};
}

Outcome<Plan> medial_axis(const Problem& problem, const MedialAxisOptions& options, const Budget& budget,
                          Workspace& workspace) {
  if (auto good = check_options(options); !good) return pass_on(good);
  auto ground = polygon_query(problem);
  if (!ground) return pass_on(ground);
  if (problem.start == problem.goal) return plan_of(problem, {problem.start}, options.weight_m);
  const MedialGraph graph = medial_graph(*ground, problem.start, problem.goal, workspace);
  BudgetMeter meter(budget);
  auto largest = largest_clearance(graph, meter, workspace);
  if (!largest) return pass_on(largest);
  const double kept = options.kept * *largest;
  auto way = least_exposed(graph, kept, options.weight_m, meter, workspace);
  if (!way) return pass_on(way);

  const double least = std::max((*ground)->radius_m, legs_keep * kept);
  const LegCost cost{**ground, options.weight_m, least, budget.stop};
  const PointsOfWay fine = points_of(*way, **ground, problem, options.weight_m, least, budget.stop);
  Budget left = budget;
  left.expansions -= meter.spent();
  auto wide = shortest_wide(problem, kept * (1.0 - kept_rounding) - graph.rounding_m, left, workspace);
  if (!wide) return pass_on(wide);
  PlanCounters counters = wide->counters;
  counters.expansions += meter.spent();
  const std::vector<Vec2> along = few_legs(fine.points, fine.cost, cost, options.slack, counters);
  std::vector<Vec2> best = bent(along, cost, options.slack, counters);
  std::vector<Vec2> other = bent(wide->waypoints, cost, options.slack, counters);
  if (costs_along(other, cost).back() < costs_along(best, cost).back()) best = std::move(other);
  Plan plan = plan_of(problem, best, options.weight_m);
  plan.lower_bound = std::min(plan.cost, bound_of(graph, cost, problem, plan.cost, options));
  plan.counters = counters;
  if (budget.stop.stop_requested()) return meter.refusal();
  return plan;
}

std::vector<std::vector<Vec2>> medial_axis_lines(const PolygonGround& ground) {
  std::vector<std::vector<Vec2>> lines;
  for (const VoronoiEdge& edge : voronoi_edges(ground).edges) {
    const Bisector& b = edge.bisector;
    const bool straight = b.kind != Bisector::Kind::parabola;
    const int parts = straight ? 1 : std::max(1, static_cast<int>(std::ceil(4.0 * b.exposure())));
    std::vector<Vec2> line;
    for (int i = 0; i <= parts; ++i) line.push_back(b.at(b.u0 + (b.u1 - b.u0) * i / parts));
    lines.push_back(std::move(line));
  }
  return lines;
}

}  // namespace outrider
