#include "ground/coverage_units.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "bounds/order_bound.hpp"
#include "outrider/path/visibility/visibility_graph.hpp"

namespace outrider::cover {
namespace {

constexpr double same_place_m = 1e-9;
constexpr std::size_t most_ways = 4095;  // that a tour takes, beside its start (tour/problem.hpp)

void add(Traversal& traversal, const std::vector<PathPiece>& pieces, PieceRole role) {
  traversal.pieces.insert(traversal.pieces.end(), pieces.begin(), pieces.end());
  traversal.roles.resize(traversal.pieces.size(), role);
}

}  // namespace

TransitPlanner::TransitPlanner(const CoverageArea& area, const Budget& budget)
    : near_m_(4.0 * area.arc_m), ground_(area.ground), budget_(budget) {
  for (const CoverField& field : area.fields) {
    for (const RingedPolygon& part : field.standing) parts_.push_back({part, field.ground});
  }
}

/// Returns the index of the part of that point; that of no part if it is outside of all.
std::size_t TransitPlanner::part_of(Vec2 p) const {
  if (parts_.size() == 1) return 0;
  std::size_t nearest = parts_.size();
  double least = near_m_;
  for (std::size_t i = 0; i < parts_.size(); ++i) {
    if (contains(parts_[i].room, p)) return i;
    const double away = distance_to_border(parts_[i].room, p);
    if (away <= least) nearest = i;
    least = std::min(least, away);
  }
  return nearest;
}

bool TransitPlanner::transfers(Vec2 from, Vec2 to) const {
  const std::size_t part = part_of(from);
  return part == parts_.size() || part != part_of(to);
}

Outcome<std::vector<PathPiece>> TransitPlanner::way(Vec2 from, Vec2 to) {
  auto found = ways(from, {to});
  if (!found) return pass_on(found);
  return std::move(found->front());
}

Outcome<std::vector<std::vector<PathPiece>>> TransitPlanner::ways(Vec2 from, const std::vector<Vec2>& to) {
  if (budget_.stop.stop_requested())
    return fault(FaultCode::cancelled, "it was cancelled while it planned moves");
  std::vector<std::vector<PathPiece>> found(to.size());
  const std::size_t part = part_of(from);
  for (const bool inside : {true, false}) {
    if (inside && part == parts_.size()) continue;
    const auto& ground = inside ? parts_[part].ground : ground_;
    std::vector<std::size_t> hidden;
    std::vector<Vec2> goals;
    for (std::size_t i = 0; i < to.size(); ++i) {
      if (distance(from, to[i]) <= same_place_m) continue;
      if (inside != (part < parts_.size() && part_of(to[i]) == part)) continue;
      if (ground->segment_free({from, to[i]})) {
        found[i] = {{from, to[i], {}, 0.0}};
      } else {
        hidden.push_back(i);
        goals.push_back(to[i]);
      }
    }
    if (hidden.empty()) continue;
    const auto plans =
        visibility_graph_reduced_many({nullptr, from, {}, ground}, goals, {}, budget_, workspace_);
    for (std::size_t k = 0; k < hidden.size(); ++k) {
      if (!plans[k]) return pass_on(plans[k]);
      found[hidden[k]] = plans[k]->pieces;
    }
  }
  return found;
}

CoverageUnit lap_unit(const Lap& lap, std::size_t places) {
  std::vector<std::size_t> begins;
  for (std::size_t i = 0; i < lap.size(); ++i) {
    const PathPiece& before = lap[(i + lap.size() - 1) % lap.size()];
    if (turn_between(before, lap[i]) > no_turn_rad) begins.push_back(i);
  }
  if (begins.empty()) {  // smooth all around
    for (std::size_t i = 0; i < lap.size(); ++i) begins.push_back(i);
  }
  const std::size_t count = std::min(std::max<std::size_t>(1, places), begins.size());
  CoverageUnit unit;
  for (std::size_t k = 0; k < count; ++k) {
    const Lap begun = begun_at(lap, begins[k * begins.size() / count]);
    for (const Lap& way : {begun, turned_round(begun)}) {
      unit.push_back({way, std::vector<PieceRole>(way.size(), PieceRole::lap)});
    }
  }
  return unit;
}

Outcome<CoverageUnit> cell_unit(const SweepCell& cell, TransitPlanner& transit) {
  CoverageUnit unit;
  for (const bool last_first : {false, true}) {
    std::vector<Segment> lanes = cell.lanes;
    if (last_first) std::reverse(lanes.begin(), lanes.end());
    for (const bool from_b : {false, true}) {
      Traversal traversal;
      for (std::size_t i = 0; i < lanes.size(); ++i) {
        const bool turned = (i % 2 == 1) != from_b;
        const PathPiece lane{turned ? lanes[i].b : lanes[i].a, turned ? lanes[i].a : lanes[i].b, {}, 0.0};
        if (i > 0) {
          auto move = transit.way(traversal.exit(), lane.from);
          if (!move) return pass_on(move);
          add(traversal, *move, PieceRole::move);
        }
        add(traversal, {lane}, PieceRole::lane);
      }
      unit.push_back(std::move(traversal));
    }
    if (lanes.size() == 1) break;
  }
  return unit;
}

namespace {

/// A way to begin one of the units: a stop of the tour.
struct Stop {
  std::uint32_t unit = 0;
  const Traversal* traversal = nullptr;
  double time_s = 0.0;
};

std::vector<Stop> stops_of(const std::vector<CoverageUnit>& units, const Pace& pace) {
  std::vector<Stop> stops;
  for (std::size_t unit = 0; unit < units.size(); ++unit) {
    for (const Traversal& traversal : units[unit]) {
      const double heading = heading_in(traversal.pieces.front());
      stops.push_back(
          {static_cast<std::uint32_t>(unit), &traversal, sums_of(heading, traversal.pieces, pace).time_s});
    }
  }
  return stops;
}

/// The time of a move between two headings, both turns included.
double move_time_s(double heading_rad, const std::vector<PathPiece>& move, const PathPiece& next,
                   const Pace& pace) {
  std::vector<PathPiece> pieces = move;
  pieces.push_back(next);
  return sums_of(heading_rad, pieces, pace).time_s - sums_of(heading_in(next), {next}, pace).time_s;
}

/// Places that are the same are asked for once.
struct Places {
  std::vector<Vec2> points;

