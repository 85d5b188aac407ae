#include "outrider/guard/plan.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "outrider/ballistics/sight.hpp"
#include "outrider/guard/bound.hpp"
#include "outrider/guard/stops.hpp"
#include "outrider/tour/solve.hpp"

namespace outrider {
namespace {

constexpr double near_m = 1.2;  // how far from a stop of the tour a better one is looked for
constexpr double coarse_tile_m = 0.8;
constexpr int most_repairs = 8;

/// A tour over cells of the site.
struct Draft {
  std::vector<std::size_t> cells;  ///< by stop of the tour problem; entry 0 is the start
  Tour tour;
};

Vec2 place_of(const GuardProblem& problem, const Site& site, std::size_t cell, std::size_t stop) {
  return stop == 0 ? problem.start.position : site.frame.centre(site.frame.cell(cell));
}

std::vector<Service> services_at(const GuardProblem& problem, const Site& site, const SureHits& hits,
                                 const std::vector<double>& pitches, std::size_t cell) {
  std::vector<Service> services;
  const Vec2 place = site.frame.centre(site.frame.cell(cell));
  for (std::size_t t = 0; t < problem.targets.size(); ++t) {
    if (!hits.has(cell, t)) continue;
    const Vec3 centre = problem.targets[t].centre();
    const Vec2 sight = xy(centre) - place;
    const double pitch = pitches[site.regions[t].pitch[cell]];
    const auto speed = speed_through(problem.gun, pitch, norm(sight), centre.z - problem.world.floor_z_m,
                                     problem.world.gravity_mps2);
    const double forward = speed.value_or(problem.gun.muzzle_speed_mps) * std::cos(pitch);
    const double gap = norm(sight) - muzzle(problem.gun, pitch).x;
    services.push_back(
        {static_cast<std::uint32_t>(t), heading_of(sight), pitch, std::max(0.0, gap) / forward});
  }
  return services;
}

/// The targets of the tour problem are numbered densely; this maps them back.
struct GoalNumbers {
  std::vector<std::uint32_t> goal;    ///< by target; no_goal where it is not asked for
  std::vector<std::uint32_t> target;  ///< by goal
  static constexpr std::uint32_t no_goal = std::numeric_limits<std::uint32_t>::max();
};

GoalNumbers number_goals(const Site& site) {
  GoalNumbers numbers;
  for (std::size_t t = 0; t < site.regions.size(); ++t) {
    const bool asked = site.regions[t].hits > 0;
    numbers.goal.push_back(asked ? static_cast<std::uint32_t>(numbers.target.size()) : GoalNumbers::no_goal);
    if (asked) numbers.target.push_back(static_cast<std::uint32_t>(t));
  }
  return numbers;
}

Outcome<Draft> solve_over(const GuardProblem& problem, const Site& site, const SureHits& hits,
                          const GoalNumbers& numbers, const std::vector<std::size_t>& cells,
                          const GuardOptions& options, const Budget& budget) {
  Draft draft;
  draft.cells.push_back(0);
  draft.cells.insert(draft.cells.end(), cells.begin(), cells.end());
  std::vector<Vec2> places;
  for (std::size_t i = 0; i < draft.cells.size(); ++i) {
    places.push_back(place_of(problem, site, draft.cells[i], i));
  }
  const auto routes = site_routes(problem, site, places, budget);
  if (!routes) return tl::unexpected(routes.error());

  TourProblem tour;
  tour.goals = numbers.target.size();
  tour.heading_rad = problem.start.heading_rad;
  tour.turning = problem.robot.turning();
  tour.yaw_rate_radps = problem.gun.yaw_rate_radps;
  tour.pitch_rate_radps = problem.gun.pitch_rate_radps;
  tour.services.resize(places.size());
  const auto pitches = pitch_lattice(site.rules);
  for (std::size_t i = 1; i < places.size(); ++i) {
    tour.services[i] = services_at(problem, site, hits, pitches, draft.cells[i]);
    for (Service& service : tour.services[i]) service.goal = numbers.goal[service.goal];
  }
  for (std::size_t i = 0; i < places.size(); ++i) {
    for (std::size_t j = 0; j < places.size(); ++j) tour.drives.push_back(routes->between(i, j));
  }
  TourOptions tour_options;
  tour_options.iterations = options.iterations;
  auto solved = solve(tour, tour_options, budget);
  if (!solved) return pass_on(solved);
  draft.tour = std::move(*solved);
  return draft;
}

std::vector<std::size_t> cells_of(const Draft& draft) {
  std::vector<std::size_t> cells;
  for (const Visit& visit : draft.tour.visits) cells.push_back(draft.cells[visit.stop]);
  return cells;
}

/// Solves over a spread of stops, then over the cells near the stops of the best tour.
Outcome<Draft> draft_tour(const GuardProblem& problem, const Site& site, const SureHits& hits,
                          const GoalNumbers& numbers, const GuardOptions& options, const Budget& budget) {
  const auto most = static_cast<std::size_t>(options.stops);
  auto best = solve_over(problem, site, hits, numbers, choose_stops(site, hits, coarse_tile_m, most, {}, 0.0),
                         options, budget);
  if (!best) return best;
  for (std::int64_t i = 0; i < options.refinements; ++i) {
    std::vector<std::size_t> cells = cells_of(*best);
    std::vector<Vec2> around;
    for (const std::size_t cell : cells) around.push_back(site.frame.centre(site.frame.cell(cell)));
    const double tile = 2.0 * site.frame.resolution_m;
    for (const std::size_t cell : choose_stops(site, hits, tile, most, around, near_m)) cells.push_back(cell);
    std::sort(cells.begin(), cells.end());
    cells.erase(std::unique(cells.begin(), cells.end()), cells.end());
    auto closer = solve_over(problem, site, hits, numbers, cells, options, budget);
    if (!closer) return closer;
    if (closer->tour.cost_s >= best->tour.cost_s) break;
    best = std::move(closer);
  }
  return best;
}

/// The exact shots of a tour; the first that cannot be made sure of is struck from the hits instead.
std::optional<std::vector<PlannedStop>> make_sure(const GuardProblem& problem, const Site& site,
                                                  const GoalNumbers& numbers, const Draft& draft,
                                                  bool last_chance, SureHits& hits) {
  std::vector<PlannedStop> stops;
  bool sure = true;
  double pitch = 0.0;
  for (const Visit& visit : draft.tour.visits) {
    const std::size_t cell = draft.cells[visit.stop];
    PlannedStop stop{place_of(problem, site, cell, visit.stop), {}, {}};
    for (const std::uint32_t goal : visit.goals) {
      const std::size_t t = numbers.target[goal];
      const auto shot = best_shot(site.rules, site.space(t), problem.targets[t], stop.position, pitch);
      if (shot) pitch = shot->shot.pitch_rad;
      if ((!shot || !shot->survives) && !last_chance) {
        hits.targets[cell * hits.words + t / 64] &= ~(std::uint64_t{1} << (t % 64));
        sure = false;
        continue;
      }
      stop.hits.push_back({t, shot.value_or(PlannedShot{})});
    }
    stops.push_back(std::move(stop));
  }
  if (!sure) return std::nullopt;
  return stops;
}

/// True when striking hits left each target of the tour with a cell.
bool still_covered(const GoalNumbers& numbers, const SureHits& hits, std::size_t cells) {
  return std::all_of(numbers.target.begin(), numbers.target.end(), [&](std::uint32_t t) {
    for (std::size_t i = 0; i < cells; ++i) {
      if (hits.has(i, t)) return true;
    }
    return false;
  });
}

std::string why_unreachable(const GuardProblem& problem, const Site& site, const GuardOptions& options,
                            std::size_t t) {
  const Exhausted& proof = *site.proofs[t].exhausted;
  if (proof.places == 0) {
    return fmt::format("no place that can be driven to is within reach of it ({:.1f} m at {:g} m/s)",
                       longest_range(site.rules, problem.targets[t]), problem.gun.muzzle_speed_mps);
  }
  std::vector<std::size_t> order;
  for (std::size_t s = 0; s < proof.blocked_by.size(); ++s) {
    if (proof.blocked_by[s] > 0) order.push_back(s);
  }
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return proof.blocked_by[a] > proof.blocked_by[b]; });
  std::string who;
  for (std::size_t i = 0; i < std::min<std::size_t>(3, order.size()); ++i) {
    who += fmt::format(
        "{}{} stops {:.0f} %", i == 0 ? "" : ", ", site.space(t).solids()[order[i]].name,
        100.0 * static_cast<double>(proof.blocked_by[order[i]]) / static_cast<double>(proof.flights));
  }
  return fmt::format(
      "none of {} flights from the {} places within reach hits it with {:g} m to spare ({}); places every "
      "{:g} m, pitches every {:g} degrees, aim points every {:g} m{}",
      proof.flights, proof.places, options.margin_m, who, options.resolution_m,
      degrees(options.pitch_step_rad), options.aim_step_m,
      site.proofs[t].from_elsewhere ? "; from ground that cannot be driven to it could be hit" : "");
}

