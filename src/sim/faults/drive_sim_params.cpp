#include "outrider/sim/faults/drive_sim_params.hpp"

namespace outrider {

TagMap true_tags_later(const TagMap& map, const DriveSimParams& params) {
  TagMap tags = params.tags.value_or(map);
  for (Tag& tag : tags.tags) {
    tag.size_m *= params.tag_scale;
    if (tag.id == params.moved_tag.id)
      tag.world_T_tag.position =
          tag.world_T_tag.position + params.moved_tag.by_m * tag.world_T_tag.rotation.axes[0];
  }
  return tags;
}

TagMap true_tags(const TagMap& map, const DriveSimParams& params) {
  DriveSimParams before = params;
  if (params.moved_tag.at_s > 0.0) before.moved_tag = {};
  return true_tags_later(map, before);
}

std::vector<Option> describe(DriveSimParams& params) {
  std::vector<Option> options = describe(params.wheels);
  const std::vector<Option> sight = {
      {"corner_sigma", "px", 0.0, 10.0, "of a detected corner, where images are not rendered",
       &params.sight.corner_sigma_px},
      {"missed", "", 0.0, 1.0, "part of the tags in view that are not detected there", &params.sight.missed},
      {"blind_from", "s", 0.0, 1e9, "from then on the robot sees no tags", &params.sight.blind_from_s},
  };
  const std::vector<Option> tags = {
      {"moved_tag", "", -1, 65534, "id of a tag that hangs elsewhere than the map says; -1: none",
       &params.moved_tag.id},
      {"moved_tag_by", "m", -10.0, 10.0, "how far to the right of its reader", &params.moved_tag.by_m},
      {"moved_tag_at", "s", 0.0, 1e9, "when it is moved", &params.moved_tag.at_s},
      {"tag_scale", "", 0.1, 10.0, "true size of every tag, relative to tag_size, which the robot is told",
       &params.tag_scale},
  };
  for (const std::vector<Option>& more :
       {sight, describe(params.kidnapping), tags, describe(params.clock), describe(params.planner)})
    options.insert(options.end(), more.begin(), more.end());
  return options;
}

}  // namespace outrider
