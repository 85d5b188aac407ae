// GuardSimParams: what goes wrong with a simulated gun robot without its mission being told.
#pragma once

#include <cstdint>
#include <vector>

#include "outrider/core/options.hpp"
#include "outrider/core/planner_outage.hpp"
#include "outrider/sim/faults/execution_errors.hpp"
#include "outrider/sim/faults/way_faults.hpp"

namespace outrider {

/// Faults of a water gun. While it is jammed, and when its tank is empty, the trigger fires nothing, and
/// nothing is reported of the shot.
struct GunFaults {
  double jammed_at_s = 1e9;            ///< time at which the gun jams
  double jammed_for_s = 1e9;           ///< duration of the jam
  std::int64_t balls = 1'000'000'000;  ///< balls in the tank at the start and after each filling

  [[nodiscard]] bool jammed(double time_s) const {
    return time_s >= jammed_at_s && time_s < jammed_at_s + jammed_for_s;
  }
};

/// The faults of the whole robot.
struct GuardSimParams {
  GunFaults gun;
  WayFaults way;
  PlannerOutage planner;        ///< none by default
  double position_ratio = 1.0;  ///< true largest error of the end of a drive, relative to the one told
  double aim_ratio = 1.0;       ///< true largest errors of joints and muzzle speed, relative to those told

  /// Returns true if any fault was asked for.
  [[nodiscard]] bool any() const;
};
/// Returns the true bounds of the errors of a robot of which `told` is believed.
ExecutionErrors true_errors(ExecutionErrors told, const GuardSimParams& params);

std::vector<Option> describe(GuardSimParams& params);

}  // namespace outrider
