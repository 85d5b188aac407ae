#include "strokes/turning_order.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "bounds/order_bound.hpp"
#include "ground/coverage_units.hpp"

namespace outrider::cover {
namespace {

constexpr std::size_t most_begins = 4;   // of a closed lap
constexpr std::size_t most_bases = 8;    // strokes from which others are reached
constexpr std::size_t most_proven = 40;  // units whose order is proven

/// A stroke in one direction.
struct Drivable {
  std::size_t stroke = 0;
  std::vector<PathPiece> pieces;
  std::size_t entry = 0;  ///< node of the roadmap
  std::size_t exit = 0;
  double time_s = 0.0;
};

/// Returns true if a closed lap may begin with piece `i`: a straight leg after an arc, both driven forward.
bool begins(const Lap& lap, std::size_t i) {
  const PathPiece& before = lap[(i + lap.size() - 1) % lap.size()];
  return !lap[i].backward && lap[i].turn_rad == 0.0 && !before.backward && before.turn_rad != 0.0;
}

std::vector<std::vector<PathPiece>> directions_of(const Stroke& stroke) {
  std::vector<Lap> begun;
  std::vector<std::size_t> places;
  for (std::size_t i = 0; stroke.closed && i < stroke.pieces.size(); ++i) {
    if (begins(stroke.pieces, i)) places.push_back(i);
  }
  const std::size_t count = std::min(most_begins, places.size());
  for (std::size_t k = 0; k < count; ++k)
    begun.push_back(begun_at(stroke.pieces, places[k * places.size() / count]));
  if (begun.empty()) begun.push_back(stroke.pieces);
  std::vector<std::vector<PathPiece>> all;
  for (const Lap& way : begun) {
    all.push_back(way);
    all.push_back(turned_round(way));
  }
  return all;
}

/// The strokes as a roadmap.
struct Roadmap {
  TurningTransit transit;
  std::vector<Drivable> drivables;
  std::optional<std::size_t> start;

  Roadmap(const std::vector<Stroke>& strokes, const CoverProblem& problem, const FreeRoom& room,
          const std::stop_token& stop)
      : transit(problem, room) {
    std::vector<Stroke> laps;
    for (const Stroke& stroke : strokes) {
      if (stroke.role == PieceRole::lap) laps.push_back(stroke);
    }
    std::vector<std::size_t> sources = add_strokes(transit, laps), targets = sources;
    for (std::size_t i = 0; i < strokes.size(); ++i) {
      for (auto& pieces : directions_of(strokes[i])) {
        Drivable one{i, std::move(pieces), 0, 0, 0.0};
        one.entry = transit.add({one.pieces.front().from, heading_in(one.pieces.front())});
        one.exit = transit.add({one.pieces.back().to, heading_out(one.pieces.back())});
        one.time_s = sums_of(heading_in(one.pieces.front()), one.pieces, problem.pace).time_s;
        transit.join(one.entry, one.exit, one.pieces);
        targets.push_back(one.entry);
        sources.push_back(one.exit);
        drivables.push_back(std::move(one));
      }
    }
    if (problem.start) start = transit.add(*problem.start);
    if (start) sources.push_back(*start);
    transit.connect(sources, targets, stop);
  }
};

double length_of(const std::vector<PathPiece>& pieces) {
  double length = 0.0;
  for (const PathPiece& piece : pieces) length += outrider::length_of(piece);
  return length;
}

/// Keeps the drivable strokes that lead to each other: of some bases, the one with the longest strokes.
std::vector<Drivable> joined(const Roadmap& map, const std::stop_token& stop) {
  std::vector<const Drivable*> bases;
  for (const Drivable& one : map.drivables) bases.push_back(&one);
  std::stable_sort(bases.begin(), bases.end(), [](const Drivable* a, const Drivable* b) {
    return length_of(a->pieces) > length_of(b->pieces);
  });
  if (bases.size() > most_bases) bases.resize(most_bases);
  std::vector<double> from_start;
  if (map.start) from_start = map.transit.ways_from(*map.start).times_s;
  std::vector<Drivable> best;
  double most_m = 0.0;
  for (const Drivable* base : bases) {
    if (stop.stop_requested()) break;
    if (map.start && !std::isfinite(from_start[base->entry])) continue;
    const auto there = map.transit.ways_from(base->exit), back = map.transit.ways_to(base->entry);
    std::vector<Drivable> kept;
    double all_m = 0.0;
    for (const Drivable& one : map.drivables) {
      const bool leads = std::isfinite(there.times_s[one.entry]) && std::isfinite(back.times_s[one.exit]);
      if (!leads && &one != base) continue;
      if (kept.empty() || kept.back().stroke != one.stroke) all_m += length_of(one.pieces);
      kept.push_back(one);
    }
    if (all_m <= most_m) continue;
    most_m = all_m;
    best = std::move(kept);
  }
  return best;
}

/// The tour over the strokes, and the ways from the start and from the exit of each.
struct OrderProblem {
  TourProblem tour;
  std::vector<TurningTransit::Ways> ways;  ///< by stop; of stop 0 only with a start

