// The options of a job whose simulated robot is taken where it should be by the navigator.
#pragma once

#include <vector>

#include "outrider/core/options.hpp"
#include "outrider/navigate/navigator.hpp"
#include "outrider/sim/faults/explorer_sim_params.hpp"

namespace outrider {

struct NavigationOptions {
  RangeFinderModel laser;
  ExplorerWheels wheels;
  ExplorerFaults faults;  ///< and who walks there
  NavigatorOptions navigator;
  LiveMapOptions live_map;
  LocalMotionOptions motion;
};
/// Describes the options, by section of a scenario.
std::vector<OptionGroup> describe(NavigationOptions& options);

/// Returns the devices of the simulated robot.
ExplorerSimParams devices_of(const NavigationOptions& options, const Footprint& footprint);

/// Returns the setup of the navigator, without a known map.
NavigatorSetup setup_of(const NavigationOptions& options, const RobotModel& robot,
                        const Footprint& footprint);

}  // namespace outrider
