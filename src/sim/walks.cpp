#include "outrider/sim/walks.hpp"

#include <algorithm>
#include <cmath>

#include "outrider/core/rng.hpp"

namespace outrider {
namespace {

/// Returns the next place, by weight, among those with a way; `from` itself if there is none.
std::size_t next_place(const Routes& routes, const std::vector<double>& weights, std::size_t from, Rng& rng) {
  std::vector<double> sums;
  double sum = 0.0;
  for (std::size_t to = 0; to < weights.size(); ++to) {
    if (to != from && std::isfinite(routes.between(from, to).time_s)) sum += weights[to];
    sums.push_back(sum);
  }
  if (sum <= 0.0) return from;
  const double drawn = rng.uniform() * sum;
  return static_cast<std::size_t>(std::upper_bound(sums.begin(), sums.end(), drawn) - sums.begin());
}

}  // namespace

Outcome<std::vector<Walk>> draw_walks(const Walkers& walkers, const Routes& routes, std::uint64_t seed,
                                      double until_s, const std::stop_token& stop) {
  const std::vector<Vec2>& places = walkers.places;
  std::vector<Walk> walks;
  for (std::size_t i = 0; i < places.size(); ++i) {
    Rng rng = Rng(seed).child("wander").child(i);
    if (stop.stop_requested()) return fault(FaultCode::cancelled, "it was cancelled while it drew walks");
    double time_s = 0.0;
    Walk walk{{{0.0, places[i]}}};
    for (std::size_t at = i; time_s < until_s;) {
      time_s += -std::log1p(-rng.uniform()) * walkers.rest_s + 1e-3;
      walk.knots.push_back({time_s, places[at]});
      const std::size_t next = next_place(routes, walkers.weights, at, rng);
      if (next == at) break;
      const auto way = routes.waypoints(at, next);
      for (std::size_t k = 1; k < way.size(); ++k) {
        time_s += distance(way[k - 1], way[k]) / walkers.speed_mps;
        walk.knots.push_back({time_s, way[k]});
      }
      at = next;
    }
    walks.push_back(std::move(walk));
  }
  return walks;
}

}  // namespace outrider