  /// It is incomplete after a stop request.
  OrderProblem(const Roadmap& map, const std::vector<Drivable>& stops, const std::stop_token& stop_token) {
    const std::size_t n = stops.size() + 1;
    tour.turning = {1e9, std::numeric_limits<double>::infinity()};
    tour.services.resize(1);
    tour.drives.assign(n * n, Drive{0.0, 0.0, 0.0});
    ways.emplace_back();
    if (map.start) ways[0] = map.transit.ways_from(*map.start);
    for (std::size_t i = 1; i < n; ++i) {
      if (stop_token.stop_requested()) return;
      const Drivable& stop = stops[i - 1];
      if (i == 1 || stop.stroke != stops[i - 2].stroke) ++tour.goals;
      tour.services.push_back({{static_cast<std::uint32_t>(tour.goals - 1), 0.0, 0.0, stop.time_s}});
      ways.push_back(map.transit.ways_from(stop.exit));
    }
    for (std::size_t i = map.start ? 0 : 1; i < n; ++i) {
      for (std::size_t j = 1; j < n; ++j) {
        if (i != j) tour.drives[i * n + j].time_s = ways[i].times_s[stops[j - 1].entry];
      }
    }
  }
};

void append(CoverPlan& plan, const std::vector<PathPiece>& pieces, PieceRole role) {
  plan.track.pieces.insert(plan.track.pieces.end(), pieces.begin(), pieces.end());
  plan.roles.resize(plan.track.pieces.size(), role);
}

}  // namespace

Outcome<CoverPlan> ordered_strokes(const std::vector<Stroke>& strokes, const CoverProblem& problem,
                                   const TourOptions& options, const FreeRoom& room, const Budget& budget) {
  const Roadmap map(strokes, problem, room, budget.stop);
  const std::vector<Drivable> stops = joined(map, budget.stop);
  const auto cancelled = [] {
    return fault(FaultCode::cancelled, "it was cancelled while it planned turns");
  };
  if (budget.stop.stop_requested()) return cancelled();
  if (stops.empty()) {
    return fault(FaultCode::start_blocked,
                 fmt::format("no curve of {:g} m or wider leads from there to a lap or lane",
                             problem.turning_radius_m),
                 "start");
  }
  if (auto good = check_ways(stops.size()); !good) return pass_on(good);
  const OrderProblem order(map, stops, budget.stop);
  if (budget.stop.stop_requested()) return cancelled();
  TourOptions search = options;
  if (order.tour.goals > most_proven) search.gap = 1.0;
  auto tour = solve(order.tour, search, budget);
  if (!tour) return pass_on(tour);
  CoverPlan plan;
  plan.order_bound_s = tour->lower_bound_s;
  if (options.gap < 1.0) {
    const double bound_s = order_bound_s(order.tour, problem.start.has_value(), tour->cost_s, budget.stop);
    plan.order_bound_s = std::max(plan.order_bound_s, bound_s);
  }
  const Drivable& first = stops[tour->visits.front().stop - 1];
  plan.track.start = problem.start ? *problem.start : map.transit.pose(first.entry);
  std::size_t before = 0;
  for (const Visit& visit : tour->visits) {
    const Drivable& stop = stops[visit.stop - 1];
    if (before > 0 || problem.start) {
      const std::size_t from = before > 0 ? stops[before - 1].exit : *map.start;
      append(plan, map.transit.pieces(order.ways[before], from, stop.entry), PieceRole::move);
    }
    plan.begins.push_back(plan.track.pieces.size());
    const PieceRole role = strokes[stop.stroke].role;
    append(plan, stop.pieces, role);
    ++(role == PieceRole::lap ? plan.laps : plan.lanes);
    before = visit.stop;
  }
  plan.cells = plan.lanes;
  return plan;
}

}  // namespace outrider::cover
