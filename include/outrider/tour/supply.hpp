// Tours on finite supplies: the tour problem for a robot whose water and charge run out, with stations
// that fill them up.
//
// What the model of problem.hpp becomes:
//  - Both stores are full at first. A service takes `water_per_shot` and `charge_per_shot`. Every metre
//    driven takes `charge_per_metre`, every second of turning, driving, aiming and serving
//    `charge_per_second`.
//  - A station is a stop of the table that fills one store. The robot turns and drives there, brings its gun
//    to rest (yaw and pitch zero, relative to the body), then fills the store to the brim in fixed_s +
//    per_unit_s x what was missing. The station feeds the robot meanwhile: nothing drains.
//  - No store falls below zero. Where the charge can run out and some station gives charge, then after each
//    service it suffices to turn and drive to such a station: the robot is never stranded.
//
// solve_supplied() is our own solver: for few goals an A* over (goals served, stop, heading, gun, water,
// charge), which proves the optimum; for many, ruin and recreate over the order of the services, where each
// order is worth what the best stations put in between make of it. docs/jobs/stations.md has the argument.
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
  double fixed_s = 0.0;
  double per_unit_s = 0.0;
};

struct SupplyProblem {
  TourProblem table;
  std::vector<double> lengths_m;  ///< of the drives of the table, in their order; not read where infinite
  double water = std::numeric_limits<double>::infinity();   ///< that the full tank holds; infinite: no end
  double charge = std::numeric_limits<double>::infinity();  ///< that the full battery gives, J
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

struct SupplyTour {
  std::vector<SupplyStep> steps;
  std::vector<std::uint32_t> dropped;  ///< goals that the supplies were not found to suffice for, ascending
  double cost_s = 0.0;                 ///< from the start to the end of the last step
  bool proven_optimal = false;         ///< serves every goal, and no such tour takes less
  bool proven_too_much = false;        ///< no tour serves every goal
  std::uint64_t expansions = 0;        ///< labels of the exact search
  std::uint64_t iterations = 0;        ///< of ruin and recreate
};

/// What is left after a step, and when that is.
struct SupplyLevel {
  double time_s = 0.0;
  double water = 0.0;
  double charge = 0.0;
  double filling_s = 0.0;  ///< at a station, of the time
};

struct SupplyOptions {
  std::int64_t exact_goals = 8;
  std::int64_t expansions = 300'000;
  std::int64_t iterations = 3'000;
  std::int64_t seed = 1;
};

std::vector<Option> describe(SupplyOptions& options);

/// Refuses what check(TourProblem) refuses, wrong sizes, numbers that are negative or not finite (but for the
/// capacities), a tank or a battery that is too small for any service, and stations of a store without end.
Status check(const SupplyProblem& problem);

/// Levels after each step under the model; written apart from the solvers, to judge them. Fault no_path with
/// the first step that cannot be done, and why. O(steps + services at their stops).
Outcome<std::vector<SupplyLevel>> levels(const SupplyProblem& problem, const std::vector<SupplyStep>& steps);

/// A tour that serves every goal, or as many as were found to be possible. Same problem and options, same
/// tour, unless the budget has a wall time or is cancelled. Errors: bad_input; no_path when no stop that can
/// be reached serves some goal; those of the budget when nothing could be started.
Outcome<SupplyTour> solve_supplied(const SupplyProblem& problem, const SupplyOptions& options,
                                   const Budget& budget);

}  // namespace outrider
