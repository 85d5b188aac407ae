#include "outrider/sim/faults/team_faults.hpp"

#include "times.hpp"

namespace outrider {

bool TeamFaults::of_sightings() const {
  return missing_from_s < never_s || missed > 0.0 || late_s > 0 || wrong > 0.0;
}

bool TeamFaults::any() const {
  return of_sightings() || stuck_from_s < never_s || kidnapped_at_s < never_s || closed_at_s < never_s;
}

std::vector<Option> describe(TeamFaults& faults) {
  return {
      {"missing_from", "s", 0.0, 1e9, "from then on no sighting of the target comes", &faults.missing_from_s},
      {"missing_for", "s", 0.0, 1e9, "for how long", &faults.missing_for_s},
      {"missed", "", 0.0, 1.0, "part of the sightings that do not come", &faults.missed},
      {"late", "s", 0, 1e6, "so long each sighting is late", &faults.late_s},
      {"wrong", "", 0.0, 1.0, "part of the sightings that are wrong", &faults.wrong},
      {"wrong_by", "", 1, 1e6, "cells by which a wrong one is off at most, along each axis",
       &faults.wrong_by},
      {"stuck_from", "s", 0.0, 1e9, "from then on no robot moves", &faults.stuck_from_s},
      {"stuck_for", "s", 0.0, 1e9, "for how long", &faults.stuck_for_s},
      {"kidnapped_at", "s", 0.0, 1e9, "when the robot is put elsewhere", &faults.kidnapped_at_s},
      {"kidnapped_by", "", 1, 1e6, "cells away at most, along each axis, to a free cell that is drawn",
       &faults.kidnapped_by},
      {"closed_at", "s", 0.0, 1e9, "when cells ahead of the robot close; it notices when it tries to enter",
       &faults.closed_at_s},
      {"closed_for", "s", 0.0, 1e9, "for how long", &faults.closed_for_s},
      {"closed_ahead", "", 1, 1e6, "cells from the robot towards the target to the middle of them",
       &faults.closed_ahead},
      {"closed_radius", "", 0, 1e6, "cells from there that close, along each axis", &faults.closed_radius},
  };
}

}  // namespace outrider
