// Tours with limited supplies: the tour problem for a robot with limited water and charge, and with stations
// that fill its stores.
//
// Additions to the model of problem.hpp:
//  - Both stores are full at the start. A service uses `water_per_shot` and `charge_per_shot`. Each metre
//  driven uses
//    `charge_per_metre`, and each second of turning, driving, aiming and serving uses `charge_per_second`.
//  - A station is a stop of the table that fills one store. The robot turns and drives there, moves its gun
//  to rest
//    (yaw and pitch zero, relative to the body), then fills the store completely in fixed_s + per_unit_s *
//    missing amount. The station powers the robot meanwhile.
//  - No store may fall below zero. If the charge is limited and a station gives charge, then after each
//  service the
//    charge must suffice to turn and drive to such a station, so the robot is never stranded.
//
// solve_supplied() uses A* over (goals served, stop, heading, gun, water, charge) for few goals and proves
// the optimum. For many goals it uses ruin and recreate over the order of the services; the cost of an order
// is computed with the best stations inserted. docs/jobs/stations.md has the proofs.
#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

#include "outrider/core/budget.hpp"
#include "outrider/core/options.hpp"
#include "outrider/tour/problem.hpp"

namespace outrider {

enum class Store : std::uint8_t { water, charge };

/// A stop of the table where a store is filled.
struct TourStation {
  std::size_t stop = 0;
  Store store = Store::water;
  double fixed_s = 0.0;     ///< fixed time of a fill
  double per_unit_s = 0.0;  ///< additional time per missing unit
};

/// A tour problem with limited supplies.
struct SupplyProblem {
  TourProblem table;
  std::vector<double> lengths_m;  ///< length of each drive of the table; ignored if the drive does not exist
  double water = std::numeric_limits<double>::infinity();  ///< capacity of the tank; infinite: unlimited
  double charge =
      std::numeric_limits<double>::infinity();  ///< capacity of the battery, J; infinite: unlimited
  double water_per_shot = 1.0;
  double charge_per_metre = 0.0;   ///< J/m
  double charge_per_second = 0.0;  ///< W
  double charge_per_shot = 0.0;    ///< J
  std::vector<TourStation> stations;
};

/// A part of a tour: goals served at a stop, or one store filled at a station.
struct SupplyStep {
  std::size_t stop = 0;
  std::vector<std::uint32_t> goals;    ///< in the order of serving; empty at a station
  std::optional<std::size_t> station;  ///< index in the problem
  friend bool operator==(const SupplyStep&, const SupplyStep&) = default;
};

/// A tour with stations.
struct SupplyTour {
  std::vector<SupplyStep> steps;       ///< in order
  std::vector<std::uint32_t> dropped;  ///< goals for which no supplies were found to suffice, ascending
  double cost_s = 0.0;                 ///< from the start to the end of the last step
  bool proven_optimal = false;         ///< the tour serves every goal, and no such tour takes less
  bool proven_too_much = false;        ///< no tour serves every goal
  std::uint64_t expansions = 0;        ///< labels expanded by the exact search
  std::uint64_t iterations = 0;        ///< iterations of ruin and recreate
};

/// The levels of the stores after a step.
struct SupplyLevel {
  double time_s = 0.0;     ///< time at the end of the step
  double water = 0.0;      ///< water left
  double charge = 0.0;     ///< charge left, J
  double filling_s = 0.0;  ///< time spent filling in this step
};

/// Options of the solver.
struct SupplyOptions {
  std::int64_t exact_goals = 8;       ///< largest number of goals for which A* proves the optimum
  std::int64_t expansions = 300'000;  ///< maximum number of labels that A* expands
  std::int64_t iterations = 3'000;    ///< iterations of ruin and recreate
  std::int64_t seed = 1;              ///< seed of the search
};

std::vector<Option> describe(SupplyOptions& options);

/// Checks a problem. Faults: those of check(TourProblem), wrong sizes, numbers that are negative or not
/// finite (except the capacities), a tank or a battery that is too small for any service, and a station for
/// an unlimited store.
Status check(const SupplyProblem& problem);

/// Returns the levels after each step in the model. It shares no code with the solvers, so that it can verify
/// them. Fault: no_path, with the first impossible step and the reason. O(steps + services at their stops).
Outcome<std::vector<SupplyLevel>> levels(const SupplyProblem& problem, const std::vector<SupplyStep>& steps);

/// Finds a tour that serves every goal, or as many goals as the solver finds possible. The same problem and
/// options give the same tour, unless the budget has a wall time or is cancelled. Faults: bad_input; no_path
/// if a goal is not served from any reachable stop; those of the budget if the search ended before the first
/// tour.
Outcome<SupplyTour> solve_supplied(const SupplyProblem& problem, const SupplyOptions& options,
                                   const Budget& budget);

}  // namespace outrider
