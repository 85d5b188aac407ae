#include "outrider/sim/faults/guard_sim_params.hpp"

namespace outrider {

bool GuardSimParams::any() const {
  const GuardSimParams none;
  return gun.jammed_at_s != none.gun.jammed_at_s || gun.balls != none.gun.balls || way.any() ||
         planner.any() || position_ratio != none.position_ratio || aim_ratio != none.aim_ratio;
}

ExecutionErrors true_errors(ExecutionErrors told, const GuardSimParams& params) {
  told.position_m *= params.position_ratio;
  told.aim.gun_rad *= params.aim_ratio;
  told.aim.speed_ratio *= params.aim_ratio;
  return told;
}

std::vector<Option> describe(GuardSimParams& params) {
  std::vector<Option> options = {
      {"jammed_at", "s", 0.0, 1e9, "when the gun jams: the trigger fires nothing, and nobody is told",
       &params.gun.jammed_at_s},
      {"jammed_for", "s", 0.0, 1e9, "for how long", &params.gun.jammed_for_s},
      {"balls", "", 0, 1'000'000'000,
       "in the tank, whatever the mission is told; after them the trigger fires nothing until water is taken "
       "in",
       &params.gun.balls},
      {"position", "", 0.0, 100.0, "true largest error of where a drive ends, relative to errors.position",
       &params.position_ratio},
      {"aim", "", 0.0, 1.9, "true largest errors of gun and muzzle speed, relative to those of errors",
       &params.aim_ratio},
  };
  for (const std::vector<Option>& more : {describe(params.way), describe(params.planner)})
    options.insert(options.end(), more.begin(), more.end());
  return options;
}

}  // namespace outrider
