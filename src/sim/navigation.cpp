#include "outrider/sim/navigation.hpp"

namespace outrider {

std::vector<OptionGroup> describe(NavigationOptions& options) {
  return {
      {"laser", "the range finder of a robot that goes around what stands there", describe(options.laser)},
      {"wheels", "its wheels and how they count wrong", describe(options.wheels)},
      {"walk_ins", "who walks there, and what is put in its way", describe(options.faults.walk_ins)},
      {"navigator", "how it gets there", describe(options.navigator)},
      {"live_map", "what it remembers of what it sees", describe(options.live_map)},
      {"motion", "how the next motion is found", describe(options.motion)}};
}

ExplorerSimParams devices_of(const NavigationOptions& options, const Footprint& footprint) {
  ExplorerSimParams params;
  params.laser = options.laser;
  params.wheels = options.wheels;
  params.wheels.exact = options.navigator.localiser == "exact";
  params.footprint = footprint;
  params.faults = options.faults;
  return params;
}

NavigatorSetup setup_of(const NavigationOptions& options, const RobotModel& robot,
                        const Footprint& footprint) {
  NavigatorSetup setup;
  setup.robot = robot;
  setup.footprint = footprint;
  setup.robot_T_laser = options.laser.robot_T_laser;
  setup.options = options.navigator;
  setup.map = options.live_map;
  setup.motion = options.motion;
  return setup;
}

}  // namespace outrider
