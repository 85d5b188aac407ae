// The faults that a real robot on mecanum wheels has, for tests of drives.
#pragma once

#include "outrider/sim/faults/drive_sim_params.hpp"

namespace outrider::testing {

/// Wheels of different gains with dead time, lag, slip and noise, and a link that delays and loses commands.
inline DriveSimParams usual_faults() {
  DriveSimParams params;
  params.wheels.gains = {0.985, 1.012, 1.003, 0.989};
  params.wheels.dead_time_s = 0.08;
  params.wheels.lag_s = 0.08;
  params.wheels.strafe_slip = 0.1;
  params.wheels.noise = 0.005;
  params.link = {1, 0.05, 0.01};
  return params;
}

}  // namespace outrider::testing
