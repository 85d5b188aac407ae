// Supplied: an instance with stores, and one robot's state on it: where it is, when, with how much.
#pragma once

#include <vector>

#include "instance.hpp"
#include "outrider/tour/supply/supply.hpp"

namespace outrider::tour {

/// A station at a stop of the instance.
struct FuelStation {
  std::uint32_t stop = 0;
  Store store = Store::water;
  double fixed = 0.0;
  double per_unit = 0.0;
  std::size_t name = 0;  // index in the problem
};

/// A store counts as not yet empty down to this part of a full one below nothing.
inline constexpr double store_rounding = 1e-9;

struct Supplied {
  Instance instance;           // the stops of stations are kept
  std::vector<double> metres;  // [from * stops + to]
  double water = 0.0;
  double charge = 0.0;
  double per_shot = 0.0;  // of water
  double charge_per_shot = 0.0;
  double per_metre = 0.0;
  double per_second = 0.0;
  std::vector<FuelStation> depots;  // those that the start reaches
  bool returns = false;             // some depot gives charge, and the charge can run out
};

/// The problem has passed check(). Fault no_path when a goal cannot be served.
Outcome<Supplied> compile(const SupplyProblem& problem);

struct Fuel {
  State state;
  double time = 0.0;
  double water = 0.0;
  double charge = 0.0;
};

Fuel full_at_start(const Supplied& supplied);

/// Least charge for the turn and the drive to a depot that gives charge.
double charge_home(const Supplied& supplied, const State& state);

/// Drives to the node and serves it; false, and `fuel` is worthless, when a store runs out on the way or the
/// robot would be stranded afterwards.
bool serve(const Supplied& supplied, Fuel& fuel, const TourNode& node);

/// Drives to the depot, brings the gun to rest and fills up; false when the charge does not suffice.
bool fill(const Supplied& supplied, Fuel& fuel, const FuelStation& depot);

/// Reading steps as the nodes and, behind all nodes, the depots that they are made of.
std::vector<SupplyStep> steps_of(const Supplied& supplied, const std::vector<std::uint32_t>& choices);

}  // namespace outrider::tour
