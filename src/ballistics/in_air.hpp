// What firing_region.hpp and sight.hpp promise, where flights are no parabolas.
//
// Flights leave the upright plane of the barrel, so nothing is cut or shared: each is aimed (aim.hpp) and
// flown to within 1 mm. What saves time: how far a flight at full speed gets is known beforehand, by pitch
// and bearing, and the place next to one is a good guess of its aim.
#pragma once

#include "outrider/ballistics/firing_region.hpp"

namespace outrider {

FiringRegion firing_region_in_air(const ShotRules& rules, const FlightSpace& space, const Target& target,
                                  const GridFrame& frame, const std::vector<std::uint8_t>& standable,
                                  const std::stop_token& stop);

Exhausted exhaust_in_air(const ShotRules& rules, const FlightSpace& space, const Target& target,
                         const GridFrame& frame, const std::vector<std::uint8_t>& standable,
                         const std::stop_token& stop);

double longest_range_in_air(const ShotRules& rules, const Target& target);

}  // namespace outrider
