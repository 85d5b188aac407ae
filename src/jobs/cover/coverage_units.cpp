#include "coverage_units.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "outrider/path/visibility/visibility_graph.hpp"

namespace outrider::cover {
namespace {

constexpr double same_place_m = 1e-9;

void add(Variant& variant, const std::vector<PathPiece>& pieces, PieceRole role) {
  variant.pieces.insert(variant.pieces.end(), pieces.begin(), pieces.end());
  variant.roles.resize(variant.pieces.size(), role);
}

}  // namespace

Outcome<std::vector<PathPiece>> Mover::way(Vec2 from, Vec2 to) {
  auto found = ways(from, {to});
  if (!found) return pass_on(found);
  return std::move(found->front());
}

Outcome<std::vector<std::vector<PathPiece>>> Mover::ways(Vec2 from, const std::vector<Vec2>& to) {
  std::vector<std::vector<PathPiece>> found(to.size());
  std::vector<std::size_t> hidden;
  std::vector<Vec2> goals;
  for (std::size_t i = 0; i < to.size(); ++i) {
    if (distance(from, to[i]) <= same_place_m) continue;
    if (ground_->segment_free({from, to[i]})) {
      found[i] = {{from, to[i], {}, 0.0}};
    } else {
      hidden.push_back(i);
      goals.push_back(to[i]);
    }
  }
  if (hidden.empty()) return found;
  const auto plans =
      visibility_graph_reduced_many({nullptr, from, {}, ground_}, goals, {}, budget_, workspace_);
  for (std::size_t k = 0; k < hidden.size(); ++k) {
    if (!plans[k]) return tl::unexpected<Fault>(plans[k].error());
    found[hidden[k]] = plans[k]->pieces;
  }
  return found;
}

Job lap_job(const Lap& lap, std::size_t places) {
  std::vector<std::size_t> begins;
  for (std::size_t i = 0; i < lap.size(); ++i) {
    const PathPiece& before = lap[(i + lap.size() - 1) % lap.size()];
    if (turn_between(before, lap[i]) > no_turn_rad) begins.push_back(i);
  }
  if (begins.empty()) {  // smooth all around
    for (std::size_t i = 0; i < lap.size(); ++i) begins.push_back(i);
  }
  const std::size_t count = std::min(std::max<std::size_t>(1, places), begins.size());
  Job job;
  for (std::size_t k = 0; k < count; ++k) {
    const Lap begun = begun_at(lap, begins[k * begins.size() / count]);
    for (const Lap& way : {begun, turned_round(begun)}) {
      job.push_back({way, std::vector<PieceRole>(way.size(), PieceRole::lap)});
    }
  }
  return job;
}

Outcome<Job> cell_job(const SweepCell& cell, Mover& mover) {
  Job job;
  for (const bool last_first : {false, true}) {
    std::vector<Segment> lanes = cell.lanes;
    if (last_first) std::reverse(lanes.begin(), lanes.end());
    for (const bool from_b : {false, true}) {
      Variant variant;
      for (std::size_t i = 0; i < lanes.size(); ++i) {
        const bool turned = (i % 2 == 1) != from_b;
        const PathPiece lane{turned ? lanes[i].b : lanes[i].a, turned ? lanes[i].a : lanes[i].b, {}, 0.0};
        if (i > 0) {
          auto move = mover.way(variant.exit(), lane.from);
          if (!move) return pass_on(move);
          add(variant, *move, PieceRole::move);
        }
        add(variant, {lane}, PieceRole::lane);
      }
      job.push_back(std::move(variant));
    }
    if (lanes.size() == 1) break;
  }
  return job;
}

namespace {

/// A way to begin one of the jobs: a stop of the tour.
struct Stop {
  std::uint32_t job = 0;
  const Variant* variant = nullptr;
  double time_s = 0.0;
};

std::vector<Stop> stops_of(const std::vector<Job>& jobs, const Pace& pace) {
  std::vector<Stop> stops;
  for (std::size_t job = 0; job < jobs.size(); ++job) {
    for (const Variant& variant : jobs[job]) {
      const double heading = heading_in(variant.pieces.front());
      stops.push_back(
          {static_cast<std::uint32_t>(job), &variant, sums_of(heading, variant.pieces, pace).time_s});
    }
  }
  return stops;
}

/// The time of all jobs without a move between them.
double least_work_s(const std::vector<Stop>& stops, std::size_t jobs) {
  std::vector<double> least(jobs, std::numeric_limits<double>::infinity());
  for (const Stop& stop : stops) least[stop.job] = std::min(least[stop.job], stop.time_s);
  return std::accumulate(least.begin(), least.end(), 0.0);
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
                                           const Pace& pace, Mover& mover) {
  const std::size_t n = stops.size() + 1;
  std::vector<Drive> drives(n * n, Drive{0.0, 0.0, 0.0});
  Places entries;
  std::vector<std::size_t> entry;
  for (const Stop& stop : stops) entry.push_back(entries.index_of(stop.variant->entry()));
  Places exits;
  std::vector<std::size_t> exit{start ? exits.index_of(start->position) : 0};
  for (const Stop& stop : stops) exit.push_back(exits.index_of(stop.variant->exit()));
  for (std::size_t e = 0; e < exits.points.size(); ++e) {
    auto ways = mover.ways(exits.points[e], entries.points);
    if (!ways) return pass_on(ways);
    for (std::size_t i = start ? 0 : 1; i < n; ++i) {
      if (exit[i] != e) continue;
      const double heading = i == 0 ? start->heading_rad : heading_out(stops[i - 1].variant->pieces.back());
      for (std::size_t j = 1; j < n; ++j) {
        if (i == j) continue;
        const auto& way = (*ways)[entry[j - 1]];
        drives[i * n + j].time_s = move_time_s(heading, way, stops[j - 1].variant->pieces.front(), pace);
      }
    }
  }
  return drives;
}

}  // namespace

Outcome<OrderedJobs> ordered(const std::vector<Job>& jobs, const std::optional<Pose2>& start,
                             const Pace& pace, const TourOptions& options, const Budget& budget,
                             Mover& mover) {
  const std::vector<Stop> stops = stops_of(jobs, pace);
  auto drives = drives_between(stops, start, pace, mover);
  if (!drives) return pass_on(drives);
  TourProblem problem;
  problem.goals = jobs.size();
  problem.turning = {1e9, std::numeric_limits<double>::infinity()};
  problem.services.resize(1);
  for (const Stop& stop : stops) problem.services.push_back({{stop.job, 0.0, 0.0, stop.time_s}});
  problem.drives = std::move(*drives);
  auto tour = solve(problem, options, budget);
  if (!tour) return pass_on(tour);

  OrderedJobs result;
  result.bound_s = std::max(tour->lower_bound_s, least_work_s(stops, jobs.size()));
  const PathPiece& first = stops[tour->visits.front().stop - 1].variant->pieces.front();
  result.track.start = start ? *start : Pose2{first.from, heading_in(first)};
  Vec2 at = result.track.start.position;
  for (const Visit& visit : tour->visits) {
    const Variant& variant = *stops[visit.stop - 1].variant;
    auto move = mover.way(at, variant.entry());
    if (!move) return pass_on(move);
    result.track.pieces.insert(result.track.pieces.end(), move->begin(), move->end());
    result.roles.resize(result.track.pieces.size(), PieceRole::move);
    result.begins.push_back(result.track.pieces.size());
    result.track.pieces.insert(result.track.pieces.end(), variant.pieces.begin(), variant.pieces.end());
    result.roles.insert(result.roles.end(), variant.roles.begin(), variant.roles.end());
    at = variant.exit();
  }
  return result;
}

}  // namespace outrider::cover
