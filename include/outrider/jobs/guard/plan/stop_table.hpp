// StopTable: places of a yard, the routes between them and the tour problem over them. Every plan of a tour
// is made from one. They do not depend on the intruders inside, so where these come, survive or walk a table
// is made once (PrecomputedStops), and a new plan takes milliseconds.
#pragma once

#include <vector>

#include "outrider/jobs/guard/plan/plan.hpp"
#include "outrider/jobs/guard/yard/arrivals.hpp"
#include "outrider/tour/problem.hpp"

namespace outrider {

/// Places with the tour problem over them.
struct StopTable {
  std::vector<Vec2> stops;  ///< positions; the start comes first
  TourProblem table;        ///< over the stops; its services are added by whoever makes it
  Routes routes{nullptr};   ///< between the stops
};

/// Joins the stops by routes and makes the tour problem over them, with that many goals and without services.
/// Faults: those of yard_routes().
Outcome<StopTable> stop_table(const GuardProblem& problem, const FiringMap& firing_map,
                              std::vector<Vec2> stops, std::size_t goals, const Budget& budget);

/// Return the time that the robot spends on a shot once the gun is aimed, s, and the service of a goal by it:
/// on the move none if the shot hits for sure; otherwise the flight times the mean number of flights until a
/// hit.
double service_time(const PlannedShot& shot, bool on_the_move);
Service service_of(std::size_t goal, const PlannedShot& shot, bool on_the_move);

/// Returns the services of some goals, which are ascending and numbered anew, by stop.
std::vector<std::vector<Service>> services_of(const TourProblem& table,
                                              const std::vector<std::size_t>& goals);

/// The result of precompute_stops(). The goals of the table are the targets.
struct PrecomputedStops : StopTable {
  std::vector<Visit> tour;      ///< the tour of the plan for still targets
  std::vector<char> reachable;  ///< by target: at least one stop has a shot at it
  bool on_the_move = false;     ///< as the plan (GuardPlan): services with sure shots take no time
};

/// Computes the stops. They are the stops of `plan`, a plan for still targets, and up to `options.stops`
/// further ones by choose_stops() (stops.hpp). The time of a service is the flight time divided by the hit
/// rate; if `plan` is on the move, 0 for shots that hit for sure. Shots that often miss are used only for
/// targets that have no other shots. The places `besides` are added at the end, without shots. Faults: those
/// of routes_between().
Outcome<PrecomputedStops> precompute_stops(const GuardProblem& problem, const FiringMap& firing_map,
                                           const GuardPlan& plan, const ArrivalOptions& options,
                                           const Budget& budget, const std::vector<Vec2>& besides = {});

}  // namespace outrider
