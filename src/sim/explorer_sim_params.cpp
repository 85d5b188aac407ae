#include "outrider/sim/explorer_sim_params.hpp"

namespace outrider {

std::vector<Option> describe(RangeFinderModel& laser) {
  return {
      {"beams", "", 4, 10'000, "of a turn, equally far apart", &laser.beams},
      {"rate", "Hz", 0.1, 100.0, "turns a second", &laser.rate_hz},
      {"least", "m", 0.0, 10.0, "what is nearer gives no reading", &laser.least_m},
      {"most", "m", 0.1, 100.0, "what is farther is not seen", &laser.most_m},
      {"noise", "m", 0.0, 1.0, "of a range, standard deviation", &laser.noise_m},
      {"missed", "", 0.0, 1.0, "part of the beams that give no reading", &laser.missed},
      {"height", "m", 0.0, 10.0, "of the laser above the floor", &laser.height_m},
  };
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

}  // namespace outrider
