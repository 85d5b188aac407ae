#include "outrider/jobs/guard/yard/visit_map.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace outrider {
namespace {

constexpr double spacing_m = 1.5;
constexpr double near_region_m = 1.0;  // rests within this distance of a region count for it
constexpr double prior_s = 20.0;       // over all regions together
constexpr double concentration = 30;   // of the directions to go on to
constexpr double straight_part = 0.05;
constexpr double longest_look_s = 3.0;

double tolerance(const WanderOptions& options) { return 2.0 * options.sight_m + 1e-6; }

std::size_t nearest(const std::vector<Vec2>& regions, Vec2 p) {
  return static_cast<std::size_t>(
      std::min_element(regions.begin(), regions.end(),
                       [&](Vec2 a, Vec2 b) { return distance(a, p) < distance(b, p); }) -
      regions.begin());
}

/// The positions seen from `from` on that stay where the first of them is: one past the last.
std::size_t end_of_rest(const Track& track, std::size_t from, double tolerance_m) {
  std::size_t end = from + 1;
  while (end < track.size() && distance(track[from].position, track[end].position) <= tolerance_m) ++end;
  return end;
}

void add_rest(VisitMap& map, Vec2 place, double seconds, bool new_regions) {
  const std::size_t region = nearest(map.regions, place);
  if (new_regions && distance(map.regions[region], place) > 0.3) {
    map.regions.push_back(place);
    map.seconds.push_back(seconds);
  } else if (distance(map.regions[region], place) <= near_region_m) {
    map.seconds[region] += seconds;
  }
}

void learn(VisitMap& map, const Track& track, const WanderOptions& options, std::size_t from,
           bool new_regions) {
  double walked_m = 0.0, walked_s = 0.0;
  for (std::size_t i = from; i + 1 < track.size();) {
    const std::size_t end = end_of_rest(track, i, tolerance(options));
    const double seconds = track[end - 1].time_s - track[i].time_s;
    if (end - i >= 3) {
      add_rest(map, track[i].position, seconds, new_regions);
      map.rest_s += seconds;
      if (end < track.size()) map.rests += 1.0;
      i = end - 1;
    }
    if (end < track.size() && end - i == 1) {
      walked_m += distance(track[i].position, track[end].position);
      walked_s += track[end].time_s - track[i].time_s;
    }
    i = std::max(end, i + 1);
  }
  if (walked_s > 2.0) map.speed_mps = walked_m / walked_s;
}

std::size_t drawn(const std::vector<double>& weights, Rng& rng) {
  double sum = 0.0;
  for (const double weight : weights) sum += weight;
  double rest = rng.uniform() * sum;
  for (std::size_t i = 0; i + 1 < weights.size(); ++i) {
    rest -= weights[i];
    if (rest < 0.0) return i;
  }
  return weights.size() - 1;
}

/// How far one who walks goes straight on: to about where a region is that lies ahead.
double way_ahead(const VisitMap& map, const Stride& stride, Rng& rng) {
  const Vec2 along = 1.0 / norm(stride.velocity_mps) * stride.velocity_mps;
  std::vector<double> weights;
  std::vector<double> ways;
  double all = 0.0;
  for (std::size_t i = 0; i < map.regions.size(); ++i) {
    const Vec2 to = map.regions[i] - stride.position;
    const double way = norm(to);
    const double cosine = way > 1e-9 ? dot(along, to) / way : 1.0;
    const double share = prior_s / static_cast<double>(map.regions.size());
    weights.push_back((map.seconds[i] + share) * std::exp(concentration * (cosine - 1.0)));
    ways.push_back(std::max(0.0, dot(along, to)));
    all += map.seconds[i] + share;
  }
  weights.push_back(straight_part * all / static_cast<double>(map.regions.size()));
  ways.push_back(-std::log1p(-rng.uniform()) * 5.0);
  return ways[drawn(weights, rng)];
}

}  // namespace

VisitMap visit_map(const GuardProblem& problem, const FiringMap& firing_map,
                   const std::vector<Track>& history, const WanderOptions& options) {
  VisitMap map;
  const GridFrame frame = covering(problem.world.bounds, spacing_m);
  for (std::size_t i = 0; i < frame.size(); ++i) {
    const Vec2 place = frame.centre(frame.cell(i));
    const auto cell = firing_map.cell_of(place);
    if (cell && firing_map.standable[*cell] != 0) map.regions.push_back(place);
  }
  if (map.regions.empty()) map.regions.push_back(problem.start.position);
  map.seconds.assign(map.regions.size(), 0.0);
  if (options.learn) {
    for (const Track& track : history) learn(map, track, options, 0, true);
  }
  return map;
}

void learn(VisitMap& map, const Track& track, const WanderOptions& options, std::size_t from) {
  learn(map, track, options, from, false);
}

Stride stride_of(const Track& track, const WanderOptions& options) {
  const TimedPosition& last = track.back();
  Stride stride{last.position, {}, last.time_s};
  for (std::size_t first = track.size() - 1; first-- > 0;) {
    if (last.time_s - track[first].time_s > longest_look_s) break;
    const Vec2 velocity = 1.0 / (last.time_s - track[first].time_s) * (last.position - track[first].position);
    for (std::size_t k = first + 1; k + 1 < track.size(); ++k) {
      const Vec2 there = last.position + (track[k].time_s - last.time_s) * velocity;
      if (distance(there, track[k].position) > tolerance(options)) return stride;
    }
    const bool rests = distance(last.position, track[first].position) <= tolerance(options);
    stride.velocity_mps = rests ? Vec2{} : velocity;
  }
  return stride;
}

Walk straight_on(const Stride& stride, double until_s) {
  Walk walk{{{stride.seen_s, stride.position}}};
  if (squared_norm(stride.velocity_mps) > 0.0 && until_s > stride.seen_s) {
    walk.knots.push_back({until_s, stride.position + (until_s - stride.seen_s) * stride.velocity_mps});
  }
  return walk;
}

Walk possible_future(const VisitMap& map, const Stride& stride, double until_s, Rng& rng) {
  Walk walk{{{stride.seen_s, stride.position}}};
  double time_s = stride.seen_s;
  Vec2 at = stride.position;
  const double speed = norm(stride.velocity_mps);
  if (speed > 0.0) {
    const double way = way_ahead(map, stride, rng) + 1e-6;
    at = at + way / speed * stride.velocity_mps;
    time_s += way / speed;
    walk.knots.push_back({time_s, at});
  }
  std::vector<double> weights = map.seconds;
  for (double& weight : weights) weight += prior_s / static_cast<double>(weights.size());
  while (time_s < until_s) {
    time_s += -std::log1p(-rng.uniform()) * map.rest_s / map.rests + 1e-6;
    walk.knots.push_back({time_s, at});
    const Vec2 next = map.regions[drawn(weights, rng)];
    time_s += distance(at, next) / map.speed_mps + 1e-6;
    walk.knots.push_back({time_s, next});
    at = next;
  }
  return walk;
}

}  // namespace outrider
