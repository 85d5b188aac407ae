#include "outrider/sim/drive_sim_params.hpp"

namespace outrider {

std::vector<Option> describe(DriveSimParams& params) {
  std::vector<Option> options = describe(params.wheels);
  const std::vector<Option> own = {
      {"corner_sigma", "px", 0.0, 10.0, "of a detected corner, where images are not rendered",
       &params.sight.corner_sigma_px},
      {"missed", "", 0.0, 1.0, "part of the tags in view that are not detected there", &params.sight.missed},
      {"blind_from", "s", 0.0, 1e9, "from then on the robot sees no tags", &params.sight.blind_from_s},
      {"kidnapped_at", "s", 0.0, 1e9, "when the robot is put elsewhere", &params.kidnapping.at_s},
      {"kidnapped_by", "m", -100.0, 100.0, "how far to its left", &params.kidnapping.by_m},
      {"kidnapped_turn", "deg", -180.0, 180.0, "and turned by how much", &params.kidnapping.by_rad},
      {"moved_tag", "", -1, 586, "id of a tag that hangs elsewhere than the map says; -1: none",
       &params.moved_tag.id},
      {"moved_tag_by", "m", -10.0, 10.0, "how far to the right of its reader", &params.moved_tag.by_m},
  };
  options.insert(options.end(), own.begin(), own.end());
  return options;
}

}  // namespace outrider
