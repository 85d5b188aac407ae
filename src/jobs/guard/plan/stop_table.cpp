#include "outrider/jobs/guard/plan/stop_table.hpp"

#include <algorithm>
#include <cmath>

#include "outrider/core/parallel.hpp"
#include "outrider/jobs/guard/plan/stops.hpp"

namespace outrider {
namespace {

constexpr double tile_m = 0.8;

/// Adds the stops of a plan with its shots.
void offer_plan(const GuardPlan& plan, StopTable& table, std::vector<ShotOffer>& offers) {
  for (const PlannedStop& stop : plan.stops) {
    Visit visit{table.stops.size(), {}};
    for (const PlannedHit& hit : stop.hits) {
      offers.push_back({visit.stop, hit.target, hit.shot, true});
      visit.goals.push_back(static_cast<std::uint32_t>(hit.target));
    }
    table.stops.push_back(stop.position);
    table.tour.push_back(std::move(visit));
  }
}

/// Adds further stops with the shots from there. Fault: cancelled.
Status offer_others(const GuardProblem& problem, const FiringMap& firing_map, std::size_t most,
                    std::vector<Vec2>& stops, std::vector<ShotOffer>& offers, const std::stop_token& stop) {
  const SureHits hits = sure_hits(problem, firing_map, targets_with_region(firing_map));
  const std::size_t planned = offers.size();
  const auto pitches = pitch_lattice(firing_map.rules);
  std::vector<double> pitches_rad;
  for (const std::size_t cell : choose_stops(firing_map, hits, tile_m, most, {}, 0.0)) {
    const Vec2 place = firing_map.place(cell);
    if (std::ranges::find(stops, place) != stops.end()) continue;
    for (std::size_t t = 0; t < problem.targets.size(); ++t) {
      if (!hits.has(cell, t)) continue;
      offers.push_back({stops.size(), t, {}});
      pitches_rad.push_back(pitches[firing_map.regions[t].pitch[cell]]);
    }
    stops.push_back(place);
  }
  const bool done = parallel_for(pitches_rad.size(), stop, [&](std::size_t i) {
    ShotOffer& offer = offers[planned + i];
    offer.shot = shot_from(problem, firing_map, offer.goal, stops[offer.stop], pitches_rad[i]);
  });
  if (!done) return fault(FaultCode::cancelled, "it was cancelled while it looked for shots");
  return {};
}

/// Makes the shots services of the table.
void take(const std::vector<ShotOffer>& offers, StopTable& stops) {
  TourProblem& table = stops.table;
  std::vector<char> good(table.goals, 0);
  for (const ShotOffer& offer : offers) {
    if (offer.shot && offer.shot->hit_rate >= good_rate) good[offer.goal] = 1;
  }
  table.services.resize(stops.stops.size());
  stops.reachable.assign(table.goals, 0);
  for (const ShotOffer& offer : offers) {
    if (!offer.shot) continue;
    if (!offer.planned && good[offer.goal] != 0 && offer.shot->hit_rate < good_rate) continue;
    if (!std::isfinite(table.drives[offer.stop].time_s)) continue;  // from the start
    table.services[offer.stop].push_back(service_of(offer.goal, *offer.shot, stops.on_the_move));
    stops.reachable[offer.goal] = 1;
  }
}

}  // namespace

Outcome<StopTable> stop_table(const GuardProblem& problem, const FiringMap& firing_map,
                              std::vector<Vec2> stops, std::size_t goals,
                              const std::vector<ShotOffer>& offers, bool on_the_move, const Budget& budget) {
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
  StopTable joined{std::move(stops), std::move(table), std::move(*routes)};
  joined.on_the_move = on_the_move;
  take(offers, joined);
  return joined;
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

Outcome<StopTable> precompute_stops(const GuardProblem& problem, const FiringMap& firing_map,
                                    const GuardPlan& plan, std::size_t most, const Budget& budget,
                                    const std::vector<Vec2>& besides) {
  StopTable planned{{problem.start.position}, {}};
  std::vector<ShotOffer> offers;
  offer_plan(plan, planned, offers);
  std::vector<Vec2>& stops = planned.stops;
  if (auto ok = offer_others(problem, firing_map, most, stops, offers, budget.stop); !ok) return pass_on(ok);
  stops.insert(stops.end(), besides.begin(), besides.end());
  auto table = stop_table(problem, firing_map, std::move(stops), problem.targets.size(), offers,
                          plan.on_the_move, budget);
  if (table) table->tour = std::move(planned.tour);
  return table;
}

}  // namespace outrider
