#include "outrider/sim/faults/explorer_sim_params.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace outrider {

std::vector<Option> describe(RangeFinderModel& laser) {
  return {
      {"beams", "", 4, 10'000, "of a turn, equally far apart", &laser.beams},
      {"view", "deg", 1.0, 360.0, "angle about ahead that the laser sees", &laser.view_rad},
      {"rate", "Hz", 0.1, 100.0, "turns a second", &laser.rate_hz},
      {"least", "m", 0.0, 10.0, "what is nearer gives no reading", &laser.least_m},
      {"most", "m", 0.1, 100.0, "what is farther is not seen", &laser.most_m},
      {"noise", "m", 0.0, 0.5, "of a range, standard deviation", &laser.noise_m},
      {"missed", "", 0.0, 1.0, "part of the beams that give no reading", &laser.missed},
      {"height", "m", 0.0, 10.0, "of the laser above the floor", &laser.height_m},
  };
}

Status check(const RangeFinderModel& laser) {
  if (laser.least_m < laser.most_m) return {};
  return bad_input(fmt::format("'{:g}' is not valid; expected less than laser.most, which is {:g} m",
                               laser.least_m, laser.most_m),
                   "laser.least");
}

std::vector<Option> describe(ExplorerWheels& wheels) {
  return {
      {"track", "m", 0.01, 10.0, "between the wheels", &wheels.track_m},
      {"climbs", "m", 1e-3, 10.0,
       "what rises less than this above the floor is driven over; a laser above sees nothing of it",
       &wheels.climbs_m},
      {"scale_error", "", 0.0, 0.2,
       "of the way that the odometry counts by each wheel, relative, standard deviation; drawn once",
       &wheels.scale_error},
      {"noise", "m", 0.0, 1.0, "of that way after 1 m, standard deviation; it grows with the root of the way",
       &wheels.noise_m},
  };
}

std::vector<Option> describe(ExplorerFaults& faults) {
  std::vector<Option> options = {
      {"blind_from", "s", 0.0, 1e9, "from then on no scan comes", &faults.blind_from_s},
      {"blind_for", "s", 0.0, 1e9, "for how long", &faults.blind_for_s},
      {"bias", "m", -1.0, 1.0, "added to every range", &faults.bias_m},
      {"outliers", "", 0.0, 1.0, "part of the beams that give any range", &faults.outliers},
      {"latency", "s", 0.0, 10.0, "a scan arrives so long after it was measured", &faults.latency_s},
      {"frozen_from", "s", 0.0, 1e9, "from then on every scan repeats the last ranges",
       &faults.frozen_from_s},
      {"slip", "", 0.0, 1.0, "part of what both wheels roll that does not move the robot", &faults.slip},
      {"stuck_from", "s", 0.0, 1e9, "from then on the left wheel does not turn", &faults.stuck_from_s},
      {"stuck_for", "s", 0.0, 1e9, "for how long", &faults.stuck_for_s},
  };
  for (const std::vector<Option>& more : {describe(faults.kidnapping), describe(faults.clock)})
    options.insert(options.end(), more.begin(), more.end());
  return options;
}

bool ExplorerFaults::any() const {
  ExplorerFaults given = *this, none;
  const auto differ = [](const std::vector<Option>& one, const std::vector<Option>& other) {
    return !std::ranges::equal(one, other, {}, value_text, value_text);
  };
  return differ(describe(given), describe(none)) || differ(describe(given.walk_ins), describe(none.walk_ins));
}

}  // namespace outrider
