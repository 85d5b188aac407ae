#include "outrider/motion/wheel_faults.hpp"

namespace outrider {

std::vector<Option> describe(WheelFaults& faults) {
  return {
      {"wheel_1", "", 0.1, 2.0, "gain of the first wheel, by the order of the chassis", &faults.gains[0]},
      {"wheel_2", "", 0.1, 2.0, "gain of the second wheel", &faults.gains[1]},
      {"wheel_3", "", 0.1, 2.0, "gain of the third wheel", &faults.gains[2]},
      {"wheel_4", "", 0.1, 2.0, "gain of the fourth wheel", &faults.gains[3]},
      {"backwards", "", 0.1, 2.0, "gain of every wheel that turns backwards", &faults.backwards},
      {"dead_time", "s", 0.0, 2.0, "between a command to a wheel at rest and its first motion",
       &faults.dead_time_s},
      {"lag", "s", 0.0, 2.0, "time constant with which wheels follow commands", &faults.lag_s},
      {"deadband", "rad/s", 0.0, 10.0, "commands below it leave a wheel at rest", &faults.deadband_radps},
      {"sag", "1/min", 0.0, 0.5, "part of the speed that the battery loses per minute of driving",
       &faults.sag_per_min},
      {"strafe_slip", "", 0.0, 0.9, "part of sideways motion that slips away", &faults.strafe_slip},
      {"noise", "", 0.0, 0.5, "standard deviation of the speed of a wheel, relative", &faults.noise},
      {"noise_time", "s", 0.01, 10.0, "correlation time of that noise", &faults.noise_time_s},
      {"stuck_wheel", "", 1, 4, "number of the wheel that sticks", &faults.stuck_wheel},
      {"stuck_from", "s", 0.0, 1e9, "from then on that wheel does not turn", &faults.stuck_from_s},
      {"stuck_for", "s", 0.0, 1e9, "for how long", &faults.stuck_for_s},
  };
}

std::vector<Option> describe(LinkFaults& faults) {
  return {
      {"lost", "", 0, 1000, "messages that are lost at the beginning", &faults.lost},
      {"delay", "s", 0.0, 2.0, "of every message", &faults.delay_s},
      {"jitter", "s", 0.0, 2.0, "most that is added to the delay", &faults.jitter_s},
      {"down_from", "s", 0.0, 1e9, "from then on every message is lost", &faults.down_from_s},
      {"down_for", "s", 0.0, 1e9, "for how long", &faults.down_for_s},
      {"repeated", "", 0.0, 1.0, "part of the messages that arrive a second time, later", &faults.repeated},
      {"reordered", "", 0.0, 1.0, "part of the messages that come later than some sent after them",
       &faults.reordered},
      {"later", "s", 0.0, 10.0, "most by which these come later", &faults.later_s},
  };
}

}  // namespace outrider