/// Time of the plan if nothing goes wrong: turns, drives, aims and flights in their order.
double mission_time(const GuardProblem& problem, const GuardPlan& plan) {
  double time = 0.0;
  double heading = problem.start.heading_rad;
  double yaw = 0.0;  // of the gun, relative to the body
  double pitch = 0.0;
  for (const PlannedStop& stop : plan.stops) {
    const DriveCost drive = drive_cost(problem.robot, heading, stop.waypoints);
    time += drive.time_s;
    heading = drive.heading_rad;
    for (const PlannedHit& hit : stop.hits) {
      const Shot& shot = hit.shot.shot;
      const double relative = shot.yaw_rad - heading;
      time += aim_time(problem.gun, relative - yaw, shot.pitch_rad - pitch) + hit.shot.flight_s;
      yaw = relative;
      pitch = shot.pitch_rad;
    }
  }
  return time;
}

}  // namespace

Outcome<GuardPlan> plan_guard(const GuardProblem& problem, const Site& site, const GuardOptions& options,
                              const Budget& budget) {
  GuardPlan plan;
  for (const std::uint8_t cell : site.reachable) plan.places += cell;
  for (std::size_t t = 0; t < problem.targets.size(); ++t) {
    if (site.regions[t].hits == 0)
      plan.unreachable.push_back({t, why_unreachable(problem, site, options, t)});
  }
  const GoalNumbers numbers = number_goals(site);
  if (numbers.target.empty()) return plan;

  SureHits hits = sure_hits(problem, site);
  for (int repair = 0;; ++repair) {
    auto draft = draft_tour(problem, site, hits, numbers, options, budget);
    if (!draft) return pass_on(draft);
    SureHits stricter = hits;
    auto stops = make_sure(problem, site, numbers, *draft, false, stricter);
    if (!stops && repair < most_repairs && still_covered(numbers, stricter, site.frame.size())) {
      hits = std::move(stricter);
      continue;
    }
    if (!stops) stops = make_sure(problem, site, numbers, *draft, true, stricter);
    plan.stops = std::move(*stops);
    plan.tour_proven = draft->tour.proven_optimal;
    break;
  }
  std::vector<Vec2> places{problem.start.position};
  for (const PlannedStop& stop : plan.stops) places.push_back(stop.position);
  auto routes = site_routes(problem, site, places, budget);
  if (!routes) return pass_on(routes);
  for (std::size_t i = 0; i < plan.stops.size(); ++i) plan.stops[i].waypoints = routes->waypoints(i, i + 1);
  plan.routes = std::move(*routes);
  plan.cost_s = mission_time(problem, plan);
  plan.lower_bound_s = mission_bound(problem, site);
  return plan;
}

}  // namespace outrider
