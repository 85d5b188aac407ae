#include "outrider/jobs/drive/relocaliser.hpp"

namespace outrider {

void Relocaliser::add(std::span<const TagSighting> sightings, const TagMap& map, const RobotCamera& camera,
                      const LocaliseOptions& options) {
  const TagFix fix = localise(sightings, map, camera, std::nullopt, options);
  if (!fix.belief) {
    *this = {};
    return;
  }
  if (pose && squared_mahalanobis(*pose, *fix.belief) > most_plausible_distance) *this = {};
  pose = pose ? fuse(*pose, *fix.belief) : *fix.belief;
  ++images;
  for (std::size_t i = 0; i < sightings.size(); ++i) {
    if (fix.verdicts[i] == TagVerdict::used) tags.insert(sightings[i].id);
  }
}

}  // namespace outrider
