// StopTable: places of a yard, the routes between them and the tour problem over them, with the shots from
// each place as its services. Every plan of a tour is made from one: of a still yard, of the part of a robot,
// with stations, and of intruders that come, survive or walk. A table does not depend on who is inside, so
// for those it is made once (precompute_stops()), and a new plan takes milliseconds.
#pragma once

#include <vector>

#include "outrider/jobs/guard/plan/plan.hpp"
#include "outrider/tour/problem.hpp"

namespace outrider {

/// Places with the tour problem over them.
struct StopTable {
  std::vector<Vec2> stops;           ///< positions; the start comes first
  TourProblem table;                 ///< over the stops
  Routes routes{nullptr};            ///< between the stops
  std::vector<char> reachable = {};  ///< by goal: at least one stop has a shot at it
  std::vector<Visit> tour = {};      ///< of the plan that the stops were computed from; its goals are targets
  bool on_the_move = false;          ///< as the plan (GuardPlan): services with sure shots take no time
};

/// A shot that a tour may take.
struct ShotOffer {
  std::size_t stop = 0;
  std::size_t goal = 0;
  std::optional<PlannedShot> shot;  ///< nothing is offered without one
  bool planned = false;             ///< the plan has it, however often it misses
};

/// Joins the stops by routes and makes the tour problem over them, with that many goals. Of the shots at a
/// goal those are services that hit nearly always or are planned; any, if none hits nearly always. Faults:
/// those of yard_routes().
Outcome<StopTable> stop_table(const GuardProblem& problem, const FiringMap& firing_map,
                              std::vector<Vec2> stops, std::size_t goals,
                              const std::vector<ShotOffer>& offers, bool on_the_move, const Budget& budget);

/// Return the time that the robot spends on a shot once the gun is aimed, s, and the service of a goal by it:
/// on the move none if the shot hits for sure; otherwise the flight times the mean number of flights until a
/// hit.
double service_time(const PlannedShot& shot, bool on_the_move);
Service service_of(std::size_t goal, const PlannedShot& shot, bool on_the_move);

/// Returns the services of some goals, which are ascending and numbered anew, by stop.
std::vector<std::vector<Service>> services_of(const TourProblem& table,
                                              const std::vector<std::size_t>& goals);

inline constexpr std::size_t usual_stops = 100;

/// Computes the table with the targets as goals. Its stops are those of `plan`, a plan for still targets, and
/// up to `most` further ones by choose_stops() (stops.hpp). The places `besides` are added at the end,
/// without shots. Faults: those of yard_routes(); cancelled.
Outcome<StopTable> precompute_stops(const GuardProblem& problem, const FiringMap& firing_map,
                                    const GuardPlan& plan, std::size_t most, const Budget& budget,
                                    const std::vector<Vec2>& besides = {});

}  // namespace outrider
