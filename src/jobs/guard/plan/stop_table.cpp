#include "outrider/jobs/guard/plan/stop_table.hpp"

#include <algorithm>
#include <cmath>

#include "outrider/core/parallel.hpp"
#include "outrider/jobs/guard/plan/stops.hpp"

namespace outrider {
namespace {

constexpr double tile_m = 0.8;

struct Offer {
  std::size_t stop = 0;
  std::size_t target = 0;
  double pitch_rad = 0.0;
  std::optional<PlannedShot> shot;
};

void offer_plan(const GuardPlan& plan, PrecomputedStops& precomputed, std::vector<Offer>& offers) {
  for (const PlannedStop& stop : plan.stops) {
    Visit visit{precomputed.stops.size(), {}};
    for (const PlannedHit& hit : stop.hits) {
      offers.push_back({visit.stop, hit.target, 0.0, hit.shot});
      visit.goals.push_back(static_cast<std::uint32_t>(hit.target));
    }
    precomputed.stops.push_back(stop.position);
    precomputed.tour.push_back(std::move(visit));
  }
}

/// Fault: cancelled.
Status offer_others(const GuardProblem& problem, const FiringMap& firing_map, std::size_t most,
                    PrecomputedStops& precomputed, std::vector<Offer>& offers, const std::stop_token& stop) {
  const SureHits hits = sure_hits(problem, firing_map);
  const std::size_t planned = offers.size();
  const auto pitches = pitch_lattice(firing_map.rules);
  for (const std::size_t cell : choose_stops(firing_map, hits, tile_m, most, {}, 0.0)) {
    const Vec2 place = firing_map.frame.centre(firing_map.frame.cell(cell));
    if (std::find(precomputed.stops.begin(), precomputed.stops.end(), place) != precomputed.stops.end())
      continue;
    for (std::size_t t = 0; t < problem.targets.size(); ++t) {
      if (hits.has(cell, t)) {
        offers.push_back({precomputed.stops.size(), t, pitches[firing_map.regions[t].pitch[cell]], {}});
      }
    }
    precomputed.stops.push_back(place);
  }
  const bool done = parallel_for(offers.size() - planned, stop, [&](std::size_t i) {
    Offer& offer = offers[planned + i];
    offer.shot = best_shot(firing_map.rules, firing_map.space(offer.target), problem.targets[offer.target],
                           precomputed.stops[offer.stop], offer.pitch_rad);
  });
  if (!done) return fault(FaultCode::cancelled, "it was cancelled while it looked for shots");
  return {};
}

/// The services of the offers: those of the plan, the first stops, and good ones alone where a target has
/// such.
void take(const std::vector<Offer>& offers, PrecomputedStops& precomputed) {
  TourProblem& table = precomputed.table;
  std::vector<char> good(table.goals, 0);
  for (const Offer& offer : offers) {
    if (offer.shot && offer.shot->hit_rate >= good_rate) good[offer.target] = 1;
  }
  table.services.resize(precomputed.stops.size());
  precomputed.reachable.assign(table.goals, 0);
  for (const Offer& offer : offers) {
    const bool planned = offer.stop <= precomputed.tour.size();
    if (!offer.shot) continue;
    if (!planned && good[offer.target] != 0 && offer.shot->hit_rate < good_rate) continue;
    if (!std::isfinite(table.drives[offer.stop].time_s)) continue;  // from the start
    table.services[offer.stop].push_back(service_of(offer.target, *offer.shot, precomputed.on_the_move));
    precomputed.reachable[offer.target] = 1;
  }
}

}  // namespace

Outcome<StopTable> stop_table(const GuardProblem& problem, const FiringMap& firing_map,
                              std::vector<Vec2> stops, std::size_t goals, const Budget& budget) {
  auto routes = yard_routes(problem, firing_map, stops, budget);
  if (!routes) return pass_on(routes);
  TourProblem table{goals,
                    problem.start.heading_rad,
                    problem.robot.turning(),
                    problem.gun.yaw_rate_radps,
                    problem.gun.pitch_rate_radps,
                    {},
                    {}};
  for (std::size_t i = 0; i < stops.size(); ++i) {
    for (std::size_t j = 0; j < stops.size(); ++j) table.drives.push_back(routes->between(i, j));
  }
  return StopTable{std::move(stops), std::move(table), std::move(*routes)};
}

double service_time(const PlannedShot& shot, bool on_the_move) {
  constexpr double least_rate = 0.05;
  return is_awaited(shot, on_the_move) ? shot.flight_s / std::max(shot.hit_rate, least_rate) : 0.0;
}

Service service_of(std::size_t goal, const PlannedShot& shot, bool on_the_move) {
  return {static_cast<std::uint32_t>(goal), shot.gun.yaw_rad, shot.gun.pitch_rad,
          service_time(shot, on_the_move)};
}

std::vector<std::vector<Service>> services_of(const TourProblem& table,
                                              const std::vector<std::size_t>& goals) {
  std::vector<std::vector<Service>> services(table.services.size());
  for (std::size_t stop = 0; stop < services.size(); ++stop) {
    for (Service service : table.services[stop]) {
      const auto at = std::ranges::lower_bound(goals, service.goal);
      if (at == goals.end() || *at != service.goal) continue;
      service.goal = static_cast<std::uint32_t>(at - goals.begin());
      services[stop].push_back(service);
    }
  }
  return services;
}

Outcome<PrecomputedStops> precompute_stops(const GuardProblem& problem, const FiringMap& firing_map,
                                           const GuardPlan& plan, const ArrivalOptions& options,
                                           const Budget& budget, const std::vector<Vec2>& besides) {
  PrecomputedStops precomputed;
  precomputed.stops = {problem.start.position};
  precomputed.on_the_move = plan.on_the_move;
  std::vector<Offer> offers;
  offer_plan(plan, precomputed, offers);
  const auto most = static_cast<std::size_t>(options.stops);
  if (auto ok = offer_others(problem, firing_map, most, precomputed, offers, budget.stop); !ok)
    return pass_on(ok);
  precomputed.stops.insert(precomputed.stops.end(), besides.begin(), besides.end());

  auto joined = stop_table(problem, firing_map, std::move(precomputed.stops), problem.targets.size(), budget);
  if (!joined) return pass_on(joined);
  static_cast<StopTable&>(precomputed) = std::move(*joined);
  take(offers, precomputed);
  return precomputed;
}

}  // namespace outrider
