#include "outrider/jobs/drive/localisation/relocaliser.hpp"

#include <algorithm>
#include <iterator>

namespace outrider {

void Relocaliser::add(std::span<const TagSighting> sightings, const TagMap& map, const RobotCamera& camera,
                      const LocaliseOptions& options) {
  const TagFix fix = localise(sightings, map, camera, std::nullopt, options);
  const auto count = [&](TagVerdict verdict) { return std::ranges::count(fix.verdicts, verdict); };
  const auto known = std::ssize(fix.verdicts) - count(TagVerdict::unknown_id);
  if (count(TagVerdict::off_floor) > 0 || (known > 1 && count(TagVerdict::used) < known)) ++contradictory;
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
