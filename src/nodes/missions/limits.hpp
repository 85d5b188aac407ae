// Limits that the missions with a robot behind topics have in common.
#pragma once

namespace outrider {

/// A thing in the scan that is no farther from one on the map is that one.
inline constexpr double on_map_m = 0.1;
/// The part of a deceleration that is counted on, since messages come late.
inline constexpr double careful = 0.5;
/// A robot that has moved farther gets on.
inline constexpr double moved_on_m = 0.02;
/// Times that are no farther apart are one.
inline constexpr double soon_s = 1e-6;

}  // namespace outrider