  std::size_t index_of(Vec2 p) {
    const auto found = std::find(points.begin(), points.end(), p);
    if (found != points.end()) return static_cast<std::size_t>(found - points.begin());
    points.push_back(p);
    return points.size() - 1;
  }
};

/// The table of the tour: headings are known at every stop, so turns are part of the times.
Outcome<std::vector<Drive>> drives_between(const std::vector<Stop>& stops, const std::optional<Pose2>& start,
                                           const Pace& pace, TransitPlanner& transit) {
  const std::size_t n = stops.size() + 1;
  std::vector<Drive> drives(n * n, Drive{0.0, 0.0, 0.0});
  Places entries;
  std::vector<std::size_t> entry;
  for (const Stop& stop : stops) entry.push_back(entries.index_of(stop.traversal->entry()));
  Places exits;
  std::vector<std::size_t> exit{start ? exits.index_of(start->position) : 0};
  for (const Stop& stop : stops) exit.push_back(exits.index_of(stop.traversal->exit()));
  for (std::size_t e = 0; e < exits.points.size(); ++e) {
    auto ways = transit.ways(exits.points[e], entries.points);
    if (!ways) return pass_on(ways);
    for (std::size_t i = start ? 0 : 1; i < n; ++i) {
      if (exit[i] != e) continue;
      const double heading = i == 0 ? start->heading_rad : heading_out(stops[i - 1].traversal->pieces.back());
      for (std::size_t j = 1; j < n; ++j) {
        if (i == j) continue;
        const auto& way = (*ways)[entry[j - 1]];
        drives[i * n + j].time_s = move_time_s(heading, way, stops[j - 1].traversal->pieces.front(), pace);
      }
    }
  }
  return drives;
}

}  // namespace

Status check_ways(std::size_t ways) {
  if (ways <= most_ways) return {};
  return bad_input(
      fmt::format("the track would have {} ways to begin its laps and lanes, more than the {} that "
                  "are put in order; give a wider robot, or cover the area in parts",
                  ways, most_ways),
      "width");
}

Outcome<OrderedUnits> ordered(const std::vector<CoverageUnit>& units, const std::optional<Pose2>& start,
                              const Pace& pace, const TourOptions& options, const Budget& budget,
                              TransitPlanner& transit) {
  const std::vector<Stop> stops = stops_of(units, pace);
  if (auto good = check_ways(stops.size()); !good) return pass_on(good);
  auto drives = drives_between(stops, start, pace, transit);
  if (!drives) return pass_on(drives);
  TourProblem problem;
  problem.goals = units.size();
  problem.turning = {1e9, std::numeric_limits<double>::infinity()};
  problem.services.resize(1);
  for (const Stop& stop : stops) problem.services.push_back({{stop.unit, 0.0, 0.0, stop.time_s}});
  problem.drives = std::move(*drives);
  auto tour = solve(problem, options, budget);
  if (!tour) return pass_on(tour);

  OrderedUnits result;
  result.bound_s =
      std::max(tour->lower_bound_s, order_bound_s(problem, start.has_value(), tour->cost_s, budget.stop));
  const PathPiece& first = stops[tour->visits.front().stop - 1].traversal->pieces.front();
  result.track.start = start ? *start : Pose2{first.from, heading_in(first)};
  Vec2 at = result.track.start.position;
  for (const Visit& visit : tour->visits) {
    const Traversal& traversal = *stops[visit.stop - 1].traversal;
    auto move = transit.way(at, traversal.entry());
    if (!move) return pass_on(move);
    result.track.pieces.insert(result.track.pieces.end(), move->begin(), move->end());
    result.roles.resize(result.track.pieces.size(),
                        transit.transfers(at, traversal.entry()) ? PieceRole::transfer : PieceRole::move);
    result.begins.push_back(result.track.pieces.size());
    result.track.pieces.insert(result.track.pieces.end(), traversal.pieces.begin(), traversal.pieces.end());
    result.roles.insert(result.roles.end(), traversal.roles.begin(), traversal.roles.end());
    at = traversal.exit();
  }
  return result;
}

}  // namespace outrider::cover
