// The functions of firing_region.hpp and sight.hpp in air, where flights are no parabolas.
//
// Flights leave the vertical plane of the barrel, so the shortcuts for parabolas do not apply: each shot is
// aimed (aim.hpp) and simulated to within 1 mm. Two facts save time: the range of flights at full speed is
// precomputed by pitch and bearing, and the shot from a neighbouring place is a good guess.
#pragma once

#include "outrider/ballistics/firing_region.hpp"

namespace outrider {

/// Once the error of a shot is no more than this part of what its target allows, no better one is sought.
inline constexpr double good_error_ratio = 0.7;

FiringRegion firing_region_in_air(const ShotRules& rules, const FlightSpace& space, const Target& target,
                                  const GridFrame& frame, const std::vector<std::uint8_t>& standable,
                                  const std::stop_token& stop);

Exhausted exhaust_in_air(const ShotRules& rules, const FlightSpace& space, const Target& target,
                         const GridFrame& frame, const std::vector<std::uint8_t>& standable,
                         const std::stop_token& stop);

double longest_range_in_air(const ShotRules& rules, const Target& target);

}  // namespace outrider
