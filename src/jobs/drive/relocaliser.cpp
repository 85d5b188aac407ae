#include "outrider/jobs/drive/relocaliser.hpp"

#include <algorithm>

namespace outrider {

void Relocaliser::add(std::span<const TagSighting> sightings, const TagMap& map, const RobotCamera& camera,
                      const LocaliseOptions& options) {
  const TagFix fix = localise(sightings, map, camera, std::nullopt, options);
  const bool contradicts = std::ranges::any_of(fix.verdicts, [](TagVerdict verdict) {
    return verdict == TagVerdict::outvoted || verdict == TagVerdict::off_floor;
  });
  if (contradicts) ++contradictory;
  if (!fix.belief || (pose && squared_mahalanobis(*pose, *fix.belief) > most_plausible_distance))
    *this = {.contradictory = contradictory};
  if (!fix.belief) return;
  pose = pose ? fuse(*pose, *fix.belief) : *fix.belief;
  ++images;
  for (std::size_t i = 0; i < sightings.size(); ++i) {
    if (fix.verdicts[i] == TagVerdict::used) tags.insert(sightings[i].id);
  }
}

}  // namespace outrider
