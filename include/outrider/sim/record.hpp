// SimRecord: measurements of what a simulated robot does, beside its log.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace outrider {

/// Additional measurements of a robot simulated with rigid bodies.
struct RigidRecord {
  /// For each drive, the distance between the goal sent to the wheels and the place reached.
  std::vector<double> arrival_errors_m = {};
  double flight_error_m = 0.0;           ///< largest distance from a contact to the parabola at that time
  int as_foreseen = 0;                   ///< number of shots whose first contact agrees with the exact flight
  int bumps = 0;                         ///< solids touched by the robot, each counted once per drive
  std::vector<std::string> misses = {};  ///< by target: how the last shot missed; empty before the first miss
};

/// Additional measurements of a robot that its navigator takes to places.
struct NavigatedRecord {
  std::int64_t contacts = 0;
  std::int64_t walked_into = 0;  ///< how often somebody walked into the robot, which stood
  std::int64_t recoveries = 0;
  double blocked_s = -1.0;      ///< when a post was put in its way; negative: none was
  double belief_error_m = 0.0;  ///< largest distance between where it was and where it believed to be
};

/// The record of a simulated robot so far.
struct SimRecord {
  std::optional<RigidRecord> rigid = {};  ///< set if rigid bodies are simulated
  std::optional<NavigatedRecord> navigated = {};
  double driven_m = 0.0;
  double turned_rad = 0.0;
  std::size_t shots = 0;
  std::size_t contacts = 0;       ///< with what the map has; only a robot that was put elsewhere has any
  std::size_t post_contacts = 0;  ///< with what was put in its way (way_faults.hpp)
};

}  // namespace outrider
